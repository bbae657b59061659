// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/restitution.h"

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

  /// Speed after an impact at speed 1 of a unit mass with x'' = -(x^(3/2) + c x^(1/4) x'), ended as soon as
  /// the force is no longer repulsive; classical Runge-Kutta steps.
  double rebound_speed(double c)
  {
    const auto force = [c](double x, double v) {
      const double root = std::sqrt(std::max(x, 0.0));
      return root * root * root + c * std::sqrt(root) * v;
    };
    const double h = 5.0e-4;
    double x = 0.0, v = 1.0, before = 0.0;
    while (true) {
      const double now = force(x, v);
      if (v < 0.0 && now <= 0.0) return -v;
      if (v < 0.0 && x <= 0.0) return -v;
      before = v;
      const double x2 = x + 0.5 * h * v, v2 = v - 0.5 * h * now;
      const double f2 = force(x2, v2);
      const double x3 = x + 0.5 * h * v2, v3 = v - 0.5 * h * f2;
      const double f3 = force(x3, v3);
      const double x4 = x + h * v3, v4 = v - h * f3;
      x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
      v -= h / 6.0 * (now + 2.0 * f2 + 2.0 * f3 + force(x4, v4));
      // over-damped: creeps back for ever with a speed that no longer matters
      if (v > before && std::fabs(v) < 1.0e-9) return 0.0;
    }
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

double hertz_damping_factor_limited(double e)
{
  // c = f sqrt(3/2): with kn = 1, S_n = 3/2 sqrt(x)
  const double wanted = std::clamp(e, 0.01, 1.0);
  double low = 0.0, high = 1.0;
  while (rebound_speed(high) > wanted) high *= 2.0;
  for (int n = 0; n < 40; n++) {
    const double middle = 0.5 * (low + high);
    (rebound_speed(middle) > wanted ? low : high) = middle;
  }
  return high / std::sqrt(1.5);
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
  return 1.0 /
      (2.0 * (2.0 - nu1) * (1.0 + nu1) / y1 + 2.0 * (2.0 - nu2) * (1.0 + nu2) / y2);
}

}    // namespace Talus
