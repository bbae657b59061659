// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// All bonds of a rank that are springs (spring_bond.h); how they are summed is in bond_sums.h.

#ifndef TALUS_BONDS_SPRING_BONDS_H
#define TALUS_BONDS_SPRING_BONDS_H

#include "bonds/bond_sums.h"
#include "bonds/spring_bond.h"

#include <vector>

namespace Talus {

/// What holds for all bonds.
struct SpringModel {
  bool per_length = false;    ///< stiffness is to be divided by the length at rest
  bool smooth = true;
  int dimension = 3;                           ///< 2 or 3, of volumes
  std::vector<SpringCoeffs<double>> coeffs;    ///< by type; that of 0 is not read
};

/// By local index of a particle; with forces of volumes the sums of r^d and of r0^d, else nullptr. `lengths`: at rest, by
/// bond.
struct SpringParticles {
  ParticleRows position, velocity;
  const double *lengths;
  const double *volume, *volume_at_rest;
};

class SpringBonds : public BondSums {
 public:
  static constexpr bool has_torques = false;

  SpringBonds() : BondSums(has_torques) {}
  void set_model(const SpringModel &of_all) { model = of_all; }
  /// `breaks`: in this step.
  void compute(const SpringParticles &particles, bool breaks, int threads);

  /// Writes the sum of r^d of owned particles.
  void sum_volumes(const ParticleRows &position, double *volumes, int threads);
  /// Adds the sum of r0^d of these bonds, times `sign`, to owned particles.
  void add_volumes_at_rest(const std::vector<int> &of, const double *lengths, double sign,
                           double *volumes, int threads);

 private:
  EightForces loads_of(const EightBonds &eight, const SpringParticles &particles,
                       bool breaks) const;
  SpringCoeffs<Vec8> coeffs_of(const EightBonds &eight) const;
  double volume_of(double length) const
  {
    return model.dimension == 3 ? length * length * length : length * length;
  }

  SpringModel model;
  std::vector<double> volumes_of_bonds;    ///< scratch
};

}    // namespace Talus

#endif
