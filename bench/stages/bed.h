// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A dense bed of spheres in memory, in the arrays in which a host keeps it, for benchmarks of
// single stages. Lengths in diameters; no contact forces act, nothing moves.

#ifndef TALUS_BENCH_BED_H
#define TALUS_BENCH_BED_H

#include "contact/contact_chunk.h"
#include "neighbors/neighbor_view.h"
#include "particles/particle_records.h"

#include <cstdint>
#include <vector>

namespace Bench {

inline constexpr double skin = 0.1, dt = 1e-6;

/// Half neighbor lists in one array.
struct Lists {
  std::vector<int> row, size, entries;
  std::vector<const int *> begin;

  Talus::NeighborView view() const;
};

/// One rank: owned spheres in the order of their keys, as LAMMPS sorts them for Talus, then ghosts.
struct Bed {
  Bed() = default;
  Bed(Bed &&) = default;    // not copied: lists point into themselves
  Bed &operator=(Bed &&) = default;

  int owned = 0;
  std::vector<double> x, v, omega, radius, mass, f, torque;
  std::vector<std::uint64_t> key;
  std::vector<std::int64_t> tag;
  std::vector<int> type;
  Lists neighbors;              ///< each pair in the row of its second member, which may be a ghost
  std::vector<int> original;    ///< of ghosts that are images of owned spheres

  int size() const { return static_cast<int>(radius.size()); }
  Talus::ParticleView view();
};

/// Spheres on a body-centerd cubic lattice that fills a cube, at random near their sites, with 2.1
/// contacts and 4.0 candidate pairs per sphere (a settled bed: 2.2 and 3.5). `spheres` is rounded
/// down to what fills the cube.
Bed make_bed(int spheres);

/// The bed in a periodic box on one rank: what was its surface is in contact with images of the other
/// side.
Bed in_periodic_box(const Bed &bed);

/// The bed on two ranks: what is left and right of its middle, each with the ghosts it needs.
std::vector<Bed> two_ranks(const Bed &bed);

/// A table with one law for all, e.g. "hertz" and "multistep", with coefficients of the bed's units.
Talus::LawTable one_law(const char *normal, const char *tangential);

/// What ContactPipeline makes of it.
Talus::ContactScene scene_of(const Talus::LawTable &laws);

}    // namespace Bench

#endif
