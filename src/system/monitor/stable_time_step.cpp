// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/monitor/stable_time_step.h"

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

double load(const ContactResponse &contact, const std::vector<HeldBody> &bodies, double dt_squared,
            double dt)
{
  const double normal = contact.kn * dt_squared + 2.0 * contact.gn * dt;
  const double tangential = contact.kt * dt_squared + 2.0 * contact.gt * dt;
  double sum = 0.0;
  for (const HeldBody &body : bodies) {
    const FaceStiffness *faces = body.faces;
    const double of_body = !faces ? std::max(4.0 * (normal + 2.0 * tangential), 20.0 * tangential)
                           : body.on_large_bodies ? faces->largest_on_bodies(normal, tangential)
                                                  : faces->largest(normal, tangential);
    sum += of_body / body.mass;
  }
  return sum;
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

double largest_stable_time_step(const ContactResponse &contact, const std::vector<HeldBody> &bodies)
{
  const double springs = load(contact, bodies, 1.0, 0.0),
               dashpots = load(contact, bodies, 0.0, 1.0);
  if (!(springs > 0.0)) return dashpots > 0.0 ? 4.0 / dashpots : 0.0;
  double below = 0.0, above = 2.0 / std::sqrt(springs);    // the load grows with dt
  for (int n = 0; n < 40 && dashpots > 0.0; n++) {
    const double dt = 0.5 * (below + above);
    (load(contact, bodies, dt * dt, dt) < 4.0 ? below : above) = dt;
  }
  return above;
}

}    // namespace LAMMPS_NS
