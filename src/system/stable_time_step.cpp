// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/stable_time_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace Talus;

namespace LAMMPS_NS {
namespace {

/// Root of stiffness dt^2 + damping dt = 4 mass, written so that nothing cancels.
double root(double stiffness, double damping, double mass)
{
  const double below = damping + std::sqrt(damping * damping + 16.0 * stiffness * mass);
  return below > 0.0 ? 8.0 * mass / below : std::numeric_limits<double>::infinity();
}

}    // namespace

double largest_stable_time_step(const ContactResponse &contact, double mass, int contacts,
                                int order)
{
  const auto [kn, gn, kt, gt] = contact;
  const double each = contacts / 3.0, turning = 5.0 * each, weight = 2.0 * order;
  const double of_others = order > 1 ? 1.0 - 1.0 / each : 1.0;
  const double dt =
      std::min(root(each * (kn + 2.0 * kt), weight * each * (of_others * gn + 2.0 * gt), mass),
               root(turning * kt, weight * turning * gt, mass));
  return std::isinf(dt) ? 0.0 : dt;
}

}    // namespace LAMMPS_NS
