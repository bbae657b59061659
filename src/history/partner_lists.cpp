// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "history/partner_lists.h"

#include <algorithm>
#include <cstring>

namespace Talus {
namespace {

static_assert(sizeof(std::int64_t) == sizeof(double), "tags travel as the bits of a double");

void set_tag(double *entry, std::int64_t tag)
{
  std::memcpy(entry, &tag, sizeof tag);
}

std::int64_t tag_of(const double *entry)
{
  std::int64_t tag;
  std::memcpy(&tag, entry, sizeof tag);
  return tag;
}

}    // namespace

void PartnerLists::set_values(int n)
{
  if (n == values) return;
  const std::size_t entries = pool.size() / stride();
  AlignedVector<double> converted(entries * (1 + n), 0.0);
  for (std::size_t e = 0; e < entries; e++)
    std::memcpy(&converted[e * (1 + n)], &pool[e * stride()],
                sizeof(double) * (1 + std::min(n, values)));
  pool.swap(converted);
  values = n;
}

void PartnerLists::resize(int capacity)
{
  range.resize(capacity);
}

void PartnerLists::begin()
{
  if (empty()) return;
  std::fill(range.begin(), range.end(), Range{});
  pool.clear();
}

void PartnerLists::release()
{
  begin();
  if (memory_usage() > worth_giving_back) Talus::release(pool);
}

void PartnerLists::layout()
{
  std::int64_t total = 0;
  for (Range &r : range) {
    r.begin = total;
    total += r.size;
    r.size = 0;    // counts up again in append()
  }
  renew(pool, total * stride());
}

double *PartnerLists::append(int atom, std::int64_t tag)
{
  Range &r = range[atom];
  double *entry = &pool[(r.begin + r.size++) * stride()];
  set_tag(entry, tag);
  return entry + 1;
}

const double *PartnerLists::find(int atom, std::int64_t tag) const
{
  const double *entry = pool.data() + range[atom].begin * stride();
  for (int n = 0; n < range[atom].size; n++, entry += stride())
    if (tag_of(entry) == tag) return entry + 1;
  return nullptr;
}

void PartnerLists::copy_entry(int atom, int n, double *to) const
{
  std::memcpy(to, &pool[(range[atom].begin + n) * stride()], sizeof(double) * stride());
}

int PartnerLists::pack(int atom, double *buffer) const
{
  const Range &r = range[atom];
  buffer[0] = r.size;
  const double *begin = pool.data() + r.begin * stride();
  // tags are bit patterns: copied as memory, never as numbers
  if (r.size) std::memcpy(buffer + 1, begin, sizeof(double) * r.size * stride());
  return packed_size(atom);
}

double *PartnerLists::write_entry(double *to, std::int64_t tag, const double *values,
                                  int num_values)
{
  set_tag(to, tag);
  return std::copy(values, values + num_values, to + 1);
}

int PartnerLists::unpack(int atom, const double *buffer)
{
  Range &r = range[atom];
  r = {static_cast<std::int64_t>(pool.size()) / stride(), static_cast<int>(buffer[0])};
  const std::size_t needed = pool.size() + static_cast<std::size_t>(r.size) * stride();
  if (needed > pool.capacity()) pool.reserve(needed + needed / 8);    // not twice
  pool.resize(needed);
  if (r.size)
    std::memcpy(&pool[r.begin * stride()], buffer + 1, sizeof(double) * r.size * stride());
  return packed_size(atom);
}

double PartnerLists::memory_usage() const
{
  return static_cast<double>(range.capacity() * sizeof(Range) + pool.capacity() * sizeof(double));
}

}    // namespace Talus
