// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which particles are near a large body, and what its contacts are asked for.

#include "system/bodies/large_body.h"

#include "system/contacts/fix_contact_store.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"

#include "body/shape/mesh_shape.h"

#include "atom.h"
#include "comm.h"
#include "neighbor.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace Talus {

void LargeBody::find_particles()
{
  side.decide(group_bits(), frame());
  list_particles();
}

void LargeBody::list_particles()
{
  masses.update();
  const ParticleState particles = view();
  const int *mask = mask_of_spheres();
  if (MeshShape *const mesh = moving_mesh()) mesh->settle(system.shapes() != nullptr);
  if (body_shape->wants_focus()) body_shape->focus(bounds_of_focus(particles, mask));
  contacts.find_candidates(*body_shape, frame(), particles, mask, group_bits(), neighbor->skin,
                           comm->nthreads);
  if (order_of_history != 0 && order_of_history != system.integrators().order())
    change_order_of_histories();
  order_of_history = system.integrators().order();
  keep_records(false);
  seen_between = {};
}

void LargeBody::change_order_of_histories()
{
  std::vector<ContactLaw> laws(1);
  for (int type = 1; type <= atom->ntypes; type++) laws.push_back(law_of(type));
  contacts.change_order(system.integrators().order(), atom->type,
                        [&laws](int type) -> const ContactLaw & { return laws[type]; });
}

/* nullptr: it is none, or its vertices do not move. */

MeshShape *LargeBody::moving_mesh()
{
  MeshShape *const mesh = body_shape->as_mesh();
  return mesh && mesh->moving() ? mesh : nullptr;
}

/* `old_ones`: those of the other order as well, until they have been changed. */

void LargeBody::keep_records(bool old_ones)
{
  const int needed = std::max(contacts.law_table().history_records(), 1);
  contacts.history.keep_records(old_ones ? std::max(needed, contacts.history.num_records())
                                         : needed);
}

/* Particles with a shape may be asked for anywhere: which are near is found in every step. */

Eigen::AlignedBox3d LargeBody::bounds_of_focus(const ParticleState &particles, const int *mask)
{
  constexpr double everywhere = 1.0e100;
  if (system.shapes())
    return {Eigen::Vector3d::Constant(-everywhere), Eigen::Vector3d::Constant(everywhere)};
  return contacts.bounds_of_search(frame(), particles, mask, group_bits(), neighbor->skin);
}

/* Particles with a shape belong to no group here: the system computes their contacts. */

const int *LargeBody::mask_of_spheres()
{
  const ShapedParticles *shapes = system.shapes();
  if (!shapes) return atom->mask;
  spheres.assign(atom->mask, atom->mask + atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++)
    if (shapes->is_shaped(atom->type[i])) spheres[i] = 0;
  return spheres.data();
}

/* ---------------------------------------------------------------------- */

BodyFindings LargeBody::findings_now() const
{
  BodyFindings found = contacts.find_worst(*body_shape, frame(), view(), comm->nthreads);
  if (system.shapes()) found.join(system.shapes()->deepest_in(*this));
  return found;
}

bool LargeBody::accounts() const
{
  return is_asked || was_asked || system.account().is_asked();
}

/* Work that went into a spring is stored there, or lost: both count here. So does the work of the
   whole normal force of contacts that end by pull-off. */

/* What was seen between has local indices of this rebuild, which stand until the next. */

BodyFindings LargeBody::find_worst()
{
  BodyFindings worst = findings_now();
  worst.join(seen_between);
  seen_between = {};
  return worst;
}

double LargeBody::energy()
{
  is_asked = true;
  double here = dissipated + system.account().counted_of_last_step() * last_dissipated, all;
  here += for_outputs.stored_energy();
  MPI_Allreduce(&here, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double LargeBody::memory_usage() const
{
  return contacts.memory_usage() + for_outputs.memory_usage() + body_surface->memory_usage() +
         (moved_vertices ? moved_vertices->memory_usage() : 0.0);
}

}    // namespace Talus
