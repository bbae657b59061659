// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Liquid bridges. One is made when bodies touch and lasts until their surfaces are apart by
//
//   (1 + theta/2) V^(1/3)
//
// with the contact angle theta in radians (Lian, Thornton, Adams 1993, J. Colloid Interface Sci. 161, 138). Of its
// volume V, tension gamma and the gap S between the surfaces, 0 where they touch, depends a capillary force (willett.h,
// rabinovich.h); R is that of Derjaguin, 2 R_1 R_2/(R_1 + R_2), twice the effective radius, and that of equal spheres.
//
// With a viscosity eta, and g = S/R_eff but not below the least gap,
//
//   F_n = -6 pi eta R_eff v_n/g                            (Adams and Perchard 1985; Lian, Adams, Thornton 1996)
//   F_t = -6 pi eta R_eff v_t (.9588 - 8/15 ln g) >= 0     (Goldman, Cox, Brenner 1967; Nase et al. 2001)
//
// with the velocity v_t of the surfaces. The volume is given, or a share of the volumes of the particles: of
// bridges that take their liquid from particles (liquid_of_particles.h) the largest one, and what they have is in the
// history.

#ifndef TALUS_LAWS_COHESION_LIQUID_BRIDGE_H
#define TALUS_LAWS_COHESION_LIQUID_BRIDGE_H

#include "base/power.h"
#include "laws/law_list.h"
#include "laws/tangential/common.h"

#include <cmath>

namespace Talus {

template <class Real> struct BridgeRow {
  Real gamma, cosine, sine;    ///< of the contact angle, means of both materials
  Real reach;                  ///< 1 + theta/2
  Real volume, fraction;       ///< V = volume + fraction (V_1 + V_2)
  Real viscosity, least_gap;
};

template <class Real> struct Bridge {
  Real gap, radius, volume;    ///< S, R, V
};

/// Model: name, label, and of a row and a bridge its force() and work(), the integral of the force from S = 0 on.
template <class Model> struct LiquidBridge : CohesionLaw {
  static constexpr const char *name = Model::name, *label = Model::label;
  static constexpr bool lasts_beyond_contact = true, reads_sums_alone = true;
  template <class Real> using Row = BridgeRow<Real>;
  static constexpr CoefficientName coefficients[] = {{"gamma"},
                                                     {"cos_theta"},
                                                     {"sin_theta", Shown::NEVER},
                                                     {"reach", Shown::NEVER},
                                                     {"volume"},
                                                     {"fraction"},
                                                     {"viscosity"},
                                                     {"least_gap"}};

  /// gamma, theta, "volume" V or "fraction" f, and perhaps "viscosity" eta least_gap and "share" part, in any order.
  static void read(LawReader &r)
  {
    GivenNumbers &given = r.spec.given;
    given["tension"] = r.words.not_negative("surface tension gamma");
    given["theta"] = pi / 180.0 * r.words.between("contact angle in degrees", 0.0, 90.0);
    const bool is_volume = r.words.choice("volume of the bridge", {"volume", "fraction"}) == 0;
    given[is_volume ? "bridge volume" : "bridge fraction"] =
        r.words.positive(is_volume ? "volume of the bridge" : "fraction of the particles' volume");
    while (true)
      if (!given.has("viscosity") && r.words.take("viscosity")) {
        given["viscosity"] = r.words.not_negative("viscosity eta") * r.pressure_unit;
        given["least gap"] = r.words.positive("least gap over the effective radius");
      } else if (!given.has("share") && r.words.take("share")) {
        given["share"] =
            r.words.between("share of the liquid between the particles", 0.0, 1.0, true);
        r.spec.law.choose(Stage::COHESION, find_law(Stage::COHESION, Model::of_particles));
      } else {
        return;
      }
  }

  static BridgeRow<double> mix(const Mixing &m)
  {
    const double one = m.a.given.value("theta"), other = m.b.given.value("theta");
    const double least_gap = m.largest("least gap");
    return {m.mean("tension"),
            0.5 * (std::cos(one) + std::cos(other)),
            0.5 * (std::sin(one) + std::sin(other)),
            1.0 + 0.25 * (one + other),
            m.mean("bridge volume"),
            m.mean("bridge fraction"),
            m.mean("viscosity"),
            least_gap > 0.0 ? least_gap : 1.0};
  }

  template <class Real>
  TALUS_INLINE static Real pulloff_cube(const BridgeRow<Real> &c, const ContactSize<Real> &size)
  {
    return c.reach * c.reach * c.reach * (c.volume + c.fraction * size.volume);
  }

  /// From overlap 0 on.
  static double stored(const ContactLanes<double> &s, const BridgeRow<double> &c,
                       const double * /*history*/)
  {
    const Bridge<double> bridge = bridge_of(c, s);
    return s.overlap < 0.0 ? Model::work(c, bridge) : -s.overlap * Model::force(c, bridge);
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const BridgeRow<Real> &c, ContactLanes<Real> &s,
                                   Real * /*history*/, double /*dt*/)
  {
    const Bridge<Real> bridge = bridge_of(c, s);
    s.force = s.force - Model::force(c, bridge) * s.normal;
    if (any(c.viscosity > splat<Real>(0.0))) add_viscous_force(c, bridge.gap, s);
  }

 protected:
  template <class Real> TALUS_INLINE static Real gap_of(const ContactLanes<Real> &s)
  {
    const Real zero = splat<Real>(0.0);
    return select(s.overlap < zero, -s.overlap, zero);
  }

  template <class Real>
  TALUS_INLINE static void add_viscous_force(const BridgeRow<Real> &c, Real gap,
                                             ContactLanes<Real> &s)
  {
    const Real zero = splat<Real>(0.0), found = gap / s.radius;
    const Real g = select(found > c.least_gap, found, c.least_gap);
    const Real stokes = (6.0 * pi) * c.viscosity * s.radius;
    const Real shear = 0.9588 - 8.0 / 15.0 * logarithm(g);
    const Vector3<Real> along = -(stokes * s.normal_velocity / g) * s.normal,
                        across =
                            -(stokes * select(shear > zero, shear, zero)) * surface_velocity(s);
    s.tangential = s.tangential + across;
    s.force = s.force + along + across;
    s.torque_per_radius = s.torque_per_radius + cross(s.normal, across);
  }

 private:
  static constexpr double pi = 3.14159265358979323846;

  template <class Real>
  TALUS_INLINE static Bridge<Real> bridge_of(const BridgeRow<Real> &c, const ContactLanes<Real> &s)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    Real volume = c.volume;
    if (any(c.fraction > zero)) volume = volume + c.fraction * volume_of_particles(s, zero, one);
    return {gap_of(s), 2.0 * s.radius, volume};
  }

  /// From the sum of their radii and the effective one; against a large body that of one sphere.
  template <class Real>
  TALUS_INLINE static Real volume_of_particles(const ContactLanes<Real> &s, Real zero, Real one)
  {
    const auto are_two = s.inverse_distance > zero;
    const Real sum = s.overlap + one / select(are_two, s.inverse_distance, one);
    const Real cubes = sum * sum * (sum - 3.0 * s.radius);
    return 4.0 / 3.0 * pi * select(are_two, cubes, s.radius * s.radius * s.radius);
  }
};

}    // namespace Talus

#endif
