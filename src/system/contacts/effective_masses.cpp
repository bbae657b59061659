// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/effective_masses.h"
#include "system/host/fix_list.h"

#include "atom.h"
#include "fix.h"
#include "force.h"
#include "modify.h"

#include <algorithm>
#include <limits>

using namespace LAMMPS_NS;

void EffectiveMasses::find_fixes()
{
  freeze_groups = 0;
  for (const auto &ifix : modify->get_fix_by_style("^freeze")) freeze_groups |= ifix->groupbit;
  rigid_fixes.clear();
  for (const auto &ifix : Talus::fix_list(*modify))
    if (ifix->rigid_flag) rigid_fixes.push_back(ifix);
}

void EffectiveMasses::update()
{
  masses.clear();
  num_known = atom->nlocal;
  if (!needed()) return;
  masses.assign(std::max(atom->nmax, atom->nlocal + atom->nghost), 0.0);

  for (const auto &ifix : rigid_fixes) {
    int dim;
    auto *body = static_cast<int *>(ifix->extract("body", dim));
    auto *mass = static_cast<double *>(ifix->extract("masstotal", dim));
    if (!body || !mass) continue;
    for (int i = 0; i < atom->nlocal; i++)
      if (body[i] >= 0) masses[i] = mass[body[i]];
  }
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & freeze_groups) masses[i] = std::numeric_limits<double>::infinity();
  if (unit() == 1.0) return;
  for (int i = 0; i < atom->nlocal; i++)
    masses[i] = unit() * (masses[i] > 0.0 ? masses[i] : atom->rmass[i]);
}

double EffectiveMasses::unit() const
{
  return 1.0 / force->ftm2v;
}

double EffectiveMasses::mass(int i) const
{
  return !masses.empty() && masses[i] > 0.0 ? masses[i] : unit() * atom->rmass[i];
}
