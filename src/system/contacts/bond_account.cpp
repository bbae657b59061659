// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/bond_account.h"

#include "bond.h"

#include <cstddef>

namespace Talus {

BondAccount *BondAccount::of(LAMMPS_NS::Bond *bond)
{
  return dynamic_cast<BondAccount *>(bond);
}

double BondAccount::half_of_work(const ParticleState &particles) const
{
  double power = 0.0;
  const auto add = [&](const std::vector<double> &loads, const ParticleRows &rates) {
    for (std::size_t n = 0; n < loads.size(); n += 3) {
      const double *const rate = rates.row(static_cast<int>(n / 3));
      for (int d = 0; d < 3; d++) power += loads[n + d] * rate[d];
    }
  };
  add(forces, particles.velocities());
  add(torques, particles.angular_velocities());
  return -0.5 * dt * power;
}

void BondAccount::complete_kick(const ParticleState &particles)
{
  if (forces.empty()) return;
  settled += first_half + half_of_work(particles);
  first_half = 0.0;
  forces.clear();
}

void BondAccount::begin_step(const ParticleState &particles, double of_dt, bool again,
                             double counted)
{
  half_is_done = again && counted > 0.0;
  if (again)
    settled += 2.0 * counted * first_half;
  else
    complete_kick(particles);
  first_half = 0.0;
  dt = of_dt;
  forces.assign(3 * static_cast<std::size_t>(particles.owned()), 0.0);
  torques.clear();
}

double *BondAccount::torque_of_bonds()
{
  torques.assign(forces.size(), 0.0);
  return torques.data();
}

void BondAccount::end_step(const ParticleState &particles)
{
  if (!forces.empty() && !half_is_done) first_half = half_of_work(particles);
}

BondEnergies BondAccount::energies(double counted) const
{
  BondEnergies found;
  found.stored = stored_energy();
  found.broken = broken;
  found.damped = settled + 2.0 * counted * first_half - found.stored - broken;
  return found;
}

}    // namespace Talus
