// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Bridges of the liquid that particles have. It covers them as a film, and a bridge has what is on the caps of both
// particles that face each other, or a share of it (Shi and McCarthy 2008, Powder Technology 184, 64):
//
//   V = min(share (c_1 L_1 + c_2 L_2), V_max),   c_1 = (1 - sqrt(1 - (R_2/(R_1 + R_2))^2))/2
//
// with the liquid L of the particles and the part c of a sphere that is in the cone that touches the other one. Such
// cones of neighbors have nothing in common: all bridges of a particle take no more than it has, of whatever sizes and
// however many its neighbors are.
//
// V follows the liquid of the particles while these touch, and is the last such value where they are apart. All that
// time L includes what is in bridges. Where one breaks each particle has half of it: the first one receives
//
//   V (c_2 L_2 - c_1 L_1)/(2 (c_1 L_1 + c_2 L_2)),
//
// and the second one the opposite, with the liquid that they have then, and the share of that in place of V if it is
// less: no more leaves a particle than half of what is on the cap.

#ifndef TALUS_LAWS_COHESION_LIQUID_OF_PARTICLES_H
#define TALUS_LAWS_COHESION_LIQUID_OF_PARTICLES_H

#include "laws/cohesion/liquid_bridge.h"

#include <algorithm>
#include <cmath>

namespace Talus {

/// On the caps of two particles that face each other (distance^3).
struct FacingLiquid {
  double first, second;

  double sum() const { return first + second; }
};

/// Of spheres with these radii, > 0, and this liquid.
inline FacingLiquid facing_liquid(double radius_1, double liquid_1, double radius_2,
                                  double liquid_2)
{
  const auto cap = [](double sine) {    // (1 - cos)/2, of small ones as well
    return 0.5 * sine * sine / (1.0 + std::sqrt(1.0 - sine * sine));
  };
  const double sum = radius_1 + radius_2;
  return {cap(radius_2 / sum) * liquid_1, cap(radius_1 / sum) * liquid_2};
}

/// Of a bridge between surfaces that touch (distance^3).
inline double bridge_volume(const FacingLiquid &facing, double share, double largest)
{
  return std::min(share * facing.sum(), largest);
}

/// What the first particle receives of the second one where a bridge of this volume breaks (distance^3).
inline double flow_at_rupture(const FacingLiquid &facing, double share, double volume)
{
  const double sum = facing.sum();
  return sum > 0.0 ? 0.5 * std::min(volume, share * sum) / sum * (facing.second - facing.first)
                   : 0.0;
}

template <class Real> struct LiquidRow {
  Real gamma, cosine, sine, reach, volume, fraction, viscosity, least_gap;    ///< see BridgeRow
  Real share;

  BridgeRow<Real> bridge() const
  {
    return {gamma, cosine, sine, reach, volume, fraction, viscosity, least_gap};
  }
};

/// Chosen by "share" behind the words of LiquidBridge<Model>. Its history: V, not above 0 of dry particles, set before
/// compute() by who knows L.
template <class Model> struct LiquidBridgeOfParticles : LiquidBridge<Model> {
  using Given = LiquidBridge<Model>;
  static constexpr const char *name = Model::of_particles, *label = Model::label_of_particles;
  static constexpr bool shares_liquid = true;
  static constexpr int even_history = 1;
  static constexpr std::nullptr_t read = nullptr;
  template <class Real> using Row = LiquidRow<Real>;
  static constexpr CoefficientName coefficients[] = {
      Given::coefficients[0], Given::coefficients[1], Given::coefficients[2],
      Given::coefficients[3], Given::coefficients[4], Given::coefficients[5],
      Given::coefficients[6], Given::coefficients[7], {"share"}};

  static LiquidRow<double> mix(const Mixing &m)
  {
    const BridgeRow<double> c = Given::mix(m);
    return {c.gamma,    c.cosine,    c.sine,      c.reach,        c.volume,
            c.fraction, c.viscosity, c.least_gap, m.mean("share")};
  }

  template <class Real>
  TALUS_INLINE static Real pulloff_cube(const LiquidRow<Real> &c, const ContactSize<Real> &size)
  {
    return Given::pulloff_cube(c.bridge(), size);
  }

  static double stored(const ContactLanes<double> &s, const LiquidRow<double> &c,
                       const double *history)
  {
    if (!(history[0] > 0.0)) return 0.0;
    const Bridge<double> bridge = bridge_of(s, history[0]);
    return s.overlap < 0.0 ? Model::work(c.bridge(), bridge)
                           : -s.overlap * Model::force(c.bridge(), bridge);
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const LiquidRow<Real> &c, ContactLanes<Real> &s, Real *history,
                                   double /*dt*/)
  {
    const Real zero = splat<Real>(0.0);
    const auto is_wet = history[0] > zero;
    const Bridge<Real> bridge = bridge_of(s, select(is_wet, history[0], splat<Real>(1.0)));
    BridgeRow<Real> row = c.bridge();
    s.force = s.force - select(is_wet, Model::force(row, bridge), zero) * s.normal;
    row.viscosity = select(is_wet, row.viscosity, zero);
    if (any(row.viscosity > zero)) Given::add_viscous_force(row, bridge.gap, s);
  }

 private:
  template <class Real>
  TALUS_INLINE static Bridge<Real> bridge_of(const ContactLanes<Real> &s, Real volume)
  {
    return {Given::gap_of(s), 2.0 * s.radius, volume};
  }
};

}    // namespace Talus

#endif
