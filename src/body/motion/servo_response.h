// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How the force on a servo answers to its own speed. Contacts damp: their force grows with the speed
// at once, by the sum G of their damping coefficients. A servo whose speed is K (target - force) with
// the force of the step before flips from step to step where K G > 1. With the force that the new
// speed will bring it does not, for any G:
//
//   rate = K (target - (force + G (rate - rate_before)))
//   rate = rate_before + (wanted - rate_before) / (1 + K G),  wanted = K (target - force)
//
// G is found from how force and speed have changed together (least squares, in which a step counts by
// the square of its change, and old ones the less the larger the changes since), and from the force
// of a contact that begins, which damps all of the speed. Where the speed follows the force smoothly
// both change in opposite directions, and G counts as 0. Where nothing is touched there is no damping.

#ifndef TALUS_BODY_MOTION_SERVO_RESPONSE_H
#define TALUS_BODY_MOTION_SERVO_RESPONSE_H

#include <algorithm>

namespace Talus {

class ServoResponse {
 public:
  /// In each step: the speed at which the force was measured, and the force (or angular speed and
  /// torque), along the axis.
  void observe(double rate, double force)
  {
    const bool begins = last_force == 0.0 && force != 0.0;
    if (known) add(begins ? rate : rate - last_rate, force - last_force);
    known = true;
    last_rate = rate;
    last_force = force;
  }
  /// G: force (torque) over speed.
  double damping() const { return squares > 0.0 ? std::max(0.0, products / squares) : 0.0; }
  /// K G of a servo with this slope K.
  double product(double slope) const { return last_force == 0.0 ? 0.0 : slope * damping(); }
  /// The speed to go on with, where K G is so large that this is needed.
  double next_rate(double wanted, double slope) const
  {
    return last_rate + (wanted - last_rate) / (1.0 + product(slope));
  }

  template <class Exchange> void exchange_state(Exchange &x)
  {
    x(known, last_rate, last_force, products, squares);
  }

 private:
  void add(double change, double force_change)
  {
    const double square = change * change;
    if (!(square > 0.0)) return;
    const double share = squares / (squares + square), kept = share * share;
    products = kept * products + change * force_change;
    squares = kept * squares + square;
  }

  bool known = false;
  double last_rate = 0.0, last_force = 0.0;
  double products = 0.0, squares = 0.0;    // of changes: rate times force, rate times rate
};

}    // namespace Talus

#endif
