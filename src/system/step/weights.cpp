// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/step/weights.h"

#include "system/step/granular_system.h"

#include "atom.h"
#include "force.h"
#include "neighbor.h"
#include "pair.h"

using namespace LAMMPS_NS;

namespace Talus {

std::string Weights::take(SystemGravity *gravity_fix)
{
  const std::string of_pair_style = system.reason_of_pair_style();
  if (!of_pair_style.empty()) return of_pair_style;
  if (!force->pair->compute_flag) return "'pair_modify compute no' is set";
  if (system.masses().unit() != 1.0)
    return "the unit of force is not that of mass times acceleration";
  if (neighbor->includegroup || atom->firstgroupname)
    return "neighbor lists or particles are restricted to a group";
  if (field && field != gravity_fix) return "another fix gravity comes before it";
  field = gravity_fix;
  return "";
}

void Weights::drop(const SystemGravity *gravity_fix)
{
  if (field == gravity_fix) field = nullptr;
}

void Weights::begin_step(ContactPipeline &particles)
{
  particles.set_gravity(field ? field->acceleration() : nullptr);
}

void Weights::find_weightless(ContactPipeline &particles) const
{
  const int *mask = atom->mask, bits = field ? field->group_bits() : 1;
  if (bits & 1)    // the group all
    particles.set_weightless(nullptr);
  else
    particles.set_weightless([=](int i) { return !(mask[i] & bits); });
}

}    // namespace Talus
