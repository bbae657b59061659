// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/large_body_motion.h"

#include "base/words.h"
#include "fix/region_surface.h"
#include "system/time_formula.h"

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
using namespace Talus;

LargeBodyMotion::LargeBodyMotion(LAMMPS *lmp) : Pointers(lmp), gravity(lmp)
{
  clock.step = update->ntimestep;
}

/* ---- words ---------------------------------------------------------------------------------- */

bool LargeBodyMotion::parse(Words &words)
{
  for (const char *keyword : {"move", "servo"}) {
    if (!words.take(keyword)) continue;
    words.about(keyword);
    if (kind != Kind::NONE) words.fail(1, "the body has a motion already");
    if (keyword == std::string("move"))
      parse_move(words);
    else
      parse_servo(words);
    return true;
  }
  if (words.take("gravity")) {
    words.about("gravity");
    if (gravity.given()) words.fail(1, "given twice");
    gravity.parse(words);
    return true;
  }
  if (words.take("surface_velocity")) {
    words.about("surface_velocity");
    const double x = words.number_or_null("velocity (vx vy vz)"),
                 y = words.number_or_null("velocity (vx vy vz)"),
                 z = words.number_or_null("velocity (vx vy vz)");
    now.surface_velocity = {x, y, z};
    now.runs = true;
    return true;
  }
  if (words.take("load")) {
    words.about("load");
    for (Quantity &q : given_load) q = quantity(words, "force and torque (fx fy fz tx ty tz)");
    has_load = true;
    return true;
  }
  return false;
}

void LargeBodyMotion::parse_move(Words &words)
{
  static const std::vector<std::string> styles = {"none",     "linear",   "wiggle", "rotate",
                                                  "variable", "external", "free",   "vertices"};
  const std::string style = styles[words.choice("style of motion", styles)];
  words.about("move " + style);
  kind = Kind::PRESCRIBED;
  if (style == "none") {
    kind = Kind::NONE;
  } else if (style == "linear") {
    const double x = words.number_or_null("velocity (vx vy vz)"),
                 y = words.number_or_null("velocity (vx vy vz)"),
                 z = words.number_or_null("velocity (vx vy vz)");
    prescribed = std::make_unique<PrescribedMotion>(PrescribedMotion::linear({x, y, z}));
  } else if (style == "wiggle") {
    const double x = words.number_or_null("amplitude (ax ay az)"),
                 y = words.number_or_null("amplitude (ax ay az)"),
                 z = words.number_or_null("amplitude (ax ay az)");
    prescribed = std::make_unique<PrescribedMotion>(
        PrescribedMotion::wiggle({x, y, z}, words.positive("period")));
  } else if (style == "rotate") {
    const Vector3<double> point = words.vector("point (px py pz)");
    const Vector3<double> axis = words.direction("axis (ax ay az)");
    prescribed = std::make_unique<PrescribedMotion>(
        PrescribedMotion::rotate(point, axis, words.positive("period")));
  } else if (style == "variable") {
    kind = Kind::VARIABLE;
    parse_variable(words);
  } else if (style == "external") {
    kind = Kind::EXTERNAL;
  } else if (style == "vertices") {
    kind = Kind::VERTICES;
  } else {
    kind = Kind::FREE;
    parse_free(words);
  }
}

/* The words of fix move variable, and an angle about an axis through the reference point. */

void LargeBodyMotion::parse_variable(Words &words)
{
  for (int k = 0; k < 6; k++) path[k] = quantity(words, "displacement and velocity");
  if (!words.take("angle")) return;
  for (int k = 6; k < 8; k++) path[k] = quantity(words, "angle and angular velocity");
  angle_axis = words.direction("axis (ax ay az)");
}

void LargeBodyMotion::parse_free(Words &words)
{
  static const char *const freedoms[] = {"x", "y", "z", "rx", "ry", "rz"};
  for (bool more = true; more;) {
    if (words.take("mass")) {
      rigid.mass = words.positive("mass M");
    } else if (words.take("inertia")) {
      for (double &moment : rigid.inertia) moment = words.positive("inertia (Ixx Iyy Izz)");
    } else if (words.take("com")) {
      center_of_mass = std::make_unique<Vector3<double>>(words.vector("com (x y z)"));
    } else if (words.take("velocity")) {
      initial.velocity = words.vector("velocity (vx vy vz)");
    } else if (words.take("spin")) {
      initial.omega = words.vector("spin (wx wy wz)");
    } else if (words.take("lock")) {
      const int first = words.index();
      for (bool known = true; known;) {
        known = false;
        for (int k = 0; k < 6; k++)
          if (words.take(freedoms[k])) known = rigid.locked[k] = true;
      }
      if (words.index() == first)
        words.fail(0, "expected one or more of x y z rx ry rz after lock");
    } else {
      more = false;
    }
  }
  if (rigid.mass == 0.0) words.fail(1, "missing mass M");
  if (rigid.inertia[0] == 0.0) words.fail(1, "missing inertia Ixx Iyy Izz");
  const double *i = rigid.inertia;
  for (int k = 0; k < 3; k++)
    if (i[k] > (i[(k + 1) % 3] + i[(k + 2) % 3]) * (1.0 + 1.0e-12))
      words.fail(1, "no body has these moments of inertia: each is at most the sum of the others");
}

void LargeBodyMotion::parse_servo(Words &words)
{
  kind = Kind::SERVO;
  servo.turns = words.choice("quantity", {"force", "torque"}) == 1;
  servo.axis = words.direction("axis (x y z)");
  servo.target = words.number("target");
  if (servo.target == 0.0) words.fail(1, "target must not be zero");
  servo.vmax = words.positive("vmax");
  if (words.take("gain")) servo.gain = words.positive("gain");
}

LargeBodyMotion::Quantity LargeBodyMotion::quantity(Words &words, const char *name)
{
  Quantity q;
  if (words.peek().compare(0, 2, "v_") == 0)
    q.name = words.text(name).substr(2);
  else
    q.value = words.number_or_null(name);
  return q;
}

void LargeBodyMotion::finish(LargeBodyShape &shape)
{
  if (kind == Kind::VERTICES) {
    mesh = shape.as_mesh();
    if (!mesh) error->all(FLERR, "fix large/body: move vertices is for mesh");
    if (now.runs)
      error->all(FLERR, "fix large/body: surface_velocity does not go with move vertices: give the "
                        "velocities of the vertices with their places");
    mesh->let_vertices_move();
    now.vertices = mesh->moving();
  }
  if (gravity.given() && kind != Kind::FREE)
    error->all(FLERR, "fix large/body: gravity acts on bodies with 'move free' only");
  if (has_load && kind != Kind::FREE)
    error->all(FLERR, "fix large/body: load acts on bodies with 'move free' only");
  if (domain->dimension == 2) rigid.locked[2] = rigid.locked[3] = rigid.locked[4] = true;
  now.moves = moves() && !deforms();
  now.origin = center_of_mass ? *center_of_mass : shape.reference_point();
  now.inverse_mass = kind == Kind::FREE && rigid.translates() ? 1.0 / rigid.mass : 0.0;
  initial.position = now.origin;
  now.set(initial);
}

/* ---- motion --------------------------------------------------------------------------------- */

int LargeBodyMotion::find(const Quantity &q) const
{
  const int index = input->variable->find(q.name.c_str());
  if (index < 0) error->all(FLERR, "Fix large/body: variable '{}' does not exist", q.name);
  if (!input->variable->equalstyle(index))
    error->all(FLERR, "Fix large/body: variable '{}' is not an equal-style variable", q.name);
  return index;
}

void LargeBodyMotion::init()
{
  for (const Quantity &q : path)
    if (!q.name.empty()) static_cast<void>(find(q));
  for (const Quantity &q : given_load)
    if (!q.name.empty()) static_cast<void>(find(q));
}

bool LargeBodyMotion::asks_variables() const
{
  const auto asks = [this](const Quantity &q) {
    return !q.name.empty() && !reads_only_time(lmp, q.name);
  };
  return (kind == Kind::VARIABLE && std::any_of(std::begin(path), std::end(path), asks)) ||
         (kind == Kind::REGION && !variable_that_may_read_particles(lmp, *region).empty()) ||
         (has_load && std::any_of(std::begin(given_load), std::end(given_load), asks));
}

double LargeBodyMotion::evaluate(const Quantity &q)
{
  return q.name.empty() ? q.value : input->variable->compute_equal(find(q));
}

void LargeBodyMotion::evaluate_state()
{
  modify->clearstep_compute();
  double value[8];
  for (int k = 0; k < 8; k++) value[k] = evaluate(path[k]);
  modify->addstep_compute(update->ntimestep + 1);
  for (const double v : value)
    if (!std::isfinite(v)) error->all(FLERR, "Fix large/body move variable: a value is not finite");
  BodyState state;
  state.position = now.origin + Vector3<double>{value[0], value[1], value[2]};
  state.velocity = {value[3], value[4], value[5]};
  if (value[6] != 0.0) state.orientation = Eigen::AngleAxisd(value[6], to_eigen(angle_axis));
  state.omega = value[7] * angle_axis;
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
  region = RegionHandle(*domain, followed);
  const Kind before = kind;
  kind = followed.dynamic ? Kind::REGION : Kind::NONE;
  now.moves = moves();
  now.origin = reference;
  if (kind == Kind::REGION && before == kind) return;
  initial.position = reference;
  now.set(initial);
}

void LargeBodyMotion::place()
{
  if (kind == Kind::REGION) evaluate_region(0.0);
  if (kind == Kind::VARIABLE) evaluate_state();
  if (kind == Kind::PRESCRIBED) now.set(prescribed->at(clock.at(update->ntimestep), now.origin));
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
    now.omega_change = kind == Kind::FREE ? 0.5 * rigid.change_by_torque(old, now.state)
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

/* To second order the rate is that half way through the step, of the last two loads (Adams and
   Bashforth). */

void LargeBodyMotion::move_servo(BodyState &state, const BodyLoad &load, double lag)
{
  // of the product of slope and damping, beyond which speeds begin to flip: an extrapolated rate
  // does from 1/3 on, that of the last step from 1 on
  const double limit = lag > 0.0 ? 0.25 : 0.7;
  const bool extrapolates = lag > 0.0 && behind > 0.0;
  const double pressed = servo.pressed(load.force, load.torque), wanted = servo.wanted(pressed);
  response.observe(servo.rate_of(extrapolates ? present : state), pressed);
  const bool is_damped = response.product(servo.slope()) > limit;
  const double next = is_damped ? response.next_rate(wanted, servo.slope()) : wanted;
  const double rate = std::clamp(next, -servo.vmax, servo.vmax);
  const double ahead =
      extrapolates && !is_damped ? lag / (2.0 * behind) * (rate - servo_rate) : 0.0;
  servo.advance(state, rate + ahead, update->dt);
  servo_rate = rate;
}

/* To second order velocities go from half a step before to half a step behind. */

void LargeBodyMotion::move_free(BodyState &state, const BodyLoad &load, double lag)
{
  const double dt = update->dt, unit = force->ftm2v;
  double given[6] = {};
  if (has_load) {
    modify->clearstep_compute();
    for (int k = 0; k < 6; k++) given[k] = evaluate(given_load[k]);
    modify->addstep_compute(update->ntimestep + 1);
  }
  const Vector3<double> f = load.force + Vector3<double>{given[0], given[1], given[2]};
  const Vector3<double> t = load.torque + Vector3<double>{given[3], given[4], given[5]};
  const double *g = gravity.acceleration();
  rigid.advance(state, unit / rigid.mass * f + unit * Vector3<double>{g[0], g[1], g[2]}, unit * t,
                lag > 0.0 ? behind + lag : dt, dt);
}

double LargeBodyMotion::energy() const
{
  if (kind != Kind::FREE) return 0.0;
  const double *g = gravity.acceleration();
  return force->mvv2e * rigid.kinetic_energy(now.state) -
         rigid.mass * dot({g[0], g[1], g[2]}, now.state.position);
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

/* ---- restart -------------------------------------------------------------------------------- */

void LargeBodyMotion::to_array(double *a) const
{
  *a++ = static_cast<double>(kind);
  now.state.to_array(a);
  a += BodyState::size;
  *a++ = clock.time;
  *a++ = static_cast<double>(clock.step);
  *a++ = clock.dt;
  external.to_array(a);
  a += ExternalMotion::size;
  *a++ = behind;
  *a++ = servo_rate;
  response.to_array(a);
  a += ServoResponse::size;
  half_way.to_array(a);
  present.to_array(a + BodyState::size);
}

void LargeBodyMotion::exchange_state(StateExchange &x)
{
  x(now, clock, region_angle, external, response, half_way, present, behind, servo_rate);
}

bool LargeBodyMotion::from_array(const double *a)
{
  if (*a++ != static_cast<double>(kind)) return false;
  now.set(BodyState::from_array(a));
  a += BodyState::size;
  clock.time = *a++;
  clock.step = static_cast<std::int64_t>(*a++);
  clock.dt = *a++;
  external.from_array(a);
  a += ExternalMotion::size;
  behind = *a++;
  servo_rate = *a++;
  response.from_array(a);
  a += ServoResponse::size;
  half_way = BodyState::from_array(a);
  present = BodyState::from_array(a + BodyState::size);
  show_kinematics();
  return true;
}
