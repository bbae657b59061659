// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/bodies/large_body_motion.h"

#include "base/words.h"
#include "system/host/time_formula.h"
#include "system/regions/region_surface.h"

#include "domain.h"
#include "error.h"
#include "force.h"
#include "input.h"
#include "modify.h"
#include "region.h"
#include "update.h"
#include "utils.h"
#include "variable.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

using namespace LAMMPS_NS;

namespace Talus {

LargeBodyMotion::LargeBodyMotion(LAMMPS *lmp, const BodyMotionSpec &spec, LargeBodyShape &shape) :
    Pointers(lmp), given(spec), kind(spec.kind)
{
  clock.step = update->ntimestep;
  if (deforms()) {
    mesh = shape.as_mesh();
    mesh->let_vertices_move();
    now.vertices = mesh->moving();
  }
  now.runs = given.surface_velocity.has_value();
  if (now.runs) now.surface_velocity = *given.surface_velocity;
  if (domain->dimension == 2)
    given.rigid.locked[2] = given.rigid.locked[3] = given.rigid.locked[4] = true;
  now.moves = moves() && !deforms();
  now.origin = given.center_of_mass ? *given.center_of_mass : shape.reference_point();
  now.inverse_mass = kind == Kind::FREE && given.rigid.translates() ? 1.0 / given.rigid.mass : 0.0;
  given.initial.position = now.origin;
  now.set(given.initial);
}

/* ---- motion --------------------------------------------------------------------------------- */

void LargeBodyMotion::init()
{
  for (const NumberOrVariable &q : given.path) q.check(lmp, "Fix large/body");
  given.servo_target.check(lmp, "Fix large/body");
  if (!given.load) return;
  for (const NumberOrVariable &q : *given.load) q.check(lmp, "Fix large/body");
}

bool LargeBodyMotion::asks_variables() const
{
  const auto asks = [this](const NumberOrVariable &q) { return q.reads_more_than_time(lmp); };
  return (kind == Kind::VARIABLE && std::any_of(given.path.begin(), given.path.end(), asks)) ||
         given.servo_target.reads_more_than_time(lmp) ||
         (kind == Kind::REGION && !variable_that_may_read_particles(lmp, *region).empty()) ||
         (given.load && std::any_of(given.load->begin(), given.load->end(), asks));
}

void LargeBodyMotion::evaluate_state()
{
  modify->clearstep_compute();
  double value[8];
  for (int k = 0; k < 8; k++) value[k] = given.path[k].evaluate(lmp);
  modify->addstep_compute(update->ntimestep + 1);
  for (const double v : value)
    if (!std::isfinite(v)) error->all(FLERR, "Fix large/body move variable: a value is not finite");
  BodyState state;
  state.position = now.origin + Vector3<double>{value[0], value[1], value[2]};
  state.velocity = {value[3], value[4], value[5]};
  if (value[6] != 0.0) state.orientation = Eigen::AngleAxisd(value[6], to_eigen(given.angle_axis));
  state.omega = value[7] * given.angle_axis;
  now.set(state);
}

/* Velocities are those of the way from the step before, as those of fix wall/gran/region: the
   variables of a region tell places only. `dt`: time since the state that the body has; 0 at the
   start of a run, where it keeps the velocities of the run before. */

void LargeBodyMotion::evaluate_region(double dt)
{
  modify->clearstep_compute();
  region->prematch();
  modify->addstep_compute(update->ntimestep + 1);
  const RegionMotion motion(*region);
  const double *const d = motion.displacement;
  if (!std::isfinite(d[0] + d[1] + d[2] + motion.angle))
    error->all(FLERR, "Fix large/body: a variable that moves region '{}' is not finite",
               region->id);
  const Vector3<double> axis{motion.axis[0], motion.axis[1], motion.axis[2]};
  BodyState state = now.state;
  state.position = now.origin + Vector3<double>{d[0], d[1], d[2]};
  state.orientation = Eigen::Quaterniond::Identity();
  if (motion.angle != 0.0) state.orientation = Eigen::AngleAxisd(motion.angle, to_eigen(axis));
  if (dt > 0.0) {
    state.velocity = 1.0 / dt * (state.position - now.state.position);
    state.omega = (motion.angle - region_angle) / dt * axis;
  }
  region_angle = motion.angle;
  now.set(state);
}

void LargeBodyMotion::follow(Region &followed, const Vector3<double> &reference)
{
  region = &followed;
  const Kind before = kind;
  kind = followed.dynamic ? Kind::REGION : Kind::NONE;
  now.moves = moves();
  now.origin = reference;
  if (kind == Kind::REGION && before == kind) return;
  given.initial.position = reference;
  now.set(given.initial);
}

void LargeBodyMotion::place()
{
  if (kind == Kind::REGION) evaluate_region(0.0);
  if (kind == Kind::VARIABLE) evaluate_state();
  if (kind == Kind::PRESCRIBED)
    now.set(given.prescribed->at(clock.at(update->ntimestep), now.origin));
  if (behind == 0.0) stand_still();
}

void LargeBodyMotion::advance(const BodyLoad &load, double lag)
{
  if (kind == Kind::NONE) return;
  if (mesh) {
    mesh->advance(lag > 0.0);
    return;
  }
  const BodyState old = now.state;
  move(load, lag);
  if (kind == Kind::FREE || kind == Kind::SERVO || kind == Kind::REGION) {
    now.velocity_change = 0.5 * (now.state.velocity - old.velocity);
    now.omega_change = kind == Kind::FREE ? 0.5 * given.rigid.change_by_torque(old, now.state)
                                          : 0.5 * (now.state.omega - old.omega);
  }
  if (lag > 0.0) find_kinematics(old, lag);
  behind = lag;
}

void LargeBodyMotion::move(const BodyLoad &load, double lag)
{
  if (kind == Kind::PRESCRIBED) clock.read(update->ntimestep, update->dt);
  if (kind == Kind::REGION) {
    evaluate_region(update->dt);
    return;
  }
  if (depends_on_time()) {
    place();
    return;
  }
  BodyState state = now.state;
  if (kind == Kind::EXTERNAL) external.advance(state, update->dt);
  if (kind == Kind::SERVO) move_servo(state, load, lag);
  if (kind == Kind::FREE) move_free(state, load, lag);
  now.set(state);
}

/* In the step in which it is to be pressed. */

void LargeBodyMotion::aim_servo()
{
  if (!given.servo_target.is_variable()) return;
  modify->clearstep_compute();
  given.servo.target = given.servo_target.evaluate(lmp);
  modify->addstep_compute(update->ntimestep + 1);
  if (!std::isfinite(given.servo.target) || given.servo.target == 0.0)
    error->all(FLERR,
               "Fix large/body servo: variable '{}' is {} in this step; the target must be a "
               "number that is not zero: begin with a small one",
               given.servo_target.name, given.servo.target);
}

/* To second order the rate is that half way through the step, of the last two loads (Adams and
   Bashforth). */

void LargeBodyMotion::move_servo(BodyState &state, const BodyLoad &load, double lag)
{
  aim_servo();
  // of the product of slope and damping, beyond which speeds begin to flip: an extrapolated rate
  // does from 1/3 on, that of the last step from 1 on
  const double limit = lag > 0.0 ? 0.25 : 0.7;
  const bool extrapolates = lag > 0.0 && behind > 0.0;
  const double pressed = given.servo.pressed(load.force, load.torque),
               wanted = given.servo.wanted(pressed);
  response.observe(given.servo.rate_of(extrapolates ? present : state), pressed);
  const bool is_damped = response.product(given.servo.slope()) > limit;
  const double next = is_damped ? response.next_rate(wanted, given.servo.slope()) : wanted;
  const double rate = std::clamp(next, -given.servo.vmax, given.servo.vmax);
  const double ahead =
      extrapolates && !is_damped ? lag / (2.0 * behind) * (rate - servo_rate) : 0.0;
  given.servo.advance(state, rate + ahead, update->dt);
  servo_rate = rate;
}

/* To second order velocities go from half a step before to half a step behind. */

void LargeBodyMotion::move_free(BodyState &state, const BodyLoad &load, double lag)
{
  const double dt = update->dt, unit = force->ftm2v;
  double applied[6] = {};
  if (given.load) {
    modify->clearstep_compute();
    for (int k = 0; k < 6; k++) applied[k] = (*given.load)[k].evaluate(lmp);
    modify->addstep_compute(update->ntimestep + 1);
  }
  const Vector3<double> f = load.force + Vector3<double>{applied[0], applied[1], applied[2]};
  const Vector3<double> t = load.torque + Vector3<double>{applied[3], applied[4], applied[5]};
  const Vector3<double> g = given.gravity.value_or(Vector3<double>{0.0, 0.0, 0.0});
  given.rigid.advance(state, unit / given.rigid.mass * f + unit * g, unit * t,
                      lag > 0.0 ? behind + lag : dt, dt);
}

double LargeBodyMotion::energy() const
{
  if (kind != Kind::FREE) return 0.0;
  const Vector3<double> g = given.gravity.value_or(Vector3<double>{0.0, 0.0, 0.0});
  return force->mvv2e * given.rigid.kinetic_energy(now.state) -
         given.rigid.mass * dot(g, now.state.position);
}

/* ---- states from outside -------------------------------------------------------------------- */

BodyState LargeBodyMotion::state_from(int narg, char **arg, int &words, int &steps) const
{
  constexpr int size = BodyState::size;
  if (narg < 1 + size)
    error->all(FLERR,
               "fix_modify state: expected 13 numbers (position, quaternion, velocity, "
               "angular velocity) instead of {}",
               narg - 1);
  double value[size];
  for (int k = 0; k < size; k++) {
    value[k] = parse_number(arg[1 + k]);    // in any locale of the program
    if (!std::isfinite(value[k]))
      error->all(FLERR, "fix_modify state: expected a finite number instead of '{}'", arg[1 + k]);
  }
  words = 1 + size;
  steps = 0;
  if (narg > 1 + size && strcmp(arg[1 + size], "after") == 0) {
    if (narg < 3 + size || !utils::is_integer(arg[2 + size]) || std::atoi(arg[2 + size]) < 0)
      error->all(FLERR, "fix_modify state after: expected a number of steps, 0 or more");
    steps = std::atoi(arg[2 + size]);
    words += 2;
  }
  return BodyState::from_array(value);
}

std::string LargeBodyMotion::guide(const BodyState &target, int steps, double way, double reach)
{
  if (kind != Kind::EXTERNAL) return "the body is not steered from outside: use 'move external'";
  if (const Eigen::Quaterniond &q = target.orientation; std::fabs(q.squaredNorm() - 1.0) > 1.0e-6)
    return fmt::format("the quaternion {} {} {} {} is not of length 1", q.w(), q.x(), q.y(), q.z());
  BodyFrame there = now;
  there.set(target);
  const double jump = largest_displacement(now, there, reach) / std::max(steps, 1);
  if (jump > way)
    return fmt::format(
        "the body would go {:.4g} in one step, which is more than the skin {:.4g}: give "
        "states more often, or for more steps ahead ('after N')",
        jump, way);
  BodyState state = now.state;
  external.guide(state, target, steps);
  now.set(state);
  if (steps == 0) stand_still();
  return "";
}

}    // namespace Talus
