// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of particles with a shape: at a rebuild, and in a step.

#include "system/shapes/shaped_particles.h"

#include "system/bodies/large_body.h"
#include "system/contacts/fix_contact_store.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"

using namespace LAMMPS_NS;

namespace Talus {

bool ShapedParticles::in_periodic_box() const
{
  return domain->xperiodic || domain->yperiodic || domain->zperiodic;
}

/* In a periodic box the rank of the first particle decides. */

void ShapedParticles::put_aside(ContactLists &to)
{
  if (in_periodic_box()) {
    const HistoryStore &store = system.memory().pairs();
    pairs_here.save_in_periodic_box(
        to, comm->me, [&](int i) { return store.owner_of_ghost(atom->nlocal, i); },
        for_other_ranks);
  } else {
    pairs_here.save(to);
  }
  for (const auto &[body, points] : bodies) points.save(to);
}

/* A rank may have put its contacts aside before the others. */

void ShapedParticles::agree_with_other_ranks()
{
  if (agreed) return;
  agreed = true;
  exchange.run(for_other_ranks, 0, [this](const std::vector<double> &m) {
    pairs_here.receive(m, system.memory().lists_to_fill());
  });
  for_other_ranks.clear();
}

void ShapedParticles::forget(const LargeBody &body)
{
  bodies.erase(&body);
  const std::int64_t name = name_of(body);
  system.memory().lists_to_fill().remove_if(
      [&](const ContactLists::Contact &one) { return owns(one) && one.partner == name; });
}

/* Histories go on from here: all bodies have to have taken theirs, also those that are touched later in the step. */

void ShapedParticles::begin_step()
{
  if (in_periodic_box()) agreed = false;
  if (!is_at_rest()) return;
  for (LargeBody *body : system.bodies().in_order()) points_with_particles(*body);
  system.memory().are_taken(*this);
}

void ShapedParticles::set_pairs(const std::vector<std::array<int, 2>> &found)
{
  require_set_up();
  const int nall = atom->nlocal + atom->nghost;
  const std::vector<std::int64_t> tags(atom->tag, atom->tag + nall);
  pairs_here.set_pairs(view(), found, tags, system.law_table());
  const HistoryStore &store = system.memory().pairs();
  pairs_here.restore(system.memory().lists(), [&](int i) { return store.origin(i).name; });
  for (auto &[body, points] : bodies) list_particles(*body, points);
}

BodyPoints &ShapedParticles::points_of(LargeBody &body)
{
  return bodies.try_emplace(&body, body.shape(), shapes, name_of(body)).first->second;
}

/* There may be a new body since the rebuild. */

BodyPoints &ShapedParticles::points_with_particles(LargeBody &body)
{
  BodyPoints &points = points_of(body);
  if (!points.has_particles()) list_particles(body, points);
  return points;
}

void ShapedParticles::list_particles(const LargeBody &body, BodyPoints &points)
{
  std::vector<int> particles;
  for (int i = 0; i < atom->nlocal; i++)
    if (is_shaped(atom->type[i]) && (atom->mask[i] & body.group_bits())) particles.push_back(i);
  points.set_particles(view(), particles, system.memory().lists());
}

/* Called in a step: a run without set-up knows neither the pairs nor the ghosts of shapes. */

void ShapedParticles::require_set_up() const
{
  if (!is_set_up)
    error->all(
        FLERR, Error::NOLASTLINE,
        "Fix shape/gran: 'run ... pre no' cannot follow a new fix shape/gran: leave 'pre no' "
        "out");
}

/* ---- a step ---- */

ShapedView ShapedParticles::view() const
{
  if (atom->nlocal + atom->nghost == 0) return {};
  return {system.step().particles(), atom->nlocal + atom->nghost, quat[0]};
}

/* The direct exchange brings them with positions, a rebuild with its ghosts. */

void ShapedParticles::send_orientations()
{
  const DirectExchange *direct = system.exchange().direct();
  if (direct && direct->has_plan() && !orientations_were_set) return;
  comm->forward_comm(fix, size_orientation);
  orientations_were_set = false;
}

void ShapedParticles::compute_contacts(const ContactStep &step)
{
  require_set_up();
  send_orientations();
  if (step.advance) begin_step();
  pairs_here.compute(view(), system.law_table(),
                     {step.dt, step.advance, comm->nthreads, step.account, step.weight_of_changes});
  if (step.tally) tell_pairs(step);
}

/* To LAMMPS, which sums energies and virials. */

void ShapedParticles::tell_pairs(const ContactStep &step) const
{
  pairs_here.for_each_force([&](int i, int j, const Vector3<double> &force) {
    const double *a = atom->x[i], *b = atom->x[j];
    (*step.tally)({i,
                   j,
                   i < atom->nlocal,
                   j < atom->nlocal,
                   {force.x, force.y, force.z},
                   {a[0] - b[0], a[1] - b[1], a[2] - b[2]}});
  });
}

BodyLoad ShapedParticles::touch_body(LargeBody &body, const BodyStep &step)
{
  if (step.advance) begin_step();
  return points_with_particles(body).compute(body.frame(), view(), body.law_table(), step);
}

std::int64_t ShapedParticles::name_of(const LargeBody &body)
{
  return ContactMemory::name_of(body.command()->id);
}

std::string ShapedParticles::refusal(LargeBody &body)
{
  return points_of(body).refusal();
}

}    // namespace Talus
