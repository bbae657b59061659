// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/motion/external_motion.h"

namespace Talus {

void ExternalMotion::guide(BodyState &now, const BodyState &to, int number)
{
  steps = left = number;
  start = now;
  target = to;
  if (number == 0) now = to;
}

void ExternalMotion::advance(BodyState &state, double dt)
{
  if (left == 0) {
    state.position = state.position + dt * state.velocity;
    state.orientation = (rotation_by(state.omega, dt) * state.orientation).normalized();
    return;
  }
  if (--left == 0) {
    state = target;
    return;
  }
  const double way = static_cast<double>(steps - left) / steps;
  state.position = start.position + way * (target.position - start.position);
  const Eigen::AngleAxisd rotation(target.orientation *
                                   start.orientation.conjugate());    // the shorter
  state.orientation =
      (Eigen::AngleAxisd(way * rotation.angle(), rotation.axis()) * start.orientation).normalized();
  state.velocity = start.velocity + way * (target.velocity - start.velocity);
  state.omega = start.omega + way * (target.omega - start.omega);
}

}    // namespace Talus
