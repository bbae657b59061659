// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// All bonds of a rank, eight at a time and on all threads, whatever their law: the base of RotationalBonds and
// SpringBonds. Every particle has the loads of its bonds added in ascending order of the IDs of its partners, whatever the
// order of the list and of particles in memory: with both ranks of a bond computing it, the bits do not depend on the
// number of ranks and threads.
//
//   after neighbor lists   set_bonds()
//   every step             compute() of the law, drop() for what breaks, add_to()

#ifndef TALUS_BONDS_BOND_SUMS_H
#define TALUS_BONDS_BOND_SUMS_H

#include "base/aligned_vector.h"
#include "base/in_parallel.h"
#include "bonds/bond_rows.h"
#include "particles/particle_state.h"

#include <cstdint>
#include <type_traits>
#include <vector>

namespace Talus {

/// What eight bonds have along the line between their centers: the force on the first particle, that on the second is the
/// opposite; the energy as LAMMPS tells it, and the share of it that forces have; by bits, which ones break.
struct EightForces {
  Vector3<Vec8> force;
  Vec8 energy, stored;
  unsigned breaking;
};

struct EightLoads : EightForces {
  Vector3<Vec8> torque1, torque2;
};

class BondSums {
 public:
  /// `tag`: IDs by place. Particles of places below `owned` have loads added.
  void set_bonds(const std::vector<BondEnds> &all, int owned, const std::int64_t *tag);
  int count() const { return num_bonds; }
  const BondEnds &bond(int b) const { return bonds[b]; }

  /// Bonds that break in this step, in ascending order.
  template <class Visit> void for_each_broken(Visit visit) const
  {
    for (const std::vector<int> &of_thread : broken)
      for (const int b : of_thread) visit(b);
  }
  /// Such a bond has no loads from here on.
  void drop(int b);
  bool is_dropped(int b) const { return bonds[b].type == 0; }
  /// To owned particles; torques where bonds have them.
  void add_to(const ParticleState &particles, int threads) const;

  /// Of the last compute().
  const double *force_on_first(int b) const { return forces[b].c; }
  double energy(int b) const { return energies[b]; }    ///< as LAMMPS tells it
  /// With `smooth` the share of it that forces have; none of what breaks then.
  double stored_energy(int b) const { return forces[b].c[3]; }

  double memory_usage() const;

 protected:
  explicit BondSums(bool with_torques) : turning(with_torques) {}
  ~BondSums() = default;    // never deleted through this

  /// law(eight): EightLoads of EightBonds, or EightForces of bonds without torques.
  template <class Law> void find_loads(int threads, Law law);
  /// take(i, sum) of owned particles: the sum of one number of each bond, in the same order as loads.
  template <class Take> void for_each_sum(const double *of_bonds, int threads, Take take) const;
  EightBonds eight_at(int begin) const
  {
    return {&bonds[begin], begin, std::min(lanes, num_bonds - begin)};
  }

 private:
  struct Side {
    int bond;
    bool first;
  };
  template <class Found>
  void take(const EightBonds &eight, const Found &found, std::vector<int> &breaking);
  template <bool with_torques> void add_all(const ParticleState &particles, int threads) const;

  bool turning;
  int num_bonds = 0;
  std::vector<BondEnds> bonds;     ///< and copies of the last one, up to a multiple of eight
  AlignedVector<Record> forces;    ///< the fourth numbers: stored energy
  AlignedVector<Record> torques1, torques2;    ///< of bonds that have them
  AlignedVector<double> energies;
  std::vector<std::uint32_t>
      sides_begin;    ///< by place of an owned particle, and the end of the last
  std::vector<Side> sides;
  std::vector<std::vector<int>> broken;    ///< by thread
};

/* ---------------------------------------------------------------------- */

template <class Law> void BondSums::find_loads(int threads, Law law)
{
  broken.resize(threads);
  const std::int64_t blocks = static_cast<std::int64_t>(bonds.size()) / lanes;
  in_ranges(blocks, threads, [&](int thread, int begin, int end) {
    broken[thread].clear();
    for (int block = begin; block < end; block++) {
      const EightBonds eight = eight_at(block * lanes);
      take(eight, law(eight), broken[thread]);
    }
  });
}

template <class Found>
void BondSums::take(const EightBonds &eight, const Found &found, std::vector<int> &breaking)
{
  const int begin = eight.begin;
  const auto write = [begin](const Vector3<Vec8> &v, Vec8 fourth, AlignedVector<Record> &to) {
    alignas(64) double vector[3][lanes], last[lanes];
    store(vector[0], v.x);
    store(vector[1], v.y);
    store(vector[2], v.z);
    store(last, fourth);
    for (const int k : {0, 4}) to_rows(vector, last, k, [&](int q) { return to[begin + k + q].c; });
  };
  write(found.force, found.stored, forces);
  if constexpr (std::is_same_v<Found, EightLoads>) {
    write(found.torque1, Vec8{}, torques1);
    write(found.torque2, Vec8{}, torques2);
  }
  store(&energies[begin], found.energy);
  for (int k = 0; k < eight.count; k++) {
    if (is_dropped(begin + k))
      drop(begin + k);
    else if (found.breaking >> k & 1U)
      breaking.push_back(begin + k);
  }
}

template <class Take>
void BondSums::for_each_sum(const double *of_bonds, int threads, Take take_sum) const
{
  const auto owned = static_cast<std::int64_t>(sides_begin.size()) - 1;
  in_ranges(owned, threads, [=](int, int begin, int end) {
    for (int i = begin; i < end; i++) {
      double sum = 0.0;
      for (std::uint32_t s = sides_begin[i]; s < sides_begin[i + 1L]; s++)
        sum += of_bonds[sides[s].bond];
      take_sum(i, sum);
    }
  });
}

}    // namespace Talus

#endif
