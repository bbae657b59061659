// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How a large body moves, as a command says it: see doc/large_bodies.md. Made by the reader of its words
// (fix/body/body_motion_words.h), taken by LargeBodyMotion. Units are those of the script.

#ifndef TALUS_SYSTEM_BODIES_BODY_MOTION_SPEC_H
#define TALUS_SYSTEM_BODIES_BODY_MOTION_SPEC_H

#include "base/vector3.h"
#include "body/motion/body_state.h"
#include "body/motion/prescribed_motion.h"
#include "body/motion/rigid_body.h"
#include "system/host/number_or_variable.h"

#include <array>
#include <optional>

namespace Talus {

struct BodyMotionSpec {
  enum class Kind { NONE, PRESCRIBED, VARIABLE, EXTERNAL, FREE, SERVO, REGION, VERTICES };

  Kind kind = Kind::NONE;
  std::optional<PrescribedMotion> prescribed;
  std::array<NumberOrVariable, 8> path;    ///< displacement, velocity, angle, angular velocity
  Vector3<double> angle_axis{0.0, 0.0, 1.0};
  RigidBody rigid;
  BodyState initial;    ///< velocities of a free body
  std::optional<Vector3<double>> center_of_mass;
  Servo servo;
  NumberOrVariable servo_target;
  std::optional<Vector3<double>> gravity;                 ///< acceleration of a free body
  std::optional<std::array<NumberOrVariable, 6>> load;    ///< force and torque on a free body
  std::optional<Vector3<double>> surface_velocity;
};

}    // namespace Talus

#endif
