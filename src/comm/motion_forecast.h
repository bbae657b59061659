// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Will a neighbour list still be valid in the next step? A list made with a skin s holds every
// pair that can touch as long as no particle has moved further than s/2 since it was made. The
// stock check asks all ranks in the step itself and waits for their answers. Asked one step ahead,
// the answers have a step's time to arrive; the price is that the motion of that step has to be
// estimated from above, so that the list is made anew slightly earlier.
//
// Estimate for particle i: it has moved d_i, and moved s_i = dt |v_i| in the last step (exactly,
// when the integrator moves x by dt v). In the next step it moves at most s_i + S, where S is the
// largest s_i of all particles of all ranks: no contact changes a velocity, within one step, by
// more than the largest speed there is. (The change in a stable step is about omega dt times the
// relative speed, with omega dt well below 1; see doc/run_style_verlet_proxy.md.) Where this does
// not hold, for instance because positions are set by something else than v, the list may be late
// by one step: that is noticed in the next forecast, which carries the largest d_i as well, and
// counts as a dangerous build.
//
// No LAMMPS, no MPI. All three numbers are maxima, exact in any order: the decision does not depend
// on the number of ranks.

#ifndef TALUS_COMM_MOTION_FORECAST_H
#define TALUS_COMM_MOTION_FORECAST_H

namespace Talus {

struct MotionForecast {
  double moved = 0.0;    ///< largest d_i (length)
  double next = 0.0;     ///< largest d_i + s_i (length)
  double step = 0.0;     ///< largest s_i (length)

  /// Whether a particle may be further than `limit` from where it was, one step later.
  bool may_leave(double limit) const { return next + step > limit; }
};

/// Of particles 0 ... n-1 with positions x, positions x_then when the list was made, and velocities
/// v, three doubles each.
MotionForecast forecast_motion(int n, const double *x, const double *x_then, const double *v,
                               double dt);

}    // namespace Talus

#endif
