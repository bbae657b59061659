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

void ShapedParticles::keep_histories()
{
  if (histories_are_current) return;
  histories.clear();
  if (domain->xperiodic || domain->yperiodic || domain->zperiodic) {
    ShapedPairs::Messages messages;
    const HistoryStore &store = system.store()->histories();
    pairs_here.save_in_periodic_box(
        histories, comm->me, [&](int i) { return store.owner_of_ghost(atom->nlocal, i); },
        messages);
    exchange.run(messages, 0,
                 [this](const std::vector<double> &m) { pairs_here.receive(m, histories); });
  } else {
    pairs_here.save(histories);
  }
  for (auto &[body, wall] : walls)
    if (wall.points) wall.points->save(histories);
  histories_are_current = true;
  announce_size();
}

void ShapedParticles::announce_size()
{
  fix->maxexchange = largest_packed();
}

void ShapedParticles::set_pairs(const std::vector<std::array<int, 2>> &found)
{
  require_set_up();
  const int nall = atom->nlocal + atom->nghost;
  const std::vector<std::int64_t> tags(atom->tag, atom->tag + nall);
  pairs_here.set_pairs(view(), found, tags, system.law_table());
  pairs_here.restore(histories);
  for (auto &[body, wall] : walls)
    if (wall.points) list_particles(*body, *wall.points);
}

void ShapedParticles::list_particles(const LargeBody &body, WallPoints &points)
{
  std::vector<int> particles;
  for (int i = 0; i < atom->nlocal; i++)
    if (is_shaped(atom->type[i]) && (atom->mask[i] & body.group_bits())) particles.push_back(i);
  points.set_particles(particles);
  points.restore(histories);
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
  pairs_here.compute(view(), system.law_table(),
                     {step.dt, step.advance, comm->nthreads, step.account, step.weight_of_changes});
  if (step.advance) histories_are_current = false;
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

ShapedParticles::Wall &ShapedParticles::wall_of(LargeBody &body)
{
  Wall &wall = walls[&body];
  if (!wall.surfaces) wall.surfaces = std::make_unique<BodySurfaces>(body.shape(), shapes);
  return wall;
}

BodyLoad ShapedParticles::touch_body(LargeBody &body, const BodyStep &step)
{
  Wall &wall = wall_of(body);
  if (!wall.points) {
    wall.points = std::make_unique<WallPoints>(shapes, name_of(body));
    list_particles(body, *wall.points);
  }
  if (step.advance) histories_are_current = false;
  wall.surfaces->follow();
  return wall.points->compute(*wall.surfaces, body.frame(), view(), body.law_table(), step);
}

/* Negative, for IDs of particles are positive; the same in a run that goes on from a file. */

std::int64_t ShapedParticles::name_of(const LargeBody &body)
{
  std::uint64_t hash = 14695981039346656037U;    // FNV-1a
  for (const char *c = body.command()->id; *c; c++)
    hash = (hash ^ static_cast<unsigned char>(*c)) * 1099511628211U;
  return -static_cast<std::int64_t>(hash >> 1) - 1;
}

std::string ShapedParticles::refusal(LargeBody &body)
{
  return wall_of(body).surfaces->refusal();
}

}    // namespace Talus
