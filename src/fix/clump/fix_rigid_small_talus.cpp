/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "fix/clump/fix_rigid_small_talus.h"

#include "base/rows.h"
#include "fix/motion/plain_style.h"
#include "system/host/restart_data.h"

#include "atom.h"
#include "base/in_parallel.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using ClumpState = Talus::ClumpState<double>;
using Talus::put;
using Talus::row;
using Vector = Talus::Vector3<double>;

// see RecordStep::extrapolation: velocities are half a step behind positions
static constexpr double half_of_change = 0.5;

/* ---------------------------------------------------------------------- */

FixRigidSmallTalus::FixRigidSmallTalus(LAMMPS *lmp, int narg, char **arg) :
    FixRigidSmall(lmp, narg, with_masses(lmp, narg, arg)), system(Talus::GranularSystem::of(lmp)),
    extrapolation(half_of_change)
{
  restart_peratom = 1;
  atom->add_callback(Atom::RESTART);
}

FixRigidSmallTalus::~FixRigidSmallTalus()
{
  if (modify->get_fix_by_id(id)) atom->delete_callback(id, Atom::RESTART);
}

void FixRigidSmallTalus::post_constructor()
{
  restore_style(this, "rigid/small");
}

/* The owner of a sphere needs those of the whole clump, two of which may be twice as far from each
   other as from the one in the middle, that the stock style needs. */

void FixRigidSmallTalus::init()
{
  Talus::require_intact_particles(lmp);
  FixRigidSmall::init();
  const int mine = restored;    // a rank without particles has not been told
  int from_file = 0;
  MPI_Allreduce(&mine, &from_file, 1, MPI_INT, MPI_MAX, world);
  restored = from_file != 0;
  reason = find_reason();
  if (!reason.empty()) return;
  comm->cutghostuser = std::max(comm->cutghostuser, 2.0 * maxextent);
}

std::string FixRigidSmallTalus::find_reason()
{
  return system->pair_style().is_there() ? reason_of_settings()
                                         : system->pair_style().reason_against();
}

std::string FixRigidSmallTalus::reason_of_settings() const
{
  if (langflag) return "its thermostat acts on bodies";
  if (earlyflag) return "'fix_modify bodyforces early' is set";
  if (update->whichflag == 2) return "there are no time steps in a minimization";
  if (utils::strmatch(update->integrate_style, "^respa")) return "run_style respa has levels";
  return reason_of_spheres();
}

std::string FixRigidSmallTalus::reason_of_spheres() const
{
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag ||
      atom->mu_flag || atom->ellipsoid_flag || atom->line_flag || atom->tri_flag)
    return std::string("its particles are not those of atom style sphere");
  int mine = 0, all = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if (bodytag[i] && !(atom->radius[i] > 0.0)) mine = 1;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, world);
  return all ? "some of its particles have no radius" : "";
}

std::string FixRigidSmallTalus::needs_arrays()
{
  if (!reason.empty()) return reason;
  return system->pipeline().keeps_omega()
             ? ""
             : "it turns particles and the contacts between them do not";
}

int FixRigidSmallTalus::threads() const
{
  return comm->nthreads;
}

double FixRigidSmallTalus::force_unit() const
{
  return force->ftm2v;
}

/* ----------------------------------------------------------------------
   a step
------------------------------------------------------------------------- */

ClumpState FixRigidSmallTalus::state_of(const Body &b)
{
  ClumpState s;
  s.mass = b.mass;
  const auto inverse = [](double moment) { return moment == 0.0 ? 0.0 : 1.0 / moment; };
  s.inverse_inertia = {inverse(b.inertia[0]), inverse(b.inertia[1]), inverse(b.inertia[2])};
  s.position = row(b.xcm);
  s.velocity = row(b.vcm);
  s.momentum = row(b.angmom);
  s.omega = row(b.omega);
  s.quat = {b.quat[0], b.quat[1], b.quat[2], b.quat[3]};
  s.axes = s.quat.axes();
  return s;
}

void FixRigidSmallTalus::put_state(const ClumpState &s, Body &b)
{
  put(s.position, b.xcm);
  put(s.velocity, b.vcm);
  put(s.momentum, b.angmom);
  put(s.omega, b.omega);
  const double quat[4] = {s.quat.w, s.quat.x, s.quat.y, s.quat.z};
  std::copy(quat, quat + 4, b.quat);
  put(s.axes.x, b.ex_space);
  put(s.axes.y, b.ey_space);
  put(s.axes.z, b.ez_space);
}

FixRigidSmallTalus::Loads FixRigidSmallTalus::load_of(const ClumpSphere &s) const
{
  if (s.owned) return particles.load(s.atom);
  const double *received = row_of(s);
  return {row(received), row(received + 3)};
}

FixRigidSmallTalus::Loads FixRigidSmallTalus::loads_on(int clump, const ClumpState &state) const
{
  Loads sum{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  for (const ClumpSphere *s = table.begin(clump); s != table.end(clump); s++) {
    const Loads one = load_of(*s);
    sum.force = sum.force + one.force;
    sum.torque = sum.torque + (cross(state.axes.to_space(s->place), one.force) + one.torque);
  }
  if (domain->dimension == 2) sum.force.z = sum.torque.x = sum.torque.y = 0.0;
  return sum;
}

Vector FixRigidSmallTalus::shift_of(const ClumpSphere &s) const
{
  if (!s.wrapped) return {0.0, 0.0, 0.0};
  Vector shift{s.periods[0] * domain->xprd, s.periods[1] * domain->yprd,
               s.periods[2] * domain->zprd};
  if (domain->triclinic) {
    shift.x += s.periods[1] * domain->xy + s.periods[2] * domain->xz;
    shift.y += s.periods[2] * domain->yz;
  }
  return shift;
}

/* ----------------------------------------------------------------------
   eight clumps at a time
------------------------------------------------------------------------- */

bool FixRigidSmallTalus::moves_in_lanes() const
{
  return particles.records() && !evflag;
}

void FixRigidSmallTalus::fill_lanes()
{
  lanes.make(table, *particles.records(), particles.order(), domain->dimension == 2);
  for (int c = 0; c < table.size(); c++) lanes.set(c, state_of(body[table.body[c]]));
}

void FixRigidSmallTalus::take_from_lanes()
{
  if (!lanes.are_current()) return;
  for (int c = 0; c < table.size(); c++) put_state(lanes.get(c), body[table.body[c]]);
  lanes.forget();
}

void FixRigidSmallTalus::leave_records()
{
  take_from_lanes();
  kick_is_due = false;    // complete_step() gives it, or the step is over without it
}

/* ----------------------------------------------------------------------
   one clump after another
------------------------------------------------------------------------- */

FixRigidSmallTalus::SphereVelocity FixRigidSmallTalus::velocity_of(const ClumpSphere &s) const
{
  return {particles.velocity(s.atom), particles.angular_velocity(s.atom)};
}

void FixRigidSmallTalus::keep_change(Talus::ChangeRecord &change, const ClumpSphere &s,
                                     const SphereVelocity &old) const
{
  const auto record = [](const Vector &a) { return Talus::four(a.x, a.y, a.z, 0.0); };
  const SphereVelocity now = velocity_of(s);
  store(change, Talus::change_by_kick(extrapolation, atom->radius[s.atom], record(old.v),
                                      record(now.v), record(old.omega), record(now.omega)));
}

/* The virial of the forces that hold the spheres together: what their velocities changed by beyond
   what is accounted for, at the places before. */

void FixRigidSmallTalus::place_spheres(int clump, const ClumpState &state,
                                       const Talus::SphereMotion<double> &motion, Body &b,
                                       SphereUpdate what, const Kick &kick,
                                       const SphereVelocity *before)
{
  const bool moves = what == SphereUpdate::POSITIONS_AND_VELOCITIES;
  const bool tallies = evflag && kick.share > 0.0;
  const bool flat = domain->dimension == 2;
  for (const ClumpSphere *s = table.begin(clump); s != table.end(clump); s++) {
    if (!s->owned) continue;
    const int i = s->atom;
    double *const x = particles.x(i), *const v = particles.v(i), *const w = particles.w(i);
    const Vector x_old = row(x);
    const SphereVelocity old = velocity_of(*s);
    const Vector arm = state.axes.to_space(s->place);
    const Vector shift = shift_of(*s);
    if (moves) put(arm + (state.position - shift), x);
    if (flat && moves) x[2] = 0.0;
    if (what != SphereUpdate::NOTHING) {
      put(motion.velocity_at(s->place), v);
      if (flat) v[2] = 0.0;
      put(motion.omega, w);
    }
    if (Talus::ChangeRecord *change = moves ? particles.change(i) : nullptr)
      keep_change(*change, *s, before ? before[s - table.begin(clump)] : old);
    if (!tallies) continue;

    const Vector change = row(v) - old.v - row(kick.gravity_kick);
    const Vector holds = (atom->rmass[i] / kick.time) * change - particles.force(i);
    const Vector at = x_old + shift, part = kick.share * holds;
    double virial_of[6] = {at.x * part.x, at.y * part.y, at.z * part.z,
                           at.x * part.y, at.x * part.z, at.y * part.z};
    double place[1][3], forces[1][3], center[3] = {b.xgc[0], b.xgc[1], b.xgc[2]};
    put(at, place[0]);
    put(part, forces[0]);
    int list = i;
    v_tally(1, &list, 1.0, virial_of, place, forces, center);
  }
  if (evflag && moves) put(state.position + state.axes.to_space(row(b.xgc_body)), b.xgc);
}

/* ---------------------------------------------------------------------- */

void FixRigidSmallTalus::setup(int vflag)
{
  if (!reason.empty()) return FixRigidSmall::setup(vflag);
  v_init(vflag);
  kick_is_due = false;
  find_particles();
  share_loads();
  for_each_clump([&](int clump, Body &b) {
    ClumpState s = state_of(b);
    const Loads sum = loads_on(clump, s);
    put(sum.force, b.fcm);
    put(sum.torque, b.torque);
    s.omega = s.omega_now();
    put_state(s, b);
    place_spheres(clump, s, sphere_motion_of(s), b,
                  states_known ? SphereUpdate::NOTHING : SphereUpdate::VELOCITIES,
                  {dtf, {0.0, 0.0, 0.0}, 1.0});
  });
}

void FixRigidSmallTalus::initial_integrate(int vflag)
{
  if (!reason.empty()) return FixRigidSmall::initial_integrate(vflag);
  v_init(vflag);
  find_particles();
  if (kick_is_due) share_loads();
  if (kick_is_due && moves_in_lanes())
    move_in_lanes([this](auto &s, auto loads) {
      if (id_gravity) loads.force = loads.force + weight(s.mass);
      s.kick(dtf, loads.force, loads.torque);
      s.kick(dtf, loads.force, loads.torque);
      s.drift_extrapolated(dtv);
      return s.sphere_motion();
    });
  else
    begin_step();
  kick_is_due = false;
  system->step().advance(this, record_step(dtf));
}

Talus::RecordStep FixRigidSmallTalus::record_step(double kick) const
{
  Talus::RecordStep step{update->dt, kick, {0.0, 0.0, 0.0}, 0.4};
  step.extrapolation = extrapolation;
  return step;
}

/* The last step is completed first, if that has been put off, without its part of virials; changes of
   velocities are those by both kicks. */

void FixRigidSmallTalus::begin_step()
{
  take_from_lanes();
  for_each_clump([&](int clump, Body &b) {
    std::vector<SphereVelocity> before;
    if (kick_is_due) {
      for (const ClumpSphere *s = table.begin(clump); s != table.end(clump); s++)
        before.push_back(s->owned ? velocity_of(*s) : SphereVelocity{});
      end_step(clump, b, 0.0);
    }
    ClumpState s = state_of(b);
    s.kick(dtf, row(b.fcm), row(b.torque));
    s.drift_extrapolated(dtv);
    put_state(s, b);
    place_spheres(clump, s, s.sphere_motion(), b, SphereUpdate::POSITIONS_AND_VELOCITIES,
                  {dtf, {0.0, 0.0, 0.0}, 0.5}, before.empty() ? nullptr : before.data());
  });
}

/* Put off while particles stay in the records. */

void FixRigidSmallTalus::final_integrate()
{
  if (!reason.empty()) return FixRigidSmall::final_integrate();
  kick_is_due = true;
  system->step().complete_step_of(*this);
}

void FixRigidSmallTalus::complete_step()
{
  find_particles();
  take_from_lanes();
  share_loads();
  for_each_clump([&](int clump, Body &b) { end_step(clump, b, 0.5); });
  kick_is_due = false;
}

void FixRigidSmallTalus::end_step(int clump, Body &b, double share_of_virial)
{
  ClumpState s = state_of(b);
  Loads loads = loads_on(clump, s);
  if (id_gravity) loads.force = loads.force + weight(s.mass);
  put(loads.force, b.fcm);
  put(loads.torque, b.torque);
  s.kick(dtf, loads.force, loads.torque);
  s.omega = s.omega_now();
  put_state(s, b);
  place_spheres(clump, s, s.sphere_motion(), b, SphereUpdate::VELOCITIES,
                {dtf, {0.0, 0.0, 0.0}, share_of_virial});
}
