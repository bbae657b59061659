// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Conduction through the contact and through the gas around it, of grains that conduct better than the gas (Batchelor
// and O'Brien 1977, Proc. R. Soc. A 355, 313; Vargas and McCarthy 2002, Int. J. Heat Mass Transf. 45, 4847), and through
// the gap of grains that are near each other: with alpha = k/k_gas, R = 2 R_1 R_2/(R_1 + R_2), the contact radius a, the
// gap h, 0 where they touch, and the radius r = column times that of the smaller grain, through which heat comes to the
// gap, the first body receives
//
//   (2 k a + pi k_gas R H)(T_2 - T_1),   H = ln(1 + (alpha r/R)^2/F)
//   F = 50 + 8 sqrt(lambda) + lambda + 40 beta + 2.4 beta^2,   lambda = alpha^2 h/R,   beta = alpha a/R
//
// F is a fit, with the limits of the paper: H = ln alpha^2 + 2 ln(r/R) - 3.9 of a point, less ln lambda of a wide gap,
// and less ln beta^2 and a number of a wide contact. The sum 2 beta/pi + H is by at most 0.15 another one than that of
// the integral equation of two half spaces with the gap of Hertz between them; tests/unit/gas_gap_test.cpp solves it.
// Gaps up to reach R conduct, whether the grains have touched or not.

#ifndef TALUS_LAWS_HEAT_GAS_H
#define TALUS_LAWS_HEAT_GAS_H

#include "base/power.h"
#include "laws/heat/common.h"

#include <string>

namespace Talus {

template <class Real> struct GasRow {
  Real heat, modulus, of_circle;    ///< k, and see ConductionRow
  Real gas, column, reach;
};

struct HeatGas : Conduction {
  static constexpr const char *name = "gas", *label = "heat gas";
  static constexpr bool lasts_beyond_contact = true;
  template <class Real> using Row = GasRow<Real>;
  static constexpr CoefficientName coefficients[] = {
      {"heat"}, {"real_E_eff"}, {"load_of_circle", Shown::NEVER}, {"gas"}, {"column"}, {"reach"}};

  /// k k_gas column reach, and perhaps "modulus" E nu.
  static void read(LawReader &r)
  {
    r.check_later(r.words.index() - 1, [](const ContactLaw &law) -> std::string {
      const bool adheres = law.normal().lasts_beyond_contact;
      if (!adheres && !law.bridges()) return "";
      return std::string("heat gas acts between grains that have not touched, and ") +
             (adheres ? law.normal().name : law.cohesion().name) +
             " only after they have: use heat radius, or adhesion that ends with the contact";
    });
    GivenNumbers &given = r.spec.given;
    given["heat"] = r.words.positive("conductivity k of the grains");
    given["gas"] = r.words.positive("conductivity of the gas");
    given["gas column"] = r.words.positive("radius of the column over that of the grain");
    given["gas reach"] = r.words.positive("reach over the radius");
    read_modulus(r);
  }

  static GasRow<double> mix(const Mixing &m)
  {
    return {m.geometric("heat"), mixed_modulus(m),     load_of_circle(m),
            m.geometric("gas"),  m.mean("gas column"), m.largest("gas reach")};
  }

  /// In proportion to the radius, as ContactLaw::reaches() demands.
  template <class Real>
  TALUS_INLINE static Real pulloff_cube(const GasRow<Real> &c, const ContactSize<Real> &size)
  {
    const Real distance = 2.0 * c.reach * size.radius;
    return distance * distance * distance;
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const GasRow<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    const Real a = radius_of_circle(c, s);
    s.heat_flow = (2.0 * c.heat * a + through_gas(c, a, s)) * difference(s);
  }

 private:
  /// Power over difference of temperature.
  template <class Real>
  TALUS_INLINE static Real through_gas(const GasRow<Real> &c, Real a, const ContactLanes<Real> &s)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const Real alpha = c.heat / c.gas, over_radius = alpha / (2.0 * s.radius);
    const Real gap = select(s.overlap < zero, -s.overlap, zero);
    const Real lambda = alpha * over_radius * gap, beta = over_radius * a;
    const Real f = 50.0 + 8.0 * square_root(lambda) + lambda + (40.0 + 2.4 * beta) * beta;
    const Real column = over_radius * c.column * smaller_radius(s);
    return (2.0 * 3.14159265358979323846) * c.gas * s.radius * logarithm(one + column * column / f);
  }

  /// From the sum of both and the effective radius; against a large body that of the sphere.
  template <class Real> TALUS_INLINE static Real smaller_radius(const ContactLanes<Real> &s)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const Real inverse_sum = s.inverse_distance / (one + s.overlap * s.inverse_distance);
    const Real square = one - 4.0 * s.radius * inverse_sum;
    return 2.0 * s.radius / (one + square_root(select(square > zero, square, zero)));
  }
};

}    // namespace Talus

#endif
