// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/motion/guided_motion.h"

#include <cmath>

namespace Talus {
namespace {

/// The turn from a to b, by the shorter way, as angle times unit vector.
Vector3<double> turn_between(const Quaternion &a, const Quaternion &b)
{
  Quaternion d = b * Quaternion{a.w, -a.x, -a.y, -a.z};
  if (d.w < 0.0) d = {-d.w, -d.x, -d.y, -d.z};
  const Vector3<double> v{d.x, d.y, d.z};
  const double sine = std::sqrt(dot(v, v));
  return sine > 0.0 ? 2.0 * std::atan2(sine, d.w) / sine * v : Vector3<double>{0.0, 0.0, 0.0};
}

}    // namespace

void GuidedMotion::guide(BodyState &now, const BodyState &to, int number)
{
  steps = left = number;
  start = now;
  target = to;
  if (number == 0) now = to;
}

void GuidedMotion::advance(BodyState &state, double dt)
{
  if (left == 0) {
    state.position = state.position + dt * state.velocity;
    state.orientation = (Quaternion::turn(state.spin, dt) * state.orientation).normalized();
    return;
  }
  if (--left == 0) {
    state = target;
    return;
  }
  const double way = static_cast<double>(steps - left) / steps;
  state.position = start.position + way * (target.position - start.position);
  state.orientation = (Quaternion::turn(turn_between(start.orientation, target.orientation), way) *
                       start.orientation)
                          .normalized();
  state.velocity = start.velocity + way * (target.velocity - start.velocity);
  state.spin = start.spin + way * (target.spin - start.spin);
}

void GuidedMotion::to_array(double *a) const
{
  a[0] = steps;
  a[1] = left;
  start.to_array(a + 2);
  target.to_array(a + 2 + BodyState::size);
}

void GuidedMotion::from_array(const double *a)
{
  steps = static_cast<int>(a[0]);
  left = static_cast<int>(a[1]);
  start = BodyState::from_array(a + 2);
  target = BodyState::from_array(a + 2 + BodyState::size);
}

}    // namespace Talus
