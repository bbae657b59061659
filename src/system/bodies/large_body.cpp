// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/bodies/large_body.h"

#include "system/contacts/fix_contact_store.h"
#include "system/host/fix_list.h"
#include "system/regions/region_shape.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"

#include "body/shape/mesh_shape.h"
#include "laws/second_order_laws.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

LargeBody::LargeBody(const Fix *command_fix, GranularSystem &owner, LargeBodySpec spec,
                     LAMMPS *lmp) :
    Pointers(lmp),
    fix(command_fix), system(owner), body_shape(std::move(spec.shape)),
    body_motion(lmp, spec.motion, *body_shape),
    body_surface(
        std::make_unique<LargeBodySurface>(lmp, *body_shape, body_shape->as_mesh(), spec.surface)),
    side(lmp, body_shape->as_mesh()), monitor(lmp, *this), specs(std::move(spec.laws)),
    type_of_laws(spec.type_of_laws), temperature(std::move(spec.temperature)), masses(lmp)
{
  if (body_motion.deforms())
    moved_vertices = std::make_unique<LargeBodyVertices>(lmp, *body_shape->as_mesh());
  follow_region();
  keep_history();
  system.run_monitor().add(this, monitor.checks());
}

LargeBody::~LargeBody()
{
  system.run_monitor().remove(this);
  finish_reduction();
}

int LargeBody::group_bits() const
{
  return fix->groupbit;
}

std::string LargeBody::name() const
{
  return std::string("fix large/body ") + fix->id;
}

bool LargeBody::has_state() const
{
  return body_motion.moves() || body_surface->records() || side.is_open();
}

void LargeBody::keep_history()
{
  const bool second_order = system.integrators().order() == 2;
  // what pair_coeff says may change
  with_history =
      type_of_laws > 0 || std::any_of(specs.begin() + 1, specs.end(), [=](const ContactSpec &s) {
        return s.law.has_history() || (second_order && second_order_law(s.law).has_history());
      });
  if (!with_history) return;
  contacts.history.keep(body_shape->most_contacts() > 1, !body_shape->has_one_normal());
  contacts.history.rest_in(system.memory(), ContactMemory::name_of(fix->id));
}

/* ---------------------------------------------------------------------- */

void LargeBody::init()
{
  if (with_history) system.contact_store().require(std::string("Fix large/body ") + fix->id);
  body_motion.init();
  monitor.start();
  system.run_monitor().start();
  follow_region();
  was_asked = is_asked || fix->thermo_energy;
  is_asked = false;
  joined = false;    // a step that an error ended may have left it
  seen_between = {};
  masses.find_fixes();
  find_frozen();
  set_laws();
  check_heat();
  if (system.integrators().order() == 1) contacts.history.forget_normals();
  if (const FixContactStore *store = system.store(); store && order_of_history == 0)
    order_of_history = store->order_of_histories();    // of a restart file
  keep_records(order_of_history != 0 && order_of_history != system.integrators().order());
}

/* It may have been deleted and defined again since the last run, and move now. */

void LargeBody::follow_region()
{
  auto *shape_of_region = dynamic_cast<RegionShape *>(body_shape.get());
  if (!shape_of_region) return;
  Region *region = domain->get_region_by_id(shape_of_region->region_id());
  if (!region)
    error->all(FLERR, "Fix large/body {}: region '{}' is gone: define it again before the run",
               fix->id, shape_of_region->region_id());
  const std::string refusal = RegionShape::refusal(*region, body_motion.has_own());
  if (!refusal.empty()) error->all(FLERR, "Fix large/body {}: {}", fix->id, refusal);
  shape_of_region->take(*region, *domain);
  if (!body_motion.has_own()) body_motion.follow(*region, shape_of_region->reference_point());
}

/* A fix freeze that stands before the body in the script has done its work when the body adds its
   forces. */

void LargeBody::find_frozen()
{
  already_frozen = 0;
  for (const auto &ifix : fix_list(*modify)) {
    if (ifix == fix) break;
    if (utils::strmatch(ifix->style, "^freeze")) already_frozen |= ifix->groupbit;
  }
}

void LargeBody::clear_frozen()
{
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & already_frozen)) continue;
    std::fill(atom->f[i], atom->f[i] + 3, 0.0);
    std::fill(atom->torque[i], atom->torque[i] + 3, 0.0);
  }
}

/* ---------------------------------------------------------------------- */

/* The load is that of the step before. */

void LargeBody::advance()
{
  watch_steps();
  body_motion.advance(body_motion.driven_by_load() ? exact_load() : BodyLoad{},
                      system.integrators().lag());
  if (moved_vertices) moved_vertices->begin_step(system.integrators().kicks());
}

void LargeBody::stand_still()
{
  if (moved_vertices) body_shape->as_mesh()->moving()->stand_still();
}

std::string LargeBody::guide(const BodyState &state, int steps)
{
  double reach;
  const double reach_here = contacts.reach();
  MPI_Allreduce(&reach_here, &reach, 1, MPI_DOUBLE, MPI_MAX, world);
  return body_motion.guide(state, steps, neighbor->skin, reach);
}

std::string LargeBody::guide_vertices(const MovingVertices::Places &places,
                                      const MovingVertices::Places *velocities, int steps)
{
  return body_shape->as_mesh()->guide(places, velocities, steps, update->dt, neighbor->skin);
}

ParticleState LargeBody::view() const
{
  ParticleState particles = system.step().particles();
  particles.replace_masses(masses.override_or_null());
  return particles;
}

std::string LargeBody::needs_arrays() const
{
  if (body_motion.asks_variables() || (temperature && temperature->reads_more_than_time(lmp)))
    return "its variables may read particles";
  bool turns = false;
  for (int type = 1; type <= atom->ntypes; type++) turns = turns || law_of(type).has_friction();
  if (turns && !system.pipeline().keeps_omega())
    return "it has friction and the contacts between particles have none";
  return "";
}

BodyStep LargeBody::begin_forces(bool advance)
{
  for_outputs.begin(system.account().has_observers());
  BodyStep step;
  step.dt = update->dt;
  step.lag = system.integrators().lag();
  step.advance = advance;
  step.threads = comm->nthreads;
  account = system.account().part_of_step();
  step.account = accounts() ? &account : nullptr;
  step.exact = sums_exactly() ? &exact : nullptr;
  if (body_surface->records()) step.touched = body_surface->touched();
  if (moved_vertices) step.corners = moved_vertices->touched();
  if (system.step().may_be_asked()) step.for_outputs = &for_outputs;
  step.heat = heat();
  return step;
}

BodyHeat LargeBody::heat()
{
  if (!temperature) return {};
  if (temperature->is_variable()) modify->clearstep_compute();
  const double now = temperature->evaluate(lmp);
  if (temperature->is_variable()) modify->addstep_compute(update->ntimestep + 1);
  if (!std::isfinite(now))
    error->all(FLERR, "Fix large/body {}: the temperature is not finite", fix->id);
  return {atom->temperature, now, atom->heatflow};
}

/* Heat flows are summed in the arrays, in the order of the commands, after those of pairs. */

bool LargeBody::join_step()
{
  joined = !temperature && (comm->nthreads == 1 || body_shape->thread_safe()) &&
           contacts.begin_static(*body_shape, frame(), view(), begin_forces(true));
  return joined;
}

void LargeBody::compute(bool advance, double *virial)
{
  finish_reduction();
  if (is_watched() && !advance) settled_impulses();    // these forces are found again
  exact_is_known = sums_exactly();
  if (joined) {
    mine = contacts.static_load();
    account.sum = contacts.static_work();
  } else {
    if (contacts.is_stale(frame(), neighbor->skin)) {
      BodyFindings seen = findings_now();
      seen.join(seen_between);
      list_particles();
      seen_between = seen;
    }
    BodyStep step = begin_forces(advance);
    step.virial = virial;
    mine = contacts.compute(*body_shape, frame(), view(), step);
    if (system.shapes()) mine.add(system.shapes()->touch_body(*this, step));
  }
  joined = reduced = total_is_known = false;
  has_forces = true;
  if (is_watched()) see_load();
  if (accounts()) {
    const double before = std::exchange(last_dissipated, account.sum.total());
    if (advance) dissipated += before;
    system.account().add(account.sum);
  }
  if (already_frozen) clear_frozen();
  body_surface->add_step(advance ? update->dt : 0.0);
  if (moved_vertices) moved_vertices->end_step(advance);
  if (body_motion.driven_by_load() || is_watched()) begin_reduction();
}

}    // namespace Talus
