// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BODY_MOTION_EXTERNAL_MOTION_H
#define TALUS_BODY_MOTION_EXTERNAL_MOTION_H

#include "body/motion/body_state.h"

namespace Talus {

/// Motion of a body that another program steers. The program gives states that the body is to have
/// a number of steps later; on the way there its position goes along a straight line, its
/// orientation turns about one axis, both at constant speed, while velocity and angular velocity
/// change linearly from the old values to the given ones. After that it goes on with the last of
/// both. The state that was given is reached with all its bits.
class ExternalMotion {
 public:
  /// `steps` 0: the body has this state at once.
  void guide(BodyState &now, const BodyState &target, int steps);

  void advance(BodyState &state, double dt);

  template <class Exchange> void exchange_state(Exchange &x) { x(steps, left, start, target); }

 private:
  int steps = 0, left = 0;
  BodyState start, target;
};

}    // namespace Talus

#endif
