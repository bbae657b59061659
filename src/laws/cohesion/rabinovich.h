// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Capillary force of a liquid bridge of Rabinovich, Esayanur, Moudgil (2005, Langmuir 21, 10992; equations 19, 20, A3),
// pressure and tension at the surface:
//
//   F = 2 pi R gamma (cos theta/(1 + S/(2 d)) + sin alpha sin(theta + alpha))
//   d = S/2 (-1 + sqrt(1 + 2 V/(pi R S^2))),   alpha^2 = 2 d/R
//
// With q = sqrt(S^2 + 2 V/(pi R)) the first term is 1 - S/q and alpha^2 = (q - S)/R, which hold for S = 0 as well. The
// half filling angle alpha is at most 90 degrees.

#ifndef TALUS_LAWS_COHESION_RABINOVICH_H
#define TALUS_LAWS_COHESION_RABINOVICH_H

#include "laws/cohesion/liquid_bridge.h"

namespace Talus {

/// (-1)^n/(2 n + odd)!, n = 0, 1, ..., of sine and cosine.
struct AlternatingSeries {
  static constexpr int terms = 12;
  double of[terms];

  constexpr explicit AlternatingSeries(int odd) : of()
  {
    double term = 1.0;
    for (int n = 0; n < terms; n++) {
      of[n] = term;
      term /= -static_cast<double>((2 * n + 1 + odd) * (2 * n + 2 + odd));
    }
  }
};

struct RabinovichModel {
  static constexpr const char *name = "rabinovich", *label = "liquid bridge (Rabinovich)";
  static constexpr const char *of_particles = "rabinovich/share",
                              *label_of_particles =
                                  "liquid bridge (Rabinovich, liquid of particles)";

  template <class Real>
  TALUS_INLINE static Real force(const BridgeRow<Real> &c, const Bridge<Real> &b)
  {
    const Real width = wetted(b), q = square_root(b.gap * b.gap + width);
    const Real pressure = c.cosine * (splat<Real>(1.0) - b.gap / q);
    return scale(c, b) * (pressure + at_surface(c, width / ((q + b.gap) * b.radius)));
  }

  /// The pressure's in closed form, the other over alpha, of which it is a smooth function.
  static double work(const BridgeRow<double> &c, const Bridge<double> &b)
  {
    const double width = wetted(b), q = std::sqrt(b.gap * b.gap + width), root = std::sqrt(width);
    const double of_pressure = c.cosine * (b.gap - b.gap * b.gap / (q + root));
    const auto slope = [&](double alpha) {
      const double path = width / (b.radius * alpha * alpha * alpha) + b.radius * alpha;
      return at_surface(c, alpha * alpha) * path;
    };
    const double last = std::sqrt(width / ((q + b.gap) * b.radius));
    return scale(c, b) * (of_pressure + integral(slope, last, std::sqrt(root / b.radius)));
  }

 private:
  static constexpr double pi = 3.14159265358979323846;

  template <class Real> TALUS_INLINE static Real wetted(const Bridge<Real> &b)
  {
    return (2.0 / pi) * b.volume / b.radius;
  }
  template <class Real>
  TALUS_INLINE static Real scale(const BridgeRow<Real> &c, const Bridge<Real> &b)
  {
    return (2.0 * pi) * b.radius * c.gamma;
  }

  /// sin alpha sin(theta + alpha) of alpha^2.
  template <class Real> TALUS_INLINE static Real at_surface(const BridgeRow<Real> &c, Real square)
  {
    const Real most = splat<Real>(0.25 * pi * pi), x = select(square < most, square, most);
    const Real sine = square_root(x) * series(of_sine, x), cosine = series(of_cosine, x);
    return sine * (c.cosine * sine + c.sine * cosine);
  }

  static constexpr AlternatingSeries of_sine{1}, of_cosine{0};

  /// Of three parts, which processors find beside each other (Estrin).
  template <class Real> TALUS_INLINE static Real series(const AlternatingSeries &c, Real x)
  {
    const Real x2 = x * x, x4 = x2 * x2;
    const auto four_terms = [&](int n) {
      return (c.of[n] + c.of[n + 1] * x) + (c.of[n + 2] + c.of[n + 3] * x) * x2;
    };
    return four_terms(0) + x4 * (four_terms(4) + x4 * four_terms(8));
  }

  /// By Gauss' formula of five points in eight parts.
  template <class Function> static double integral(const Function &f, double begin, double end)
  {
    constexpr double place[] = {0.0, 0.53846931010568309104, 0.90617984593866399280},
                     weight[] = {128.0 / 225.0, 0.47862867049936646804, 0.23692688505618908751};
    constexpr int parts = 8;
    const double half = 0.5 * (end - begin) / parts;
    double sum = 0.0;
    for (int part = 0; part < parts; part++) {
      const double middle = begin + (2 * part + 1) * half;
      sum += weight[0] * f(middle);
      for (int n : {1, 2})
        sum += weight[n] * (f(middle - half * place[n]) + f(middle + half * place[n]));
    }
    return half * sum;
  }
};

}    // namespace Talus

#endif
