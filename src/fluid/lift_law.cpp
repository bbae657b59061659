// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fluid/lift_law.h"

#include <cmath>

namespace Talus {
namespace {

constexpr double pi = 3.14159265358979323846;

enum Number { SAFFMAN, SAFFMAN_MEI, MAGNUS, MAGNUS_OESTERLE, ROTATION };

/// O, of the grain against the fluid.
Vector3<double> turning(const TurningGrain &g)
{
  return g.omega - 0.5 * g.vorticity;
}

/// rho d^2/mu, which makes Reynolds numbers of angular velocities.
double time_of(const TurningGrain &g)
{
  return g.density * g.diameter * g.diameter / g.viscosity;
}

double reynolds(const TurningGrain &g)
{
  return g.density * length(g.slip) * g.diameter / g.viscosity;
}

Vector3<double> saffman(const TurningGrain &g)
{
  const double curl = length(g.vorticity);
  if (!(curl > 0.0)) return {0.0, 0.0, 0.0};
  const double factor = 1.615 * g.diameter * g.diameter * std::sqrt(g.density * g.viscosity / curl);
  return factor * cross(g.slip, g.vorticity);
}

double mei_correction(const TurningGrain &g)
{
  const double re = reynolds(g);
  if (!(re > 0.0)) return 1.0;
  const double beta = 0.5 * time_of(g) * length(g.vorticity) / re;
  if (re > 40.0) return 0.0524 * std::sqrt(beta * re);
  const double at_large_re = 0.3314 * std::sqrt(beta);
  return (1.0 - at_large_re) * std::exp(-0.1 * re) + at_large_re;
}

Vector3<double> magnus(const TurningGrain &g)
{
  return pi / 8.0 * g.density * g.diameter * g.diameter * g.diameter * cross(turning(g), g.slip);
}

/* Their coefficient of lift is 0.45 + (r - 0.45) exp(-0.05684 Re_O^0.4 Re^0.3) with r = Re_O/Re, that of Rubinow and Keller r. */

double oesterle_correction(const TurningGrain &g)
{
  const double re = reynolds(g), re_turning = time_of(g) * length(turning(g));
  if (!(re > 0.0) || !(re_turning > 0.0)) return 1.0;
  const double at_large_re = 0.45 * re / re_turning;
  return at_large_re +
         (1.0 - at_large_re) * std::exp(-0.05684 * std::pow(re_turning, 0.4) * std::pow(re, 0.3));
}

}    // namespace

const std::vector<std::string> &LiftLaw::names()
{
  static const std::vector<std::string> all{"saffman", "saffman/mei", "magnus", "magnus/oesterle",
                                            "rotation"};
  return all;
}

bool LiftLaw::take(int which)
{
  if (which == ROTATION) {
    if (rotation) return false;
    return rotation = true;
  }
  Kind &kind = which == SAFFMAN || which == SAFFMAN_MEI ? shear : turn;
  if (kind != NONE) return false;
  kind = which == SAFFMAN || which == MAGNUS ? PLAIN : CORRECTED;
  return true;
}

Vector3<double> LiftLaw::force(const TurningGrain &grain) const
{
  Vector3<double> sum{0.0, 0.0, 0.0};
  if (shear != NONE)
    sum = sum + (shear == CORRECTED ? mei_correction(grain) : 1.0) * saffman(grain);
  if (turn != NONE)
    sum = sum + (turn == CORRECTED ? oesterle_correction(grain) : 1.0) * magnus(grain);
  return sum;
}

double LiftLaw::rotation_coefficient(const TurningGrain &grain)
{
  const double d = grain.diameter, scale = grain.viscosity * d * d * d,
               re = time_of(grain) * length(turning(grain));
  return re <= 32.0 ? pi * scale : scale / 64.0 * (12.9 * std::sqrt(re) + 128.4);
}

}    // namespace Talus
