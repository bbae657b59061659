// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// All bonds of a rank that are beams (rotational_bond.h); how they are summed is in bond_sums.h.

#ifndef TALUS_BONDS_ROTATIONAL_BONDS_H
#define TALUS_BONDS_ROTATIONAL_BONDS_H

#include "bonds/bond_sums.h"
#include "bonds/rotational_bond.h"

#include <vector>

namespace Talus {

/// What holds for all bonds.
struct BondModel {
  BondFrame frame = BondFrame::PARTICLE;
  BondDamping damping = BondDamping::DEM;
  bool per_length =
      false;    ///< stiffness normal and shear are to be divided by the length at rest
  bool breaks = true, smooth = true;
  std::vector<BondCoeffs<double>> coeffs;    ///< by type; that of 0 is not read
};

/// By local index of a particle; orientations in rows of four (w, x, y, z). `history`: rows of `stride` by bond, the
/// length at rest, the direction at rest (see BondedPair::at_rest) times `sign`, and with damping RATE the angles of the
/// last step, which are written.
struct BondedParticles {
  ParticleRows position, velocity, omega;
  const double *orientation;
  double *history;
  int stride;
  double sign;
};

class RotationalBonds : public BondSums {
 public:
  static constexpr bool has_torques = true;

  RotationalBonds() : BondSums(has_torques) {}
  void set_model(const BondModel &of_all) { model = of_all; }
  void compute(const BondedParticles &particles, double dt, int threads);

 private:
  template <BondFrame frame, BondDamping damping>
  void compute_all(const BondedParticles &particles, double dt, int threads);
  template <BondFrame frame, BondDamping damping>
  EightLoads loads_of(const EightBonds &eight, const BondedParticles &particles,
                      double inverse_dt) const;
  BondCoeffs<Vec8> coeffs_of(const EightBonds &eight) const;

  BondModel model;
};

}    // namespace Talus

#endif
