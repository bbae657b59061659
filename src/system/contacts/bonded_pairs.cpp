// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/bonded_pairs.h"

#include "system/step/granular_system.h"

#include "bond.h"
#include "force.h"
#include "lammps.h"
#include "neighbor.h"

namespace Talus {

void BondedPairs::follow_bonds()
{
  now = present_bonds();
  if (system.lists().number() != lists_used || now == used) return;
  system.step().leave_records_for_pairs();
  system.rebuild().renumber_pairs();
}

void BondedPairs::are_used()
{
  used = now;
  lists_used = system.lists().number();
}

BondedPairs::Bonds BondedPairs::present_bonds() const
{
  const LAMMPS_NS::Force &force = *lmp->force;
  if (!force.bond || !force.bond->partial_flag || force.special_lj[1] == 1.0) return {};
  Bonds found;
  found.all = lmp->neighbor->nbondlist;
  for (int b = 0; b < found.all; b++) found.broken += lmp->neighbor->bondlist[b][2] <= 0;
  return found;
}

}    // namespace Talus
