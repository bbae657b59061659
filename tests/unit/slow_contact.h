// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The slow reference of the contact kernels: one contact of two bodies in plain scalar code,
// written from the equations and from the logic of the stock gran/hooke/history and
// gran/hertz/history, sharing no line with src/contact. It works on the bodies (arms, surface
// points, torques), not on the reduced state.

#ifndef TALUS_TEST_SLOW_CONTACT_H
#define TALUS_TEST_SLOW_CONTACT_H

#include "named_law.h"

#include <array>
#include <cmath>

namespace slow {

using Vector = std::array<double, 3>;

inline double inner(const Vector &a, const Vector &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline double norm(const Vector &a)
{
  return std::sqrt(inner(a, a));
}

inline Vector axpy(double s, const Vector &a, const Vector &b)
{
  return {s * a[0] + b[0], s * a[1] + b[1], s * a[2] + b[2]};
}

inline Vector outer(const Vector &a, const Vector &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Two bodies in contact. Infinite masses and radii are allowed; a body of infinite radius does not
/// spin.
struct Contact {
  Vector normal{};    ///< from body 1 to body 0; zero if the centers coincide
  double overlap = 0.0;
  std::array<double, 2> radius{1.0, 1.0}, mass{1.0, 1.0};
  std::array<Vector, 2> velocity{}, omega{};
  Vector history{};    ///< displacement as body 0 sees it
  bool sliding = false;
};

/// Force on body 0 (body 1: the opposite), torques on both, and the history afterwards. The scales
/// are the sums of the magnitudes of all terms of a result: what its rounding error is measured by.
struct Outcome {
  Vector force{};
  double normal_force = 0.0;
  std::array<Vector, 2> torque{};
  Vector history{};
  bool sliding = false;
  bool clear_case = true;    ///< false if the trial force is the limit up to rounding
  double force_scale = 0.0, history_scale = 0.0;
};

/// a b / (a + b), also if one or both are infinite; two infinite masses make 0, that is no damping.
inline double reduced(double a, double b)
{
  if (std::isinf(a)) return std::isinf(b) ? 0.0 : b;
  return std::isinf(b) ? a : a * b / (a + b);
}

inline Outcome evaluate(const Contact &c, named::NamedLaw law, const named::Numbers &p, double dt,
                        bool advance)
{
  const double m_eff = reduced(c.mass[0], c.mass[1]);
  double factor = 1.0;
  if (law.normal == named::Normal::HERTZ)
    factor = std::sqrt(c.overlap * reduced(c.radius[0], c.radius[1]));
  const double kn = factor * p.kn, kt = factor * p.kt;
  const double gn = factor * m_eff * p.gn, gt = factor * m_eff * p.gt;

  // velocities of the two surface points; arms have the full radius
  Vector surface[2], arm[2];
  double speeds = 0.0;
  for (int b = 0; b < 2; b++) {
    const double r = std::isinf(c.radius[b]) ? 0.0 : c.radius[b];
    const double sign = b == 0 ? -1.0 : 1.0;
    arm[b] = {sign * r * c.normal[0], sign * r * c.normal[1], sign * r * c.normal[2]};
    const Vector turning = outer(c.omega[b], arm[b]);
    surface[b] = axpy(1.0, c.velocity[b], turning);
    speeds += norm(c.velocity[b]) + r * norm(c.omega[b]);
  }
  const Vector relative = axpy(-1.0, surface[1], surface[0]);
  const double v_n = inner(axpy(-1.0, c.velocity[1], c.velocity[0]), c.normal);
  const Vector v_t = axpy(-inner(relative, c.normal), c.normal, relative);

  double f_n = kn * c.overlap - gn * v_n;
  if (std::isfinite(p.force_floor) && f_n < p.force_floor) f_n = p.force_floor;
  const double limit = p.mu * std::fabs(f_n);
  const double normal_scale = kn * c.overlap + gn * speeds;

  Outcome out;
  out.history = c.history;
  out.sliding = c.sliding;
  Vector f_t{};
  double tangential_scale = 0.0;

  if (law.tangential == named::Tangential::DASHPOT ||
      law.tangential == named::Tangential::ONESTEP) {
    const double k = law.tangential == named::Tangential::ONESTEP ? kt : 0.0;
    const double size = (k * dt + gt) * norm(v_t);
    for (int d = 0; d < 3; d++) f_t[d] = -k * (dt * v_t[d]) - gt * v_t[d];
    if (size > limit)
      for (double &f : f_t) f *= limit / size;
    tangential_scale = (k * dt + gt) * speeds;
  }

  if (law.tangential == named::Tangential::MULTISTEP) {
    Vector s = c.history;
    if (advance) s = axpy(dt, v_t, s);
    const bool moved = norm(s) != 0.0;
    if (advance) s = axpy(-inner(s, c.normal), c.normal, s);
    for (int d = 0; d < 3; d++) f_t[d] = -(kt * s[d] + gt * v_t[d]);
    const double size = norm(f_t);
    const double reach = norm(c.history) + (advance ? dt * speeds : 0.0);
    tangential_scale = kt * reach + gt * speeds;
    out.clear_case = std::fabs(size - limit) > 1e-13 * (tangential_scale + p.mu * normal_scale);

    bool slides = size > limit && moved;
    if (advance) {
      if (slides)
        for (int d = 0; d < 3; d++)
          s[d] = limit / size * (s[d] + gt * v_t[d] / kt) - gt * v_t[d] / kt;
      out.history = s;
      out.sliding = slides;
      const double slip = kt > 0.0 ? (gt * speeds + p.mu * normal_scale) / kt : 0.0;
      out.history_scale = reach + slip;
    } else {
      const double parts = kt * norm(s) + gt * norm(v_t) + limit;
      slides = slides || (c.sliding && size + 1e-12 * parts >= limit);
    }

    // a force at the limit points along the trial force, whatever the size of that is
    if (slides || size > limit)
      for (double &f : f_t) f = slides && size > 0.0 ? f * (limit / size) : 0.0;
    if (slides && size > 0.0 && limit > size) tangential_scale *= limit / size;
  }

  if (law.tangential != named::Tangential::NONE) tangential_scale += p.mu * normal_scale;
  out.normal_force = f_n;
  out.force = axpy(f_n, c.normal, f_t);
  out.force_scale = normal_scale + tangential_scale;
  if (law.tangential != named::Tangential::NONE) {
    const Vector opposite{-out.force[0], -out.force[1], -out.force[2]};
    out.torque[0] = outer(arm[0], out.force);
    out.torque[1] = outer(arm[1], opposite);
  }
  return out;
}

}    // namespace slow

#endif
