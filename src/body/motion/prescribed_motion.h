// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Motions that are functions of time: those of fix move.

#ifndef TALUS_BODY_MOTION_PRESCRIBED_MOTION_H
#define TALUS_BODY_MOTION_PRESCRIBED_MOTION_H

#include "body/motion/body_state.h"

#include <cstdint>

namespace Talus {

class PrescribedMotion {
 public:
  static PrescribedMotion linear(const Vector3<double> &velocity);
  /// position = start + amplitude sin(2 pi t/period)
  static PrescribedMotion wiggle(const Vector3<double> &amplitude, double period);
  /// Turns about the unit vector `axis` through `point`, right-handed, once in each period.
  static PrescribedMotion rotate(const Vector3<double> &point, const Vector3<double> &axis,
                                 double period);

  /// The state at a time after the beginning, of a body whose reference point was at `start`.
  BodyState at(double time, const Vector3<double> &start) const;

 private:
  enum class Kind { LINEAR, WIGGLE, ROTATE };
  PrescribedMotion(Kind kind, const Vector3<double> &vector, double rate,
                   const Vector3<double> &point);

  Kind kind;
  Vector3<double> vector;    // velocity, amplitude or axis
  double rate;               // 2 pi/period
  Vector3<double> point;
};

/// Time since the beginning of a motion. A product of steps and time step, so that it does not
/// depend on where a run was interrupted; when the time step changes a new product begins.
struct MotionClock {
  double time = 0.0;    ///< at step `step`
  std::int64_t step = 0;
  double dt = 0.0;    ///< of the steps after it

  /// The time at step `now`, which dt led to.
  double read(std::int64_t now, double dt_now);
  /// The same for a step that was read before, or the first one, whatever the time step is now.
  double at(std::int64_t now) const { return time + static_cast<double>(now - step) * dt; }

  template <class Exchange> void exchange_state(Exchange &x) { x(time, step, dt); }
};

}    // namespace Talus

#endif
