// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/bond_account.h"

#include "atom.h"
#include "bond.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>

using LAMMPS_NS::Atom;

namespace Talus {

BondAccount *BondAccount::of(LAMMPS_NS::Bond *bond)
{
  return dynamic_cast<BondAccount *>(bond);
}

double BondAccount::half_of_work(const Atom &atom) const
{
  double power = std::inner_product(forces.begin(), forces.end(), atom.v[0], 0.0);
  if (!torques.empty())
    power = std::inner_product(torques.begin(), torques.end(), atom.omega[0], power);
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
  torques.clear();
}

double *BondAccount::torque_of_bonds()
{
  torques.assign(forces.size(), 0.0);
  return torques.data();
}

void BondAccount::end_step(const Atom &atom)
{
  if (forces.empty()) return;
  const auto add = [](const std::vector<double> &loads, double *to) {
    std::transform(loads.begin(), loads.end(), to, to, std::plus<>());
  };
  add(forces, atom.f[0]);
  if (!torques.empty()) add(torques, atom.torque[0]);
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
