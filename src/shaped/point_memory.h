// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What contact points of shaped particles remember while there are no pairs: during a rebuild,
// between two runs, in restart files. A contact of two particles is kept by the one with the lower
// ID, so that there is one copy of it on all ranks together; that with a large body by the
// particle.

#ifndef TALUS_SHAPED_POINT_MEMORY_H
#define TALUS_SHAPED_POINT_MEMORY_H

#include "laws/contact_batch.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

namespace Talus {

/// One contact point, as the particle that keeps it sees it (it is the first body).
struct PointMemory {
  std::int64_t partner;    ///< ID of the other particle (> 0), or name of a large body (< 0)
  std::uint64_t name;      ///< of the contact, see ShapeContact
  RememberedValues memory;

  static constexpr int size = 2 + ContactBatch::history_size;    ///< doubles in messages
};

/// Lists by particle (host's index), as the fix that owns the particles' data moves them.
class PointMemories {
 public:
  void grow(int particles) { lists.resize(particles); }
  void copy(int from, int to) { lists[to] = lists[from]; }
  void clear(int particle) { lists[particle].clear(); }
  void clear_all()
  {
    for (auto &list : lists) list.clear();
  }
  /// What remembers nothing, as points of laws without history, is left out: a point that is not
  /// found here begins with zeros.
  void add(int particle, const PointMemory &one)
  {
    const auto &values = one.memory.value;
    if (std::any_of(std::begin(values), std::end(values), [](double v) { return v != 0.0; }))
      lists[particle].push_back(one);
  }
  const std::vector<PointMemory> &of(int particle) const { return lists[particle]; }

  /// Longest list of the particles 0 ... n-1.
  int longest(int n) const;

  /// Number of points, then these. Both return the doubles that they have written or read.
  int packed_size(int particle) const
  {
    return 1 + PointMemory::size * static_cast<int>(lists[particle].size());
  }
  int pack(int particle, double *to) const;
  int unpack(int particle, const double *from);

  double memory_usage() const;

 private:
  std::vector<std::vector<PointMemory>> lists;
};

}    // namespace Talus

#endif
