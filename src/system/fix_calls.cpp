// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/fix_calls.h"

#include "base/in_parallel.h"
#include "system/fix_list.h"
#include "system/granular_system.h"
#include "system/private_members.h"
#include "system/time_formula.h"

#include "atom.h"
#include "comm.h"
#include "fix.h"
#include "modify.h"
#include "neighbor.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace Talus {
namespace {

constexpr int within_steps =
    INITIAL_INTEGRATE | POST_INTEGRATE | PRE_FORCE | PRE_REVERSE | POST_FORCE | FINAL_INTEGRATE;
constexpr int integrates = INITIAL_INTEGRATE | FINAL_INTEGRATE;

}    // namespace

/* As in the sources of both hosts. What they do in steps with energies or virials may be more: those
   are in the arrays. */

const FixCalls::Window *FixCalls::window_of(const Fix *fix)
{
  static const Window windows[] = {
      {"addforce", POST_FORCE, X, F},
      {"addtorque", POST_FORCE, X | V, F},
      {"aveforce", POST_FORCE, X, F},
      {"drag", POST_FORCE, X, F},
      {"enforce2d", POST_FORCE, 0, V | OMEGA | F | TORQUE},
      {"langevin", POST_FORCE, V | OMEGA, F | TORQUE},
      {"lineforce", POST_FORCE, 0, F},
      {"move", integrates, F, X | V | OMEGA},
      {"nve", integrates, F, X | V},
      {"nve/limit", integrates, F, X | V},
      {"nve/noforce", integrates, V, X},
      {"planeforce", POST_FORCE, 0, F},
      {"setforce", POST_FORCE, X, F},
      {"smd", POST_FORCE, X, F, true},
      {"spring", POST_FORCE, X, F, true},
      {"spring/self", POST_FORCE, X, F},
      {"viscous", POST_FORCE, V, F},
      {"viscous/sphere", POST_FORCE, OMEGA, TORQUE},
      {"wall/reflect", POST_INTEGRATE, 0, X | V},
  };
  const auto *const found =
      std::find_if(std::begin(windows), std::end(windows),
                   [&](const Window &w) { return std::strcmp(w.style, fix->style) == 0; });
  return found == std::end(windows) ? nullptr : found;
}

std::string FixCalls::reason_against(const Fix *fix)
{
  const Window *const window = window_of(fix);
  const int calls = modify->get_fix_mask(const_cast<Fix *>(fix)) & within_steps;
  if (!window || (calls & ~window->calls) != 0) return "may look at particles in every step";
  const bool moves = (window->writes & X) != 0;
  if (moves && system.needs_changes())
    return "particles that it moves have no accelerations for order 2 or energies";
  if ((window->writes & TORQUE) != 0 && (window->writes & V) == 0 &&
      !system.law_table().has_friction())
    return "it acts on rotations, and contacts do not";
  const std::string of_variables = reason_of_variables(*fix);
  if (!of_variables.empty() || (window->calls & integrates) == 0) return of_variables;
  return reason_of_mover(fix);
}

std::string FixCalls::reason_of_variables(const Fix &fix) const
{
  const FixVariables variables = variables_of(fix);
  if (variables.more) return "a compute or variable of it may read particles";
  for (const char *name : variables.names)
    if (name && !reads_only_time(lmp, name))
      return std::string("variable ") + name + " reads more than time";
  return "";
}

/* Particles are moved by one fix: by this one, or in the pass through the records. */

std::string FixCalls::reason_of_mover(const Fix *fix) const
{
  constexpr int all = 1;
  for (Fix *const other : fix_list(*modify)) {
    if (other == fix) continue;
    const auto *const talus_fix = SystemFix::of(other);
    const Window *const window = talus_fix ? nullptr : window_of(other);
    const bool moves =
        talus_fix ? talus_fix->integrates() : window && (window->calls & integrates) != 0;
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

void FixCalls::copy(const Called &called, int quantities, bool to_arrays) const
{
  const ParticleState particles = system.particles();
  const bool rotates = particles.keeps_omega();
  const auto exchange = [to_arrays](double *in_records, double *in_arrays) {
    copy_row(to_arrays ? in_records : in_arrays, to_arrays ? in_arrays : in_records);
  };
  in_ranges(static_cast<int>(called.members.size()), comm->nthreads, [&](int, int begin, int end) {
    for (int n = begin; n < end; n++) {
      const int i = called.members[n];
      if (quantities & X) exchange(particles.x(i), atom->x[i]);
      if (quantities & V) exchange(particles.v(i), atom->v[i]);
      if ((quantities & OMEGA) && rotates) exchange(particles.w(i), atom->omega[i]);
      if (quantities & F) exchange(particles.f(i), atom->f[i]);
      if ((quantities & TORQUE) && rotates) exchange(particles.torque(i), atom->torque[i]);
    }
  });
}

/* As Modify does in its init(): fixes that are defined later have to wait for the next run. (Its list
   of all fixes is made anew whenever somebody asks for it, also from within a call.) */

void FixCalls::start_run()
{
  for (Phase *phase : {&initial, &post, &forces, &final}) phase->clear();
  const std::vector<Fix *> fixes = fix_list(*modify);
  for (Fix *const fix : fixes) {
    const int calls = modify->get_fix_mask(fix);
    const Called one{fix, SystemFix::of(fix) ? nullptr : window_of(fix), {}, -1, -1};
    if (calls & INITIAL_INTEGRATE) initial.push_back(one);
    if (calls & POST_INTEGRATE) post.push_back(one);
    if (calls & POST_FORCE) forces.push_back(one);
    if (calls & FINAL_INTEGRATE) final.push_back(one);
  }
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
    if (window->calls == POST_INTEGRATE) system.complete_move();
    find_members(called);
    copy(called, window->reads | window->writes, true);
    call(called.fix);
    copy(called, window->writes, false);
  }
}

void FixCalls::initial_integrate(int vflag)
{
  if (!system.pipeline().holds_state()) return modify->initial_integrate(vflag);
  call_all(initial, [vflag](Fix *fix) { fix->initial_integrate(vflag); });
}

void FixCalls::post_integrate()
{
  if (!modify->n_post_integrate) return;
  if (!system.pipeline().holds_state()) return modify->post_integrate();
  call_all(post, [](Fix *fix) { fix->post_integrate(); });
}

void FixCalls::post_force(int vflag)
{
  if (!modify->n_post_force_any) return;
  if (!system.pipeline().holds_state()) return modify->post_force(vflag);
  call_all(forces, [vflag](Fix *fix) { fix->post_force(vflag); });
}

void FixCalls::final_integrate()
{
  if (!system.pipeline().holds_state()) return modify->final_integrate();
  call_all(final, [](Fix *fix) { fix->final_integrate(); });
}

}    // namespace Talus
