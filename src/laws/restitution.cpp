// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/restitution.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Talus {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

double beta(double e)
{
  const double l = std::log(std::max(e, epsilon));
  return std::fabs(l) / std::sqrt(l * l + pi * pi);
}

/// Damping ratio of a linear contact that ends as soon as its force vanishes. With z = cos(p) it
/// ends at the phase 2 p, so that e = exp(-2 p cot p); with z = cosh(q), e = exp(-2 q coth q). By exp:
/// tanh and cosh of the C library have other last bits on other processors.
double damping_ratio_limited(double e)
{
  const double decay = -std::log(std::clamp(e, 0.01, 1.0));
  const bool oscillates = decay < 2.0;
  // p = pi/2 - a keeps all digits where e is near 1
  const auto decay_at = [=](double a) {
    if (oscillates) return (pi - 2.0 * a) * std::tan(a);
    const double growth = std::exp(2.0 * a);
    return a > 1.0e-9 ? 2.0 * a * (growth + 1.0) / (growth - 1.0) : 2.0;
  };
  double low = 0.0, high = oscillates ? 0.5 * pi : 4.0;
  for (int n = 0; n < 100; n++) {
    const double middle = 0.5 * (low + high);
    (decay_at(middle) < decay ? low : high) = middle;
  }
  return oscillates ? std::sin(low) : 0.5 * (std::exp(low) + std::exp(-low));
}

}    // namespace

double linear_damping_factor(double e)
{
  const double l = std::log(std::clamp(e, epsilon, 1.0 - epsilon));
  return 2.0 / std::sqrt(1.0 + (pi / l) * (pi / l));
}

double hertz_damping_factor(double e)
{
  return 2.0 * std::sqrt(5.0 / 6.0) * beta(e);
}

double linear_damping_factor_limited(double e)
{
  return 2.0 * damping_ratio_limited(e);
}

double hertz_damping_factor_limited(double e)
{
  return 2.0 * std::sqrt(5.0 / 6.0) * damping_ratio_limited(e);
}

double flores_restitution(double e)
{
  return std::clamp(e, 0.01, 1.0 - epsilon);
}

double flores_damping_factor(double e)
{
  const double used = flores_restitution(e);
  return 1.6 * (1.0 - used) / used;
}

double effective_young(double y1, double nu1, double y2, double nu2)
{
  return 1.0 / ((1.0 - nu1 * nu1) / y1 + (1.0 - nu2 * nu2) / y2);
}

double effective_shear(double y1, double nu1, double y2, double nu2)
{
  return 1.0 / (2.0 * (2.0 - nu1) * (1.0 + nu1) / y1 + 2.0 * (2.0 - nu2) * (1.0 + nu2) / y2);
}

}    // namespace Talus
