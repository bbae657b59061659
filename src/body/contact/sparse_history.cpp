// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/sparse_history.h"

#include <algorithm>
#include <cmath>

namespace Talus {

int SparseHistory::pack(int particle, double *buf) const
{
  std::fill(buf, buf + size_packed(), 0.0);
  const int at = place[particle];
  if (at == nowhere) return size_packed();
  std::copy(records[at].c, records[at].c + 4, buf);
  if (with_impact) std::copy(impacts[at].c, impacts[at].c + 4, buf + 4);
  return size_packed();
}

/* Most particles that arrive are far from the body: they get no record. */

int SparseHistory::unpack(int particle, const double *buf)
{
  place[particle] = nowhere;
  if (std::all_of(buf, buf + size_packed(), [](double a) { return a == 0.0 && !std::signbit(a); }))
    return size_packed();
  place[particle] = static_cast<int>(records.size());
  records.push_back({{buf[0], buf[1], buf[2], buf[3]}});
  if (with_impact) impacts.push_back({{buf[4], buf[5], buf[6], buf[7]}});
  return size_packed();
}

/* Whoever has a record may touch until the next step has looked. */

void SparseHistory::follow(const std::vector<int> &candidates)
{
  const std::size_t n = candidates.size();
  AlignedVector<Record> old_records, old_onsets;
  old_records.swap(records);
  old_onsets.swap(impacts);
  records.resize(n);
  impacts.resize(with_impact ? n : 0);
  for (std::size_t c = 0; c < n; c++) {
    const int at = place[candidates[c]];
    records[c] = at == nowhere ? Record{} : old_records[at];
    if (with_impact) impacts[c] = at == nowhere ? Record{} : old_onsets[at];
  }
  std::fill(place.begin(), place.end(), nowhere);
  for (std::size_t c = 0; c < n; c++) place[candidates[c]] = static_cast<int>(c);
  touching = std::vector<std::atomic<std::uint8_t>>((n + 7) / 8);
  for (auto &block : touching) block.store(0xff, std::memory_order_relaxed);
}

void SparseHistory::clear(std::size_t block, unsigned separated)
{
  for (std::size_t c = 8 * block; separated; c++, separated >>= 1U) {
    if (!(separated & 1U)) continue;
    records[c] = Record{};
    if (with_impact) impacts[c] = Record{};
  }
}

Record SparseHistory::of_particle(int particle) const
{
  const int at = place[particle];
  return at == nowhere ? Record{} : records[at];
}

double SparseHistory::memory_usage() const
{
  return static_cast<double>(place.capacity() * sizeof(int) + touching.capacity() +
                             (records.capacity() + impacts.capacity()) * sizeof(Record));
}

}    // namespace Talus
