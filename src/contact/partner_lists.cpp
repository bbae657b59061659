// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/partner_lists.h"

#include <algorithm>
#include <cstring>

namespace Talus {

void PartnerLists::resize(int capacity)
{
  range.resize(capacity);
}

void PartnerLists::begin()
{
  std::fill(range.begin(), range.end(), Range{});
}

void PartnerLists::layout()
{
  std::int64_t total = 0;
  for (Range &r : range) {
    r.begin = total;
    total += r.size;
    r.size = 0;    // counts up again in append()
  }
  pool.resize(total);
}

void PartnerLists::clear_all()
{
  if (pool.empty()) return;
  begin();
  pool.clear();
}

void PartnerLists::append(int atom, std::int64_t tag, const Record &history)
{
  Range &r = range[atom];
  Partner &p = pool[r.begin + r.size++];
  p.tag = tag;
  std::copy(std::begin(history.c), std::end(history.c), p.history);
}

const PartnerLists::Partner *PartnerLists::find(int atom, std::int64_t tag) const
{
  const Partner *p = pool.data() + range[atom].begin;
  for (int n = 0; n < range[atom].size; n++, p++)
    if (p->tag == tag) return p;
  return nullptr;
}

int PartnerLists::pack(int atom, double *buffer) const
{
  int m = 0;
  buffer[m++] = range[atom].size;
  for (int n = 0; n < range[atom].size; n++) {
    const Partner &p = pool[range[atom].begin + n];
    static_assert(sizeof p.tag == sizeof *buffer, "tags travel as the bits of a double");
    std::memcpy(&buffer[m++], &p.tag, sizeof p.tag);
    std::copy(std::begin(p.history), std::end(p.history), &buffer[m]);
    m += 4;
  }
  return m;
}

int PartnerLists::unpack(int atom, const double *buffer)
{
  int m = 0;
  Range &r = range[atom];
  r = {static_cast<std::int64_t>(pool.size()), static_cast<int>(buffer[m++])};
  for (int n = 0; n < r.size; n++) {
    Partner p;
    std::memcpy(&p.tag, &buffer[m++], sizeof p.tag);
    std::copy(&buffer[m], &buffer[m] + 4, p.history);
    m += 4;
    pool.push_back(p);
  }
  return m;
}

double PartnerLists::memory_usage() const
{
  return static_cast<double>(range.capacity() * sizeof(Range) + pool.capacity() * sizeof(Partner));
}

}    // namespace Talus
