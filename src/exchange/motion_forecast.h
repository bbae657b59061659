// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Will a neighbor list still be valid until it can be rebuilt? A list made with a skin s holds
// every pair that can touch as long as no particle has moved further than s/2 since it was made.
// The stock check asks all ranks in the step itself and waits for their answers. Asked one step
// ahead, the answers have a step's time to arrive; the price is that the motion until then has to
// be estimated from above: that the list may have to be rebuilt is known slightly earlier. A list
// that is kept is kept until the next check, N steps later (`neigh_modify every N`): it serves in N
// steps.
//
// Estimate: particle i has moved d_i, at most D, and moved s_i = dt |v_i| in the last step
// (exactly, when the integrator moves x by dt v), at most S, where D and S are the largest of all
// particles of all ranks. In each of the next N steps it moves at most s_i + S <= 2 S: no contact
// changes a velocity, before the next check, by more than the largest speed there is. (The change
// in a stable step is about omega dt times the relative speed, with omega dt well below 1, and a
// whole collision of equal particles ends with at most the speed of the other one; see
// doc/method.md.) While nothing moves at all, that says nothing: any force may set particles in
// motion, and they may leave at once. Where this does not hold, for instance because positions are set
// by something else than v, the list may be late: that is noticed in the next forecast by its D,
// and counts as a dangerous build.
//
// No LAMMPS, no MPI. Both numbers are maxima, exact in any order: the decision does not depend on
// the number of ranks.

#ifndef TALUS_EXCHANGE_MOTION_FORECAST_H
#define TALUS_EXCHANGE_MOTION_FORECAST_H

namespace Talus {

struct MotionForecast {
  double moved = 0.0;    ///< D, largest d_i (length)
  double step = 0.0;     ///< S, largest s_i (length)

  /// Whether a particle may be further than `limit` from where it was in one of the next `steps`
  /// steps.
  bool may_leave(double limit, int steps) const
  {
    return step == 0.0 || moved + 2.0 * steps * step > limit;
  }
};

/// Of particles 0 ... n-1 with positions x, positions x_then when the list was made, and velocities
/// v, three doubles each.
MotionForecast forecast_motion(int n, const double *x, const double *x_then, const double *v,
                               double dt);

}    // namespace Talus

#endif
