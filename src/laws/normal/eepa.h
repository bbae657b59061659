// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Edinburgh elasto-plastic adhesion, EEPA: Thakur, Morrissey, Sun, Chen, Ooi (2014, Granular Matter 16, 383; equations 5
// and 13), with the exponents, and the adhesion that grows with the plastic contact, of Morrissey (2013, thesis,
// University of Edinburgh). Of x = overlap/R_eff and the largest one, x_m,
//
//   F_e = k1 x^n - f0                      loading, as deep as never before
//   F_e = k2 (x^n - x_p^n) - f0            unloading and loading again, x_p^n = lambda x_m^n
//   F_e = -F_m (x/x_min)^chi - f0          where that would attract more
//
// with k1 = 4/3 E_eff R_eff^2, which for n = 3/2 is Hertz', and k2 = k1/(1 - lambda). The third branch begins at x_min,
// where the second has F_m = 3/2 pi gamma a, with the radius a = R_eff sqrt(2 x_p) in which spheres with the overlap x_p
// intersect, but not more than half of k2 x_p^n: shallow contacts would not part else. On that branch x_m is set back so
// that the second one begins there; F_m and x_min stay those of the deepest state. All that is left where bodies come
// apart is f0, which ends. Friction is limited by mu (F_e + f0 + F_m (x/x_min)^chi), without damping.

#ifndef TALUS_LAWS_NORMAL_EEPA_H
#define TALUS_LAWS_NORMAL_EEPA_H

#include "base/power.h"
#include "laws/normal/hysteretic.h"

#include <algorithm>
#include <limits>

namespace Talus {

template <class Real> struct EepaRow {
  Real shear, young;
  Real gamma, lambda;
  Real f0, n, chi;
};

struct Eepa : NormalLaw {
  static constexpr const char *name = "eepa", *label = name, *damping = "restitution";
  static constexpr bool hysteretic = true, cohesive = true, needs_radius = true;
  static constexpr double exponent = 1.5;
  static constexpr int even_history = 2;    // x_m^n, as branches set it back, and the largest one
  template <class Real> using Row = EepaRow<Real>;
  static constexpr CoefficientName coefficients[] = {
      {"G_eff", Shown::WITH_SPRING}, {"E_eff"}, {"gamma"}, {"lambda"}, {"f0"}, {"n"}, {"chi"}};

  /// E, coefficient of damping, nu, gamma, lambda, f0, n, chi.
  static void read(LawReader &r)
  {
    GivenNumbers &given = r.spec.given;
    read_material(r, Damping::ANY);
    r.set_not_negative("gamma");
    given["lambda"] = r.words.between("plasticity ratio lambda", 0.0, largest_lambda);
    given["f0"] = r.words.not_negative("pull-off force f0");
    given["n"] = r.words.between("exponent n", 1.0, 3.0);
    given["chi"] = r.words.between("exponent chi", 1.0, 10.0);
  }
  /// A kt that was given by number stands for 8 G.
  static EepaRow<double> mix(const Mixing &m)
  {
    return {mixed_shear(m, 1.0 / 8.0),
            mixed_young(m),
            m.geometric("gamma"),
            m.mean("lambda"),
            m.mean("f0"),
            m.mean("n"),
            m.mean("chi")};
  }

  /// What unloading gives back.
  static double stored(const ContactLanes<double> &s, const EepaRow<double> &c,
                       const double * /*history*/)
  {
    const double x = std::max(s.overlap, 0.0) / s.radius, u = real_power(x, c.n);
    const double stiff = stiffest(c, s.radius);
    const double end = std::max(u - (s.elastic + c.f0) / stiff, 0.0),
                 at = real_power(end, 1.0 / c.n);
    return stiff * s.radius * ((x * u - at * end) / (c.n + 1.0) - end * (x - at)) -
           c.f0 * s.overlap;
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *history,
                                   double /*dt*/)
  {
    const Real zero = splat<Real>(0.0), least = splat<Real>(std::numeric_limits<double>::min());
    const Real x = at_least(s.overlap / s.radius, zero), u = power(x, c.n);
    const Real soft = softest(c, s.radius), stiff = stiffest(c, s.radius);
    const Real line = at_least(history[0], u), deepest = at_least(history[1], line);
    const Real pull = adhesion(c, s.radius, stiff, deepest, u);
    const auto pulls = stiff * u - (stiff - soft) * line < -pull;
    const Real kept = select(pulls, (stiff * u + pull) / (stiff - soft), line);
    // of what is kept: that of a later set-up
    s.elastic = stiff * u - (stiff - soft) * kept - c.f0;
    set_stiffness(c, u / at_least(x, least) / s.radius, soft, stiff, s);
    s.contact_radius = square_root(s.overlap * s.radius);
    s.pulloff_force = at_least(0.5 * (pull + c.f0), least);    // see finish_normal_force()
    if (!advance) return;
    history[0] = kept;
    history[1] = deepest;
  }

 private:
  static constexpr double pi = 3.14159265358979323846, largest_lambda = 0.999;

  /// x^p, of exponents that most materials have by products and a root: real_power() takes several times as long.
  template <class Real> TALUS_INLINE static Real power(Real x, Real p)
  {
    const Real one = splat<Real>(1.0), two = splat<Real>(2.0), of_hertz = splat<Real>(1.5);
    const auto is_two = p == two, is_hertz = p == of_hertz;
    const auto is_other = (p != one) & (p != two) & (p != of_hertz);
    Real result = x;
    if (any(is_two)) result = select(is_two, x * x, result);
    if (any(is_hertz)) result = select(is_hertz, x * square_root(x), result);
    if (any(is_other)) result = select(is_other, real_power(x, p), result);
    return result;
  }

  template <class Real> TALUS_INLINE static Real softest(const Row<Real> &c, Real radius)
  {
    return (4.0 / 3.0) * c.young * radius * radius;
  }
  template <class Real> TALUS_INLINE static Real stiffest(const Row<Real> &c, Real radius)
  {
    return softest(c, radius) / (splat<Real>(1.0) - c.lambda);
  }

  /// The attraction of the third branch at u = x^n.
  template <class Real>
  TALUS_INLINE static Real adhesion(const Row<Real> &c, Real radius, Real stiff, Real deepest,
                                    Real u)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    if (!any(c.gamma > zero)) return zero;
    const Real plastic = c.lambda * deepest, half = 0.5 * stiff * plastic;
    const Real patch =
        1.41421356237309504880 * radius * real_power(plastic, splat<Real>(0.5) / c.n);
    const Real by_area = (1.5 * pi) * c.gamma * patch, most = select(by_area < half, by_area, half);
    const auto sticks = most > zero;
    const Real share = select(sticks, u, zero) / select(sticks, plastic - most / stiff, one),
               cap = splat<Real>(1.0e29);    // its powers are finite
    return most * power(select(share < cap, share, cap), c.chi / c.n);
  }

  /// `slope`: x^(n-1)/R. The steepest branch is what time steps depend on; the ratio of kt to the slope of loading is
  /// Mindlin's.
  template <class Real>
  TALUS_INLINE static void set_stiffness(const Row<Real> &c, Real slope, Real soft, Real stiff,
                                         ContactLanes<Real> &s)
  {
    s.kn = soft * slope;
    s.tangent_n = c.n * stiff * slope;
    s.kt = s.tangent_t = (16.0 / 3.0) * c.shear * s.radius * s.radius * c.n * slope;
  }
};

}    // namespace Talus

#endif
