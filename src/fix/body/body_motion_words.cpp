// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/body/body_motion_words.h"

#include "system/loads/constant_gravity.h"

#include "error.h"

#include <string>
#include <vector>

using namespace LAMMPS_NS;

namespace Talus {

using Kind = BodyMotionSpec::Kind;

bool BodyMotionWords::parse(BodyMotionSpec &spec)
{
  for (const char *keyword : {"move", "servo"}) {
    if (!words.take(keyword)) continue;
    words.about(keyword);
    if (spec.kind != Kind::NONE) words.fail(1, "the body has a motion already");
    if (keyword == std::string("move"))
      parse_move(spec);
    else
      parse_servo(spec);
    return true;
  }
  if (words.take("gravity")) {
    words.about("gravity");
    if (spec.gravity) words.fail(1, "given twice");
    ConstantGravity gravity(lmp);
    gravity.parse(words);
    const double *g = gravity.acceleration();
    spec.gravity = {g[0], g[1], g[2]};
    return true;
  }
  if (words.take("surface_velocity")) {
    words.about("surface_velocity");
    spec.surface_velocity = vector_or_null("velocity (vx vy vz)");
    return true;
  }
  if (words.take("load")) {
    words.about("load");
    spec.load.emplace();
    for (NumberOrVariable &q : *spec.load) q = quantity("force and torque (fx fy fz tx ty tz)");
    return true;
  }
  return false;
}

Vector3<double> BodyMotionWords::vector_or_null(const char *name)
{
  const double x = words.number_or_null(name), y = words.number_or_null(name),
               z = words.number_or_null(name);
  return {x, y, z};
}

void BodyMotionWords::parse_move(BodyMotionSpec &spec)
{
  static const std::vector<std::string> styles = {"none",     "linear",   "wiggle", "rotate",
                                                  "variable", "external", "free",   "vertices"};
  const std::string style = styles[words.choice("style of motion", styles)];
  words.about("move " + style);
  spec.kind = Kind::PRESCRIBED;
  if (style == "none") {
    spec.kind = Kind::NONE;
  } else if (style == "linear") {
    spec.prescribed = PrescribedMotion::linear(vector_or_null("velocity (vx vy vz)"));
  } else if (style == "wiggle") {
    const Vector3<double> amplitude = vector_or_null("amplitude (ax ay az)");
    spec.prescribed = PrescribedMotion::wiggle(amplitude, words.positive("period"));
  } else if (style == "rotate") {
    const Vector3<double> point = words.vector("point (px py pz)");
    const Vector3<double> axis = words.direction("axis (ax ay az)");
    spec.prescribed = PrescribedMotion::rotate(point, axis, words.positive("period"));
  } else if (style == "variable") {
    spec.kind = Kind::VARIABLE;
    parse_variable(spec);
  } else if (style == "external") {
    spec.kind = Kind::EXTERNAL;
  } else if (style == "vertices") {
    spec.kind = Kind::VERTICES;
  } else {
    spec.kind = Kind::FREE;
    parse_free(spec);
  }
}

/* The words of fix move variable, and an angle about an axis through the reference point. */

void BodyMotionWords::parse_variable(BodyMotionSpec &spec)
{
  for (int k = 0; k < 6; k++) spec.path[k] = quantity("displacement and velocity");
  if (!words.take("angle")) return;
  for (int k = 6; k < 8; k++) spec.path[k] = quantity("angle and angular velocity");
  spec.angle_axis = words.direction("axis (ax ay az)");
}

void BodyMotionWords::parse_free(BodyMotionSpec &spec)
{
  static const char *const freedoms[] = {"x", "y", "z", "rx", "ry", "rz"};
  for (bool more = true; more;) {
    if (words.take("mass")) {
      spec.rigid.mass = words.positive("mass M");
    } else if (words.take("inertia")) {
      for (double &moment : spec.rigid.inertia) moment = words.positive("inertia (Ixx Iyy Izz)");
    } else if (words.take("com")) {
      spec.center_of_mass = words.vector("com (x y z)");
    } else if (words.take("velocity")) {
      spec.initial.velocity = words.vector("velocity (vx vy vz)");
    } else if (words.take("spin")) {
      spec.initial.omega = words.vector("spin (wx wy wz)");
    } else if (words.take("lock")) {
      const int first = words.index();
      for (bool known = true; known;) {
        known = false;
        for (int k = 0; k < 6; k++)
          if (words.take(freedoms[k])) known = spec.rigid.locked[k] = true;
      }
      if (words.index() == first)
        words.fail(0, "expected one or more of x y z rx ry rz after lock");
    } else {
      more = false;
    }
  }
  if (spec.rigid.mass == 0.0) words.fail(1, "missing mass M");
  if (spec.rigid.inertia[0] == 0.0) words.fail(1, "missing inertia Ixx Iyy Izz");
  const double *i = spec.rigid.inertia;
  for (int k = 0; k < 3; k++)
    if (i[k] > (i[(k + 1) % 3] + i[(k + 2) % 3]) * (1.0 + 1.0e-12))
      words.fail(1, "no body has these moments of inertia: each is at most the sum of the others");
}

void BodyMotionWords::parse_servo(BodyMotionSpec &spec)
{
  spec.kind = Kind::SERVO;
  spec.servo.turns = words.choice("quantity", {"force", "torque"}) == 1;
  spec.servo.axis = words.direction("axis (x y z)");
  spec.servo_target = NumberOrVariable::from(words, "target");
  spec.servo.target = spec.servo_target.value;
  if (!spec.servo_target.is_variable() && spec.servo.target == 0.0)
    words.fail(1, "target must not be zero");
  spec.servo.vmax = words.positive("vmax");
  if (words.take("gain")) spec.servo.gain = words.positive("gain");
}

NumberOrVariable BodyMotionWords::quantity(const char *name)
{
  if (words.take("NULL")) return {};
  return NumberOrVariable::from(words, name);
}

void BodyMotionWords::check(const BodyMotionSpec &spec, LargeBodyShape &shape) const
{
  if (spec.kind == Kind::VERTICES) {
    if (!shape.as_mesh()) error->all(FLERR, "fix large/body: move vertices is for mesh");
    if (spec.surface_velocity)
      error->all(FLERR, "fix large/body: surface_velocity does not go with move vertices: give the "
                        "velocities of the vertices with their places");
  }
  if (spec.gravity && spec.kind != Kind::FREE)
    error->all(FLERR, "fix large/body: gravity acts on bodies with 'move free' only");
  if (spec.load && spec.kind != Kind::FREE)
    error->all(FLERR, "fix large/body: load acts on bodies with 'move free' only");
}

}    // namespace Talus
