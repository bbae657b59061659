// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/bond_account.h"

#include "atom.h"
#include "bond.h"

#include <algorithm>
#include <cstddef>
#include <functional>

using LAMMPS_NS::Atom;

namespace Talus {

BondAccount *BondAccount::of(LAMMPS_NS::Bond *bond)
{
  return dynamic_cast<BondAccount *>(bond);
}

double BondAccount::half_of_work(const Atom &atom) const
{
  const double *const v = atom.v[0], *const omega = atom.omega[0];
  double power = 0.0;
  for (std::size_t k = 0; k < forces.size(); k++) power += forces[k] * v[k] + torques[k] * omega[k];
  return -0.5 * dt * power;
}

void BondAccount::complete_kick(const Atom &atom)
{
  if (forces.empty()) return;
  settled += first_half + half_of_work(atom);
  first_half = 0.0;
  forces.clear();
}

void BondAccount::begin_step(const Atom &atom, double of_dt, bool again, double counted)
{
  half_is_done = again && counted > 0.0;
  if (again)
    settled += 2.0 * counted * first_half;
  else
    complete_kick(atom);
  first_half = 0.0;
  dt = of_dt;
  forces.assign(3 * static_cast<std::size_t>(atom.nlocal), 0.0);
  torques.assign(forces.size(), 0.0);
}

void BondAccount::end_step(const Atom &atom)
{
  if (forces.empty()) return;
  double *const f = atom.f[0], *const t = atom.torque[0];
  std::transform(forces.begin(), forces.end(), f, f, std::plus<>());
  std::transform(torques.begin(), torques.end(), t, t, std::plus<>());
  if (!half_is_done) first_half = half_of_work(atom);
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
