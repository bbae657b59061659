// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/definitions.h"

#include "base/state_digest.h"
#include "system/fix_list.h"
#include "system/granular_system.h"
#include "system/private_members.h"

#include "atom.h"
#include "compute.h"
#include "fix.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "pair.h"
#include "update.h"

#include <vector>

using namespace LAMMPS_NS;

namespace Talus {

std::uint64_t digest_of_fixes(LAMMPS &lmp)
{
  StateDigest digest;
  for (const Fix *fix : fix_list(*lmp.modify))
    digest.add(static_cast<std::uint64_t>(number_of_instance(*fix)));
  return digest.value();
}

/* Lists that a command between two advances has made may name fixes that are gone since. */

std::uint64_t digest_of_definitions(LAMMPS &lmp, GranularSystem &system)
{
  StateDigest digest;
  const auto add = [&digest](auto number) { digest.add(static_cast<std::uint64_t>(number)); };
  const std::uint64_t fixes = digest_of_fixes(lmp);
  add(fixes);
  add(fixes == system.external_loads().fixes_of_lists());
  const std::vector<Compute *> computes = lmp.modify->get_compute_list();
  add(computes.size());
  for (const Compute *compute : computes) add(number_of_instance(*compute));
  add(lmp.force->pair ? number_of_instance(*lmp.force->pair) : -1);
  add(system.laws().revision());
  for (const char *c = lmp.update->integrate_style; c && *c; c++) add(*c);
  add(lmp.atom->natoms);
  return digest.value();
}

}    // namespace Talus
