// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// All bonds of a rank (rotational_bond.h), eight at a time and on all threads. Every particle has the loads of its bonds
// added in ascending order of the IDs of its partners, whatever the order of the list and of particles in memory: with
// both ranks of a bond computing it, the bits do not depend on the number of ranks and threads.
//
//   after neighbor lists   set_bonds()
//   every step             compute(), drop() for what breaks, add_to()

#ifndef TALUS_BONDS_ROTATIONAL_BONDS_H
#define TALUS_BONDS_ROTATIONAL_BONDS_H

#include "base/aligned_vector.h"
#include "bonds/rotational_bond.h"

#include <cstdint>
#include <vector>

namespace Talus {

/// Of one bond: where its particles are, `first` with the lower ID, and its type, from 1.
struct BondEnds {
  int first, second, type;
};

/// What holds for all bonds.
struct BondModel {
  BondFrame frame = BondFrame::PARTICLE;
  BondDamping damping = BondDamping::DEM;
  bool per_length =
      false;    ///< stiffness normal and shear are to be divided by the length at rest
  bool breaks = true, smooth = true;
  std::vector<BondCoeffs<double>> coeffs;    ///< by type; that of 0 is not read
};

/// Rows of three, of orientations four (w, x, y, z), by place of a particle. `history`: rows of `stride` by bond, the
/// length at rest, the direction at rest (see BondedPair::at_rest) times `sign`, and with damping RATE the angles of the
/// last step, which are written.
struct BondedParticles {
  const double *position, *velocity, *omega, *orientation;
  double *history;
  int stride;
  double sign;
};

class RotationalBonds {
 public:
  void set_model(const BondModel &of_all) { model = of_all; }
  /// `tag`: IDs by place. Particles of places below `owned` have loads added.
  void set_bonds(const std::vector<BondEnds> &all, int owned, const std::int64_t *tag);
  int count() const { return num_bonds; }
  const BondEnds &bond(int b) const { return bonds[b]; }

  void compute(const BondedParticles &particles, double dt, int threads);
  /// Bonds that break in this step, in ascending order.
  template <class Visit> void for_each_broken(Visit visit) const
  {
    for (const std::vector<int> &of_thread : broken)
      for (const int b : of_thread) visit(b);
  }
  /// Such a bond has no loads from here on.
  void drop(int b);
  bool is_dropped(int b) const { return bonds[b].type == 0; }
  /// Adds to the rows of three of owned particles.
  void add_to(double *force, double *torque, int threads) const;

  /// Of the last compute().
  const double *force_on_first(int b) const { return loads[b].force; }
  double energy(int b) const { return loads[b].torque1[3]; }    ///< as LAMMPS tells it
  /// With `smooth` the share of it that forces have; none of what breaks then.
  double stored_energy(int b) const { return loads[b].torque2[3]; }

  double memory_usage() const;

 private:
  /// The fourth numbers: breaking, energy, stored energy.
  struct alignas(32) Loads {
    double force[4], torque1[4], torque2[4];
  };
  struct Side {
    int bond;
    bool first;
  };
  template <BondFrame frame, BondDamping damping>
  void compute_all(const BondedParticles &particles, double dt, int threads);
  template <BondFrame frame, BondDamping damping>
  void compute_eight(int begin, const BondedParticles &particles, double inverse_dt,
                     std::vector<int> &breaking);
  BondCoeffs<Vec8> coeffs_of(int begin) const;

  BondModel model;
  int num_bonds = 0;
  std::vector<BondEnds> bonds;    ///< and copies of the last one, up to a multiple of eight
  AlignedVector<Loads> loads;
  std::vector<std::uint32_t>
      sides_begin;    ///< by place of an owned particle, and the end of the last
  std::vector<Side> sides;
  std::vector<std::vector<int>> broken;    ///< by thread
};

}    // namespace Talus

#endif
