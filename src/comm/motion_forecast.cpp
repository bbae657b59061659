// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "comm/motion_forecast.h"

#include <cmath>

using namespace Talus;

MotionForecast Talus::forecast_motion(int n, const double *x, const double *x_then, const double *v,
                                      double dt)
{
  double moved = 0.0, next = 0.0, fastest = 0.0;
#pragma omp simd reduction(max : moved, next, fastest)
  for (int i = 0; i < n; i++) {
    const double dx = x[3 * i] - x_then[3 * i], dy = x[3 * i + 1] - x_then[3 * i + 1],
                 dz = x[3 * i + 2] - x_then[3 * i + 2];
    const double vx = v[3 * i], vy = v[3 * i + 1], vz = v[3 * i + 2];
    const double d = std::sqrt(dx * dx + dy * dy + dz * dz);
    const double speed = std::sqrt(vx * vx + vy * vy + vz * vz);
    const double ahead = d + dt * speed;
    moved = d > moved ? d : moved;
    next = ahead > next ? ahead : next;
    fastest = speed > fastest ? speed : fastest;
  }
  return {moved, next, dt * fastest};
}
