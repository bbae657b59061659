// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "exchange/motion_forecast.h"

#include <cmath>

using namespace Talus;

MotionForecast Talus::forecast_motion(int n, const double *x, const double *x_then, const double *v,
                                      double dt)
{
  double moved2 = 0.0, fastest2 = 0.0;
#pragma omp simd reduction(max : moved2, fastest2)
  for (int i = 0; i < n; i++) {
    const double dx = x[3 * i] - x_then[3 * i], dy = x[3 * i + 1] - x_then[3 * i + 1],
                 dz = x[3 * i + 2] - x_then[3 * i + 2];
    const double vx = v[3 * i], vy = v[3 * i + 1], vz = v[3 * i + 2];
    const double way2 = dx * dx + dy * dy + dz * dz, speed2 = vx * vx + vy * vy + vz * vz;
    moved2 = way2 > moved2 ? way2 : moved2;
    fastest2 = speed2 > fastest2 ? speed2 : fastest2;
  }
  return {std::sqrt(moved2), dt * std::sqrt(fastest2)};
}
