// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What particles give to a large body over many steps: impulse, angular impulse, work, time. LargeBody feeds it with the
// load of all ranks, so that all have the same bits. Knows nothing of LAMMPS.
//
// A load acts on particles for a time before they move on, and with velocity Verlet already at the end of the step that found
// it. Both are counted when they happen: between two steps the sums are what the velocities of particles contain.
//
//   forces have been found     see()
//   the next step begins       begin_step()
//   between two steps          settle(), then take()
//
// Units are those of the script: impulses force time, angular impulses force distance time, work force distance.

#ifndef TALUS_BODY_CONTACT_IMPULSE_ACCOUNT_H
#define TALUS_BODY_CONTACT_IMPULSE_ACCOUNT_H

#include "base/exact_sum.h"
#include "body/contact/body_load.h"
#include "body/motion/body_state.h"

namespace Talus {

class ImpulseAccount {
 public:
  /// `point`: about which angular impulses are, from the reference point, in the frame of the body,
  /// with which it moves.
  explicit ImpulseAccount(const Vector3<double> &point) : point(point) {}

  /// A load has been found, that of the next call of begin_step() or settle(), of the body as it is
  /// here. `velocity`, `omega`: of its reference point and its own, at the time of the positions.
  void see(const BodyFrame &frame, const Vector3<double> &velocity, const Vector3<double> &omega);
  /// That load has acted for the time `before` in a step that has just begun, which lasts `dt` and ends
  /// with a kick of the time `after` by the load that is found in it.
  void begin_step(const BodyLoad &load, double before, double after, double dt);
  /// Between two steps: that load has acted as far as it has by now.
  void settle(const BodyLoad &load);
  /// A load has been seen: begin_step() and settle() look at theirs.
  bool has_load() const { return seen; }

  /// impulse(3), angular impulse(3), work, time
  static constexpr int size = 8;
  /// After settle(): the sums since the last call of this, each rounded once; begins anew.
  void take(double *sums);

 private:
  void add(const BodyLoad &load, double time);

  Vector3<double> point;
  ExactSum sums[size];
  // of the load that was seen
  Vector3<double> arm{0.0, 0.0, 0.0}, velocity{0.0, 0.0, 0.0}, omega{0.0, 0.0, 0.0};
  bool seen = false;
  double owed = 0.0;    // the time for which it has acted at the end of its step, not counted yet
};

}    // namespace Talus

#endif
