// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/step/weights.h"

#include "system/step/granular_system.h"

#include "atom.h"
#include "fix.h"
#include "force.h"
#include "neighbor.h"
#include "pair.h"

#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

std::string Weights::take(const Fix *gravity, std::function<const double *()> field)
{
  const std::string of_pair_style = system.pair_style().reason_against();
  if (!of_pair_style.empty()) return of_pair_style;
  if (!force->pair->compute_flag) return "'pair_modify compute no' is set";
  if (system.masses().unit() != 1.0)
    return "the unit of force is not that of mass times acceleration";
  if (neighbor->includegroup || atom->firstgroupname)
    return "neighbor lists or particles are restricted to a group";
  if (fix && fix != gravity) return "another fix gravity comes before it";
  fix = gravity;
  acceleration = std::move(field);
  return "";
}

void Weights::drop(const Fix *gravity)
{
  if (fix == gravity) fix = nullptr;
}

void Weights::begin_step(ContactPipeline &particles)
{
  particles.set_gravity(fix ? acceleration() : nullptr);
}

void Weights::find_weightless(ContactPipeline &particles) const
{
  const int *mask = atom->mask, bits = fix ? fix->groupbit : 1;
  if (bits & 1)    // the group all
    particles.set_weightless(nullptr);
  else
    particles.set_weightless([=](int i) { return !(mask[i] & bits); });
}

}    // namespace Talus
