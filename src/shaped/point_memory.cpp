// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shaped/point_memory.h"

#include <algorithm>
#include <cstring>

namespace Talus {

int PointMemories::longest(int n) const
{
  std::size_t most = 0;
  for (int i = 0; i < n; i++) most = std::max(most, lists[i].size());
  return static_cast<int>(most);
}

int PointMemories::pack(int particle, double *to) const
{
  double *next = to;
  *next++ = static_cast<double>(lists[particle].size());
  for (const PointMemory &one : lists[particle]) {
    std::memcpy(next++, &one.partner, sizeof one.partner);
    std::memcpy(next++, &one.name, sizeof one.name);
    next = std::copy(one.memory.value, one.memory.value + ContactBatch::history_size, next);
  }
  return static_cast<int>(next - to);
}

int PointMemories::unpack(int particle, const double *from)
{
  auto &list = lists[particle];
  list.resize(static_cast<std::size_t>(from[0]));
  const double *next = from + 1;
  for (PointMemory &one : list) {
    std::memcpy(&one.partner, next++, sizeof one.partner);
    std::memcpy(&one.name, next++, sizeof one.name);
    std::copy(next, next + ContactBatch::history_size, one.memory.value);
    next += ContactBatch::history_size;
  }
  return static_cast<int>(next - from);
}

double PointMemories::memory_usage() const
{
  std::size_t bytes = lists.capacity() * sizeof lists[0];
  for (const auto &list : lists) bytes += list.capacity() * sizeof(PointMemory);
  return static_cast<double>(bytes);
}

}    // namespace Talus
