// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/motion/guided_motion.h"

namespace Talus {

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
    state.orientation = (turn_of(state.omega, dt) * state.orientation).normalized();
    return;
  }
  if (--left == 0) {
    state = target;
    return;
  }
  const double way = static_cast<double>(steps - left) / steps;
  state.position = start.position + way * (target.position - start.position);
  const Eigen::AngleAxisd turn(target.orientation *
                               start.orientation.conjugate());    // the shorter
  state.orientation =
      (Eigen::AngleAxisd(way * turn.angle(), turn.axis()) * start.orientation).normalized();
  state.velocity = start.velocity + way * (target.velocity - start.velocity);
  state.omega = start.omega + way * (target.omega - start.omega);
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
