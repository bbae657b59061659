// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/step/attached_pair.h"

#include "system/host/private_members.h"

#include "atom.h"
#include "force.h"
#include "pair.h"

using namespace LAMMPS_NS;

namespace Talus {

bool AttachedPair::is_alone() const
{
  return pair && (force->pair == pair || computes_all_of_hybrid(*pair, *force, atom->ntypes));
}

/* Style hybrid/scaled multiplies forces, and other ones are not known. */

std::string AttachedPair::reason_against() const
{
  if (!pair) return "the pair style is not accelerated";
  if (force->pair == pair) return "";
  const std::string style_of_all = force->pair_style;
  if (style_of_all != "hybrid" && style_of_all != "hybrid/overlay")
    return "the pair style is " + style_of_all;
  return pair->compute_flag ? "" : "'pair_modify compute no' is set";
}

}    // namespace Talus
