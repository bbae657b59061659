// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/host/fix_calls.h"

#include "base/in_parallel.h"
#include "system/host/fix_list.h"
#include "system/host/private_members.h"
#include "system/host/time_formula.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "fix_deform.h"
#include "group.h"
#include "modify.h"
#include "neighbor.h"
#include "region.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace Talus {
namespace {

constexpr int within_steps =
    INITIAL_INTEGRATE | POST_INTEGRATE | PRE_FORCE | PRE_REVERSE | POST_FORCE | FINAL_INTEGRATE;
constexpr int both_kicks = INITIAL_INTEGRATE | FINAL_INTEGRATE;

/// Of fix enforce2d, whose group has no other motion than in the plane; in two dimensions fix gravity acts there.
void flatten(const ParticleState &particles, int i)
{
  const bool rotates = particles.keeps_omega();
  particles.v(i)[2] = 0.0;
  if (rotates) particles.w(i)[0] = particles.w(i)[1] = 0.0;
  if (!particles.records()->was_acted_on(particles.place(i))) return;
  particles.f(i)[2] = 0.0;
  if (rotates) particles.torque(i)[0] = particles.torque(i)[1] = 0.0;
}

bool moves_particles_with_box(const Fix *fix)
{
  const auto *const deform = dynamic_cast<const FixDeform *>(fix);
  return deform && deform->remapflag == Domain::X_REMAP;
}

}    // namespace

/* As in the sources of both hosts. What they do in steps with energies or virials may be more: those
   are in the arrays. */

const FixCalls::Window *FixCalls::window_of(const Fix *fix)
{
  static const Window windows[] = {
      {"addforce", POST_FORCE, X, F},
      {"addtorque", POST_FORCE, X | V, F},
      {"add/heat", POST_FORCE, 0, 0},    // heat flows are in the arrays in any case
      {"aveforce", POST_FORCE, X, F},
      {"deform", END_OF_STEP, X, X},
      {"drag", POST_FORCE, X, F},
      {"efield", POST_FORCE, X, F | TORQUE},
      {"enforce2d", POST_FORCE, 0, V | OMEGA | F | TORQUE, false, flatten},
      {"gravity", POST_FORCE, X, F},
      {"heat/flow", PRE_FORCE | FINAL_INTEGRATE, 0, 0},
      {"indent", POST_FORCE, X, F},
      {"langevin", POST_FORCE, V | OMEGA, F | TORQUE},
      {"lineforce", POST_FORCE, 0, F},
      {"move", both_kicks, F, X | V | OMEGA},
      {"nve", both_kicks, F, X | V},
      {"nve/limit", both_kicks, F, X | V},
      {"nve/noforce", both_kicks, V, X},
      {"planeforce", POST_FORCE, 0, F},
      {"setforce", POST_FORCE, X, F},
      {"STORE/LOCAL", POST_FORCE, 0, 0},    // of bonds, which give it what it stores
      {"UPDATE_SPECIAL_BONDS", PRE_FORCE, 0, 0},
      {"smd", POST_FORCE, X, F, true},
      {"spring", POST_FORCE, X, F, true},
      {"spring/self", POST_FORCE, X, F},
      {"viscous", POST_FORCE, V, F},
      {"viscous/sphere", POST_FORCE, OMEGA, TORQUE},
      {"wall/harmonic", POST_FORCE, X, F},
      {"wall/lj1043", POST_FORCE, X, F},
      {"wall/lj126", POST_FORCE, X, F},
      {"wall/lj93", POST_FORCE, X, F},
      {"wall/morse", POST_FORCE, X, F},
      {"wall/reflect", POST_INTEGRATE, 0, X | V},
  };
  const auto *const found =
      std::find_if(std::begin(windows), std::end(windows),
                   [&](const Window &w) { return std::strcmp(w.style, fix->style) == 0; });
  return found == std::end(windows) ? nullptr : found;
}

bool FixCalls::integrates(const Window *window)
{
  return (window->calls & INITIAL_INTEGRATE) != 0;
}

/* They may be asked for numbers by others, and change variables, but no particle. */

bool FixCalls::only_reads(const Fix *fix)
{
  static const char *const styles[] = {
      "ave/atom", "ave/chunk", "ave/correlate",    "ave/correlate/long",
      "ave/grid", "ave/histo", "ave/histo/weight", "ave/time",
      "halt",     "print",     "store/state",      "vector"};
  return std::any_of(std::begin(styles), std::end(styles),
                     [fix](const char *style) { return std::strcmp(style, fix->style) == 0; });
}

/* Clumps are moved with the box. */

bool FixCalls::only_moves(const Fix *fix) const
{
  const Window *const window = window_of(fix);
  const auto fixes = fix_list(*modify);
  return window && (window->calls & END_OF_STEP) != 0 && reason_of_variables(*fix).empty() &&
         std::none_of(fixes.begin(), fixes.end(),
                      [](const Fix *other) { return other->rigid_flag != 0; });
}

std::string FixCalls::reason_against(const Fix *fix)
{
  const Window *const window = window_of(fix);
  const int calls = modify->get_fix_mask(const_cast<Fix *>(fix)) & within_steps;
  if (!window || (calls & ~window->calls) != 0) return "may look at particles in every step";
  const bool moves = (window->writes & X) != 0;
  if (moves && system.step().needs_changes())
    return "particles that it moves have no accelerations for order 2 or energies";
  if (moves && group->dynamic[fix->igroup]) return "its group is dynamic";
  if ((window->writes & TORQUE) != 0 && (window->writes & V) == 0 &&
      !system.law_table().has_friction())
    return "it acts on rotations, and contacts do not";
  const std::string of_variables = reason_of_variables(*fix);
  if (!of_variables.empty() || !integrates(window)) return of_variables;
  return reason_of_mover(fix);
}

std::string FixCalls::reason_of_variables(const Fix &fix) const
{
  const FixVariables variables = variables_of(fix);
  if (variables.more) return "a compute or variable of it may read particles";
  for (const char *name : variables.names)
    if (name && !reads_only_time(lmp, name))
      return std::string("variable ") + name + " reads more than time";
  const Region *const region =
      variables.region ? domain->get_region_by_id(variables.region) : nullptr;
  const std::string variable = region ? variable_that_may_read_particles(lmp, *region) : "";
  return variable.empty()
             ? ""
             : "its region may move with particles: v_" + variable + " reads more than time";
}

/* Particles are moved by one fix: by this one, or in the pass through the records. */

std::string FixCalls::reason_of_mover(const Fix *fix) const
{
  constexpr int all = 1;
  for (Fix *const other : fix_list(*modify)) {
    if (other == fix) continue;
    const auto *const talus_fix = SystemFix::of(other);
    const Window *const window = talus_fix ? nullptr : window_of(other);
    const bool moves = talus_fix ? talus_fix->integrates() : window && integrates(window);
    if (!moves) continue;
    int both = fix->groupbit == all || other->groupbit == all || fix->groupbit == other->groupbit;
    for (int i = 0; i < atom->nlocal && !both; i++)
      both = (atom->mask[i] & fix->groupbit) && (atom->mask[i] & other->groupbit);
    MPI_Allreduce(MPI_IN_PLACE, &both, 1, MPI_INT, MPI_LOR, world);
    if (both) return std::string("fix ") + other->id + " may move the same particles";
  }
  return "";
}

/* ---------------------------------------------------------------------- */

namespace {

inline void copy_row(const double *from, double *to)
{
  for (int d = 0; d < 3; d++) to[d] = from[d];
}

}    // namespace

/* Particles get other indices with new neighbor lists only. */

void FixCalls::find_members(Called &called) const
{
  if (called.lists == neighbor->ncalls && called.owned == atom->nlocal) return;
  called.lists = neighbor->ncalls;
  called.owned = atom->nlocal;
  called.members.clear();
  const int bits = called.window->whole ? 1 : called.fix->groupbit;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & bits) called.members.push_back(i);
}

template <class Visit> void FixCalls::for_each_member(const Called &called, Visit visit) const
{
  in_ranges(static_cast<int>(called.members.size()), comm->nthreads, [&](int, int begin, int end) {
    for (int n = begin; n < end; n++) visit(called.members[n]);
  });
}

void FixCalls::copy(const Called &called, int quantities, bool to_arrays) const
{
  if (quantities == 0) return;
  const ParticleState particles = system.step().particles();
  const bool rotates = particles.keeps_omega();
  const auto exchange = [to_arrays](double *in_records, double *in_arrays) {
    copy_row(to_arrays ? in_records : in_arrays, to_arrays ? in_arrays : in_records);
  };
  for_each_member(called, [&](int i) {
    if (quantities & X) exchange(particles.x(i), atom->x[i]);
    if (quantities & V) exchange(particles.v(i), atom->v[i]);
    if ((quantities & OMEGA) && rotates) exchange(particles.w(i), atom->omega[i]);
    if (quantities & F) exchange(particles.f(i), atom->f[i]);
    if ((quantities & TORQUE) && rotates) exchange(particles.torque(i), atom->torque[i]);
  });
}

/* As Modify does in its init(): fixes that are defined later have to wait for the next run. (Its list
   of all fixes is made anew whenever somebody asks for it, also from within a call.) */

void FixCalls::start_run()
{
  for (Phase *phase : {&initial, &post, &forces, &final, &end}) phase->clear();
  groups.clear();
  readers.clear();
  const std::vector<Fix *> fixes = fix_list(*modify);
  for (Fix *const fix : fixes) {
    const int calls = modify->get_fix_mask(fix);
    const Called one{fix, SystemFix::of(fix) ? nullptr : window_of(fix), {}, -1, -1};
    if (calls & INITIAL_INTEGRATE) initial.push_back(one);
    if (calls & POST_INTEGRATE) post.push_back(one);
    if (calls & POST_FORCE) forces.push_back(one);
    if (calls & FINAL_INTEGRATE) final.push_back(one);
    if (calls & END_OF_STEP && only_reads(fix)) readers.push_back(fix);
    if (calls & END_OF_STEP && one.window && moves_particles_with_box(fix)) end.push_back(one);
    if (std::strcmp(fix->style, "GROUP") == 0) groups.push_back(fix);
  }
  asking_groups = std::any_of(groups.begin(), groups.end(),
                              [this](Fix *fix) { return !reads_positions_alone(fix); });
  // Those that move particles come first: their forces are cleared on the way through the records,
  // which may begin with the last integrator of Talus. They have no particle in common with it.
  std::stable_partition(initial.begin(), initial.end(),
                        [](const Called &one) { return one.window != nullptr; });
}

template <class Call> void FixCalls::call_all(Phase &phase, Call call)
{
  for (Called &called : phase) {
    const Window *const window = called.window;
    if (!window) {
      call(called.fix);
      continue;
    }
    if (window->calls == POST_INTEGRATE) system.step().complete_move();
    find_members(called);
    if (window->on_one) {
      const ParticleState particles = system.step().particles();
      for_each_member(called, [&](int i) { window->on_one(particles, i); });
      continue;
    }
    copy(called, window->reads | window->writes, true);
    call(called.fix);
    copy(called, window->writes, false);
  }
}

void FixCalls::initial_integrate(int vflag)
{
  if (!system.pipeline().motion().holds_state()) return modify->initial_integrate(vflag);
  call_all(initial, [vflag](Fix *fix) { fix->initial_integrate(vflag); });
}

void FixCalls::post_integrate()
{
  if (!modify->n_post_integrate) return;
  if (!system.pipeline().motion().holds_state()) return modify->post_integrate();
  call_all(post, [](Fix *fix) { fix->post_integrate(); });
}

void FixCalls::post_force(int vflag)
{
  if (!modify->n_post_force_any) return;
  const bool in_records = system.pipeline().motion().holds_state();
  if (groups_are_due()) {
    forget_members();
    if (in_records) update_groups(vflag);
  }
  if (!in_records) return modify->post_force(vflag);
  call_all(forces, [vflag](Fix *fix) { fix->post_force(vflag); });
}

void FixCalls::final_integrate()
{
  if (!system.pipeline().motion().holds_state()) return modify->final_integrate();
  call_all(final, [](Fix *fix) { fix->final_integrate(); });
}

bool FixCalls::groups_are_due() const
{
  return std::any_of(groups.begin(), groups.end(),
                     [this](const Fix *fix) { return update->ntimestep % fix->nevery == 0; });
}

void FixCalls::forget_members()
{
  for (Phase *phase : {&initial, &post, &forces, &final, &end})
    for (Called &called : *phase) called.lists = -1;
}

/* A region needs positions of particles of this rank alone; what else decides on members may read
   all that a formula can tell of particles. */

bool FixCalls::reads_positions_alone(Fix *group_fix) const
{
  int unused = 0;
  if (group_fix->extract("variable", unused) || neighbor->find_request(group_fix)) return false;
  const auto *const id = static_cast<const char *>(group_fix->extract("region", unused));
  const Region *const region = id ? domain->get_region_by_id(id) : nullptr;
  return !region || variable_that_may_read_particles(lmp, *region).empty();
}

void FixCalls::update_groups(int vflag)
{
  if (std::all_of(groups.begin(), groups.end(),
                  [this](Fix *fix) { return reads_positions_alone(fix); })) {
    const ParticleState particles = system.step().particles();
    in_ranges(atom->nlocal, comm->nthreads, [&](int, int begin, int end) {
      for (int i = begin; i < end; i++) copy_row(particles.x(i), atom->x[i]);
    });
  } else {
    system.step().show_particles();
  }
  for (Fix *const fix : groups) fix->post_force(vflag);
}

bool FixCalls::somebody_looks() const
{
  const bigint now = update->ntimestep;
  return std::any_of(readers.begin(), readers.end(), [now](const Fix *fix) {
    const bigint next = next_reading_of(*fix);
    return now % fix->nevery == 0 && (next < 0 || next == now);
  });
}

void FixCalls::end_of_step()
{
  if (!modify->n_end_of_step) return;
  if (!system.pipeline().motion().holds_state()) return modify->end_of_step();
  if (somebody_looks()) system.step().show_step();
  const auto copy_moved = [this](bool to_arrays) {
    bool any = false;
    for (Called &called : end) {
      if (update->ntimestep % called.fix->nevery) continue;
      find_members(called);
      copy(called, X, to_arrays);
      any = true;
    }
    return any;
  };
  copy_moved(true);
  modify->end_of_step();
  if (copy_moved(false)) system.step().forget_moves();
}

}    // namespace Talus
