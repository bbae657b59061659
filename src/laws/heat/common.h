// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What laws of heat conduction have in common: a coefficient, of unlike types the geometric mean, and the radius of the
// circle through which heat flows. That is the contact radius of the normal law, or with the word `modulus` the one that
// grains with this Young's modulus and Poisson's ratio have under the same load, where the moduli of the normal law are
// smaller for the sake of the time step:
//
//   a_real = (3/4 R P/E_real)^(1/3)
//
// with the elastic force P, or 0 where it attracts. Of JKR and DMT P is the load of Hertz that belongs to their contact
// radius a, kn a^2/R. Hertzian laws with E_eff then have a (E_eff/E_real)^(1/3).

#ifndef TALUS_LAWS_HEAT_COMMON_H
#define TALUS_LAWS_HEAT_COMMON_H

#include "base/power.h"
#include "laws/law_definition.h"
#include "laws/restitution.h"

namespace Talus {

template <class Real> struct ConductionRow {
  Real heat;
  Real modulus;    ///< effective one of the real grains; 0: that of the normal law is the real one
  Real of_circle;    ///< 1: the contact radius tells the load (JKR, DMT)
};

struct Conduction : HeatLaw {
  template <class Real> using Row = ConductionRow<Real>;
  static constexpr CoefficientName coefficients[] = {
      {"heat"}, {"real_E_eff"}, {"load_of_circle", Shown::NEVER}};

  /// The coefficient, and perhaps "modulus" E nu.
  static void read(LawReader &r)
  {
    r.set_not_negative("heat");
    read_modulus(r);
  }
  static ConductionRow<double> mix(const Mixing &m)
  {
    return {m.geometric("heat"), mixed_modulus(m), load_of_circle(m)};
  }

 protected:
  static void read_modulus(LawReader &r)
  {
    if (!r.words.take("modulus")) return;
    r.spec.given["real E"] = r.words.positive("Young's modulus E of the grains") * r.pressure_unit;
    r.spec.given["real nu"] = r.words.between("Poisson's ratio nu of the grains", -1.0, 0.5, true);
  }

  /// By compliance. A material without the word is as stiff as its normal law says, if that says it.
  static double mixed_modulus(const Mixing &m)
  {
    const GivenNumbers &a = m.a.given, &b = m.b.given;
    if (!a.has("real E") && !b.has("real E")) return 0.0;
    const auto young = [](const GivenNumbers &g) { return g.value("real E", g.value("E")); };
    const auto poisson = [](const GivenNumbers &g) {
      return g.has("real E") ? g.value("real nu") : g.value("nu");
    };
    if (!(young(a) > 0.0 && young(b) > 0.0)) return 0.0;
    return effective_young(young(a), poisson(a), young(b), poisson(b));
  }

  static double load_of_circle(const Mixing &m)
  {
    const Law &normal = m.a.law.normal();
    return normal.cohesive && !normal.hysteretic ? 1.0 : 0.0;
  }

  /// Radius of the circle through which heat flows, by these coefficients of a row.
  template <class AnyRow, class Real>
  TALUS_INLINE static Real radius_of_circle(const AnyRow &c, const ContactLanes<Real> &s)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), a = s.contact_radius;
    const auto is_given = c.modulus > zero;
    if (!any(is_given)) return a;
    const Real load_and_radius = select(c.of_circle > zero, s.kn * a * a, s.elastic * s.radius);
    const Real cube = 0.75 * load_and_radius / select(is_given, c.modulus, one);
    return select(is_given, cube_root(select(cube > zero, cube, zero)), a);
  }

  /// T_2 - T_1, but 0 of a contact of second order that has just ended.
  template <class Real> TALUS_INLINE static Real difference(const ContactLanes<Real> &s)
  {
    const Real zero = splat<Real>(0.0);
    return select(s.separated > zero, zero, s.temperature_difference);
  }
};

}    // namespace Talus

#endif
