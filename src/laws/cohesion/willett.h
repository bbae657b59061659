// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Capillary force of a liquid bridge in the closed form of Willett, Adams, Johnson, Seville (2000, Langmuir 16, 9396;
// equation 9):
//
//   F = 2 pi R gamma cos theta/(1 + 1.05 s + 2.5 s^2),   s = S sqrt(R/V)
//
// for small bridges, V < R^3/1000, within some percent of the equation of Laplace and Young.

#ifndef TALUS_LAWS_COHESION_WILLETT_H
#define TALUS_LAWS_COHESION_WILLETT_H

#include "laws/cohesion/liquid_bridge.h"

namespace Talus {

struct WillettModel {
  static constexpr const char *name = "willett", *label = "liquid bridge (Willett)";
  static constexpr const char *of_particles = "willett/share",
                              *label_of_particles = "liquid bridge (Willett, liquid of particles)";

  template <class Real>
  TALUS_INLINE static Real force(const BridgeRow<Real> &c, const Bridge<Real> &b)
  {
    const Real s = b.gap * square_root(b.radius / b.volume), one = splat<Real>(1.0);
    return at_contact(c, b) / (one + s * (1.05 + 2.5 * s));
  }

  static double work(const BridgeRow<double> &c, const Bridge<double> &b)
  {
    const double length = std::sqrt(b.volume / b.radius), s = b.gap / length;
    const double root = std::sqrt(4.0 * 2.5 - 1.05 * 1.05);
    const double integral =
        2.0 / root * (std::atan((5.0 * s + 1.05) / root) - std::atan(1.05 / root));
    return at_contact(c, b) * length * integral;
  }

 private:
  template <class Real>
  TALUS_INLINE static Real at_contact(const BridgeRow<Real> &c, const Bridge<Real> &b)
  {
    return (2.0 * 3.14159265358979323846) * b.radius * c.gamma * c.cosine;
  }
};

}    // namespace Talus

#endif
