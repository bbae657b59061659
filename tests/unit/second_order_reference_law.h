// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What second_order_reference.h computes with: laws, particles, planes, and the errors of sums over
// time steps.

#ifndef TALUS_TESTS_SECOND_ORDER_REFERENCE_LAW_H
#define TALUS_TESTS_SECOND_ORDER_REFERENCE_LAW_H

#include "resistance_reference.h"

#include <algorithm>
#include <cmath>

namespace Reference {

/// a by the rotation from one normal to n, which is half way at n - q; to second order in q.
inline Vec rotated(Vec a, Vec n, Vec q)
{
  return a + dot(a, n) * (q - n);
}

/// Hurwitz' zeta(-p, t), p >= 0, t > 0: Euler-Maclaurin behind the first terms of the sum.
inline double zeta(double p, double t)
{
  constexpr int terms = 12;
  double sum = 0.0;
  for (int k = 0; k < terms; k++) sum += std::pow(t + k, p);
  const double a = t + terms;
  return sum - std::pow(a, p + 1.0) / (p + 1.0) + 0.5 * std::pow(a, p) -
         p * std::pow(a, p - 1.0) / 12.0 +
         p * (p - 1.0) * (p - 2.0) * std::pow(a, p - 3.0) / 720.0 -
         p * (p - 1.0) * (p - 2.0) * (p - 3.0) * (p - 4.0) * std::pow(a, p - 5.0) / 30240.0;
}

/// Next terms in push = A dt^(p+1)/(m v), in parts of push A dt^p, for p = 1 (from the invariant
/// v_(n+1/2)^2 + k/m d_n d_(n+1)) and 3/2 (found by trial).
inline double second_at_begin(double p, double t)
{
  if (p == 1.0) return t * t / 12.0 - t * t * t * t / 8.0;
  return 0.000834058 + t * (-0.0195192 + t * (-0.000165652 +
                                              t * (0.0916618 + t * (0.000220944 - t * 0.0801479))));
}
inline double second_at_end(double p, double t)
{
  if (p == 1.0)
    return (1.0 - 6.0 * t - 12.0 * t * t + 36.0 * t * t * t - 18.0 * t * t * t * t) / 144.0;
  return 0.000166992 +
         t * (0.0303978 + t * (-0.0539675 + t * (-0.0992979 + t * (0.2033 - t * 0.0804567))));
}

enum class Damping { MASS, RADIUS, ROOT };    // m g; a m g; g sqrt(m dF/dd)

struct Law {
  bool hertz = false;
  Damping damping = Damping::MASS;
  double kn = 0.0, gn = 0.0, kt = 0.0, gt = 0.0, mu = 0.0;
  double adhesion = 0.0;
  Resistance resistance;
  bool limit_damping = true;
  bool slider = true;    // else the stock rule

  double elastic_exponent() const { return hertz ? 1.5 : 1.0; }
  /// Of the coefficients of damping.
  double damping_exponent() const
  {
    if (!hertz || damping == Damping::MASS) return 0.0;
    return damping == Damping::RADIUS ? 0.5 : 0.25;
  }
};

struct Measures {
  bool damping = true, implicit = true, midpoint = true, ends = true, slip = true, rolling = true;
  bool after = true;    // ends: forces that end with a jump or a kink as well

  static Measures none() { return {false, false, false, false, false, false, false}; }
};

struct Particle {
  Vec x, v, w;
  double radius = 0.5, mass = 1.0;
  Vec a{}, alpha{};    // accelerations of the last step
  Vec force{}, torque{};

  double inertia() const { return 0.4 * mass * radius * radius; }
};

struct Plane {
  Vec point, normal;
};

struct Contact {
  bool touches = false;
  double force = 0.0;    // normal one of the last step, without the correction of its beginning
  bool slid = false;
  Vec s;    // tangential displacement
  RememberedResistance resistance;
};

/// Stiffness and damping of a contact with overlap d.
struct Coefficients {
  double kn, gn, kt, gt;
};

inline Coefficients coefficients(const Law &law, double d, double mass, double radius)
{
  const double a = law.hertz ? std::sqrt(radius * std::max(d, 0.0)) : 1.0;
  const double kn = a * law.kn, kt = a * law.kt;
  switch (law.damping) {
  case Damping::MASS:
    return {kn, mass * law.gn, kt, mass * law.gt};
  case Damping::RADIUS:
    return {kn, a * mass * law.gn, kt, a * mass * law.gt};
  default:
    return {kn, law.gn * std::sqrt(mass * law.elastic_exponent() * kn), kt,
            law.gt * std::sqrt(mass * kt)};
  }
}

}    // namespace Reference

#endif
