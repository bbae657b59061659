// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/large_body.h"

#include "system/fix_contact_store.h"
#include "system/fix_list.h"
#include "system/granular_system.h"
#include "system/system_shapes.h"

#include "base/state_exchange.h"
#include "body/shape/mesh_shape.h"
#include "laws/second_order_laws.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

LargeBody::LargeBody(const Fix *command_fix, GranularSystem &owner, LAMMPS *lmp) :
    Pointers(lmp), fix(command_fix), system(owner), masses(lmp)
{
  specs.resize(atom->ntypes + 1);
  spec_is_set.assign(atom->ntypes + 1, false);
}

LargeBody::~LargeBody()
{
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

void LargeBody::set_shape(std::unique_ptr<LargeBodyShape> shape)
{
  body_shape = std::move(shape);
}

void LargeBody::set_frame(const BodyFrame *body_frame, bool body_moves)
{
  frame = body_frame;
  moves = body_moves;
}

void LargeBody::keep_history()
{
  const bool second_order = system.integrators().order() == 2;
  // what pair_coeff says may change
  with_history =
      type_of_laws > 0 || std::any_of(specs.begin() + 1, specs.end(), [=](const ContactSpec &s) {
        return s.law.has_history() || (second_order && second_order_law(s.law).has_history());
      });
  if (with_history)
    contacts.history.keep(body_shape->most_contacts() > 1, !body_shape->has_one_normal());
}

/* ---------------------------------------------------------------------- */

void LargeBody::init()
{
  was_asked = is_asked || fix->thermo_energy;
  is_asked = false;
  joined = false;    // a step that an error ended may have left it
  seen_between = {};
  masses.find_fixes();
  find_frozen();
  set_laws();
  if (system.integrators().order() == 1) contacts.history.forget_normals();
  if (const FixContactStore *store = system.store(); store && order_of_history == 0)
    order_of_history = store->order_of_histories();    // of a restart file
  keep_records(order_of_history != 0 && order_of_history != system.integrators().order());
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

void LargeBody::list_particles()
{
  masses.update();
  const ParticleState particles = view();
  const int *mask = mask_of_spheres();
  if (MeshShape *const mesh = moving_mesh()) mesh->settle(system.shapes() != nullptr);
  if (body_shape->wants_focus()) body_shape->focus(bounds_of_focus(particles, mask));
  contacts.find_candidates(*body_shape, *frame, particles, mask, group_bits(), neighbor->skin,
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
  return BodyCandidates::bounds_of_search(
      *frame, particles, mask, group_bits(), neighbor->skin,
      contacts.largest_pulloff_distance(particles, mask, group_bits()));
}

/* Particles with a shape belong to no group here: the system computes their contacts. */

const int *LargeBody::mask_of_spheres()
{
  const SystemShapes *shapes = system.shapes();
  if (!shapes) return atom->mask;
  spheres.assign(atom->mask, atom->mask + atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++)
    if (shapes->is_shaped(atom->type[i])) spheres[i] = 0;
  return spheres.data();
}

/* ---------------------------------------------------------------------- */

ParticleState LargeBody::view() const
{
  ParticleState particles = system.particles();
  particles.replace_masses(masses.override_or_null());
  return particles;
}

std::string LargeBody::needs_arrays() const
{
  bool turns = false;
  for (int type = 1; type <= atom->ntypes; type++) turns = turns || law_of(type).has_friction();
  if (turns && !system.pipeline().keeps_omega())
    return "it has friction and the contacts between particles have none";
  return "";
}

BodyStep LargeBody::begin_forces(bool advance)
{
  for_outputs.forget();
  BodyStep step;
  step.dt = update->dt;
  step.lag = system.integrators().lag();
  step.advance = advance;
  step.threads = comm->nthreads;
  account = system.account().part_of_step();
  step.account = accounts() ? &account : nullptr;
  step.exact = sums_exactly() ? &exact : nullptr;
  step.touched = touched;
  step.corners = corners;
  if (system.may_be_asked()) step.for_outputs = &for_outputs;
  return step;
}

bool LargeBody::join_step()
{
  joined = (comm->nthreads == 1 || body_shape->thread_safe()) &&
           contacts.begin_static(*body_shape, *frame, view(), begin_forces(true));
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
    if (contacts.is_stale(*frame, neighbor->skin)) {
      BodyFindings seen = findings_now();
      seen.join(seen_between);
      list_particles();
      seen_between = seen;
    }
    BodyStep step = begin_forces(advance);
    step.virial = virial;
    mine = contacts.compute(*body_shape, *frame, view(), step);
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
}

/* Local indices of what was seen may be others. */

void LargeBody::exchange_state(StateExchange &x)
{
  finish_reduction();
  x(mine, total, reduced, total_is_known, exact, has_forces, dissipated, last_dissipated, impulses,
    for_outputs);
  x.array(digits_here, size_digits);
  x.array(digits_of_all, size_digits);
  contacts.history.exchange_state(x);
  if (!x.restores()) return;
  contacts.history.grow(atom->nmax);
  contacts.forget_deepest();
  seen_between = {};
}

/* ---------------------------------------------------------------------- */

BodyFindings LargeBody::findings_now() const
{
  BodyFindings found = contacts.find_worst(*body_shape, *frame, view(), comm->nthreads);
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
  for_each_contact(
      [&](const ContactReport &one) { here += one.stored.normal - one.stored.detaching; });
  MPI_Allreduce(&here, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

}    // namespace Talus
