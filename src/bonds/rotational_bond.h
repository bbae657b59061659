// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The beam between two bonded spheres, for one bond (Real = double) or eight (Real = Vec8): that of LAMMPS' bond_style
// bpm/rotational. Sphere 1 is the one with the lower ID. Any consistent units.
//
// Frame PARTICLE: Y. Wang, Acta Geotechnica 4, 117 (2009). With n from 2 to 1, r the distance, p the rotation of 1
// against 2, and the vector between the centers when the bond was made turned along with 2:
//
//   shear   gamma  angle between that vector and the present one, about w
//   twist   psi    of p about n
//   bend    theta  of the axis n by p, about u, which is perpendicular to n
//   S = r/2 ks theta u - r ks gamma w
//   force on 2 = kr (r - r0) n + n x S,    torques -r/2 S + (kb theta u + kt psi n) on 2, and - ( ) on 1
//
// Frame AVERAGE: Alkuino et al. 2026, as in LAMMPS. The vector turns along with the mean of both spheres, gamma needs no
// part of theta, so that S = -r ks gamma w; twist and bend are found from the rotation of 2 against the mean, and doubled.
//
// LAMMPS finds angles by their cosine, which knows none below 1e-8, and goes through the frame of a sphere and one with
// n as its z-axis; here they are found from sine and cosine, and all vectors stay in space.

#ifndef TALUS_BONDS_ROTATIONAL_BOND_H
#define TALUS_BONDS_ROTATIONAL_BOND_H

#include "base/arc_tangent.h"
#include "base/vector3.h"
#include "body/motion/quaternion.h"

namespace Talus {

enum class BondFrame { PARTICLE, AVERAGE };

/// DEM: of relative velocities, Y. Wang, F. Alonso-Marroquin and W. Guo, Particuology 23, 49 (2015). RATE: of the rates
/// of the angles and of the distance.
enum class BondDamping { DEM, RATE };

/// One number for each way to strain a bond. Of stiffnesses the first two are force per length, the others torque; of
/// limits force and torque; of damping the same as of stiffnesses, times time.
template <class Real> struct FourWays {
  Real normal, shear, twist, bend;
};

template <class Real> struct BondCoeffs {
  FourWays<Real> stiffness, limit, damping;
};

/// Radians; as restart files of LAMMPS have them.
template <class Real> struct BondAngles {
  Real shear, bend, twist;
};

template <class Real> struct BondedPair {
  Vector3<Real> at_rest;    ///< x1 - x2 when the bond was made, of length 1
  Real length_at_rest;
  Vector3<Real> separation;    ///< x1 - x2 now
  Quaternion<Real> turn1, turn2;
  Vector3<Real> velocity, omega;    ///< of 1 less those of 2
  Vector3<Real> sum_of_omegas;      ///< read for damping DEM
  BondAngles<Real> before;          ///< a step ago; read for damping RATE
};

template <class Real> struct BondLoads {
  Vector3<Real> force, torque1, torque2;    ///< the force on 1; that on 2 is the opposite
  Real breaking;                            ///< the bond breaks at 1; not below 0
  Real energy;                              ///< as LAMMPS tells it
  Real stored;                              ///< what small elastic strains have taken to come to
  BondAngles<Real> angles;
};

namespace bond_detail {

/// How a bond is strained. Torques on 2 that turn it back act along the axes, unit vectors or zero.
template <class Real> struct Strain {
  Vector3<Real> normal;    ///< from 2 to 1
  Real length;
  Vector3<Real> shear_axis, twist_axis, bend_axis;
  BondAngles<Real> angles;
};

template <class Real> TALUS_INLINE Quaternion<Real> inverse(const Quaternion<Real> &q)
{
  return {q.w, -q.x, -q.y, -q.z};
}

template <class Real> TALUS_INLINE Vector3<Real> axis_of(const Quaternion<Real> &q)
{
  return {q.x, q.y, q.z};
}

template <class Real>
TALUS_INLINE Vector3<Real> rotated(const Quaternion<Real> &q, const Vector3<Real> &v)
{
  const Vector3<Real> axis = axis_of(q), turned = splat<Real>(2.0) * cross(axis, v);
  return v + q.w * turned + cross(axis, turned);
}

/// Of the same direction and length 1, or zero.
template <class Real> TALUS_INLINE Vector3<Real> direction(const Vector3<Real> &v, Real length)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  return select(length > zero, one / select(length > zero, length, one), zero) * v;
}

template <class Real> TALUS_INLINE Real length_of(const Vector3<Real> &v)
{
  return square_root(dot(v, v));
}

template <class Real>
TALUS_INLINE void set_shear(Strain<Real> &s, const Vector3<Real> &rest,
                            const Vector3<Real> &separation)
{
  const Vector3<Real> turn = cross(rest, separation);
  const Real sine = length_of(turn);
  s.shear_axis = direction(turn, sine);
  s.angles.shear = arc_tangent(sine, dot(rest, separation));
}

/// A rotation is a twist about the normal and a swing of it: parts of its quaternion.
template <class Real> struct TwistAndSwing {
  Real w, along;           ///< of the twist, times the cosine below
  Vector3<Real> across;    ///< perpendicular to the normal
  Real cosine2, sine2;     ///< squares of cosine and sine of half the swing

  TwistAndSwing(const Quaternion<Real> &q, const Vector3<Real> &normal) :
      w(q.w), along(dot(axis_of(q), normal)), across(axis_of(q) - along * normal),
      cosine2(w * w + along * along), sine2(dot(across, across))
  {
  }
};

template <class Real>
TALUS_INLINE void set_rotation_of_particle(Strain<Real> &s, const BondedPair<Real> &b)
{
  const Real zero = splat<Real>(0.0), two = splat<Real>(2.0);
  const TwistAndSwing<Real> p(b.turn1 * inverse(b.turn2), s.normal);
  const Real sine = square_root(p.sine2), cosine = square_root(p.cosine2);
  s.angles.bend = two * arc_tangent(sine, cosine);
  s.angles.twist = select(p.along == zero, zero, two * arc_tangent(p.along, p.w));
  s.twist_axis = s.normal;
  // the swing turned by half the twist; a swing by pi has none
  const Vector3<Real> u = p.w * p.across + p.along * cross(s.normal, p.across);
  s.bend_axis = select(p.cosine2 > zero, direction(u, sine * cosine), direction(p.across, sine));
}

/* Of twice the rotation from the mean to 2: twist by psi/2, swing about an axis turned by -psi/4 and by psi/4. */

template <class Real>
TALUS_INLINE void set_rotation_of_mean(Strain<Real> &s, const BondedPair<Real> &b,
                                       const Quaternion<Real> &mean)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), two = splat<Real>(2.0);
  const TwistAndSwing<Real> h(b.turn2 * inverse(mean), s.normal);
  const Real signed_twist =
      splat<Real>(4.0) * arc_tangent(select(h.w < zero, -h.along, h.along), magnitude(h.w));
  s.angles.twist = magnitude(signed_twist);
  s.twist_axis = select(signed_twist > zero, splat<Real>(-1.0), one) * s.normal;
  const Real scale = one / select(h.cosine2 > zero, h.cosine2, one);
  const Vector3<Real> swing = (two * h.w) * (h.across + (h.sine2 * h.along * scale) * s.normal);
  const Real sine = length_of(swing),
             cosine = h.cosine2 - h.sine2 * (h.w * h.w - h.along * h.along) * scale;
  s.angles.bend = two * arc_tangent(sine, cosine);
  s.bend_axis = -direction(swing, sine);
}

template <BondFrame frame, class Real>
TALUS_INLINE Strain<Real> strain_of(const BondedPair<Real> &b)
{
  Strain<Real> s;
  s.length = length_of(b.separation);
  s.normal = (splat<Real>(1.0) / s.length) * b.separation;
  const Vector3<Real> rest = b.length_at_rest * b.at_rest;
  if constexpr (frame == BondFrame::PARTICLE) {
    set_shear(s, rotated(b.turn2, rest), b.separation);
    set_rotation_of_particle(s, b);
  } else {
    const Quaternion<Real> &p = b.turn1, &q = b.turn2;
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const Real sign = select(p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z < zero, -one, one);
    const Quaternion<Real> mean =
        Quaternion<Real>{p.w + sign * q.w, p.x + sign * q.x, p.y + sign * q.y, p.z + sign * q.z}
            .normalized();
    set_shear(s, rotated(mean, rest), b.separation);
    set_rotation_of_mean(s, b, mean);
  }
  return s;
}

/// Between -pi and pi.
template <class Real> TALUS_INLINE Real within_half_turn(Real angle)
{
  constexpr double pi = 3.14159265358979323846;
  const Real half = splat<Real>(pi), whole = splat<Real>(2.0 * pi);
  return select(angle > half, angle - whole, select(angle < -half, angle + whole, angle));
}

template <class Real>
TALUS_INLINE void add_damping_of_velocities(BondLoads<Real> &to, const Strain<Real> &s,
                                            const BondedPair<Real> &b,
                                            const FourWays<Real> &damping)
{
  const Real half = splat<Real>(0.5);
  const Vector3<Real> n = s.normal;
  const Real closing = dot(b.velocity, n), spin = dot(b.omega, n);
  const Vector3<Real> slip =
      b.velocity - closing * n - (half * s.length) * cross(b.sum_of_omegas, n);
  const Vector3<Real> shear = damping.shear * slip;
  const Vector3<Real> of_shear = (half * s.length) * cross(n, shear);
  const Vector3<Real> of_turning =
      (half * damping.bend * s.length) * (b.omega - spin * n) + (half * damping.twist * spin) * n;
  to.force = to.force - (damping.normal * closing) * n - shear;
  to.torque1 = to.torque1 + of_shear - of_turning;
  to.torque2 = to.torque2 + of_shear + of_turning;
}

}    // namespace bond_detail

/// `inverse_dt`: read for damping RATE.
template <BondFrame frame, BondDamping damping, class Real>
TALUS_INLINE BondLoads<Real> load_bond(const BondedPair<Real> &b, const BondCoeffs<Real> &c,
                                       double inverse_dt)
{
  using namespace bond_detail;
  const Real zero = splat<Real>(0.0), half = splat<Real>(0.5);
  const Strain<Real> s = strain_of<frame>(b);
  const FourWays<Real> &k = c.stiffness;
  BondLoads<Real> to;
  to.angles = s.angles;
  const Real stretch = s.length - b.length_at_rest;
  const FourWays<Real> elastic{k.normal * stretch, k.shear * s.length * s.angles.shear,
                               k.twist * s.angles.twist, k.bend * s.angles.bend};
  FourWays<Real> all = elastic;
  Real by_bending = k.shear * s.angles.bend;    // r/2 times it is a force
  if constexpr (damping == BondDamping::RATE) {
    const Real per_time = splat<Real>(inverse_dt);
    const auto rate = [per_time](Real now, Real before) {
      return within_half_turn(now - before) * per_time;
    };
    const Real bending = rate(s.angles.bend, b.before.bend);
    all.normal = all.normal + c.damping.normal * dot(b.velocity, s.normal);
    all.shear = all.shear + c.damping.shear * s.length * rate(s.angles.shear, b.before.shear);
    all.twist = all.twist + c.damping.twist * rate(s.angles.twist, b.before.twist);
    all.bend = all.bend + c.damping.bend * bending;
    by_bending = by_bending + c.damping.shear * bending;
  }
  Vector3<Real> shear = -(all.shear * s.shear_axis),
                sheared = -(s.length * s.angles.shear * s.shear_axis);
  if constexpr (frame == BondFrame::PARTICLE) {
    shear = shear + (half * s.length * by_bending) * s.bend_axis;
    sheared = sheared + (half * s.length * s.angles.bend) * s.bend_axis;
  }
  const Vector3<Real> of_shear = (half * s.length) * shear;
  const Vector3<Real> turning = all.bend * s.bend_axis + all.twist * s.twist_axis;
  to.force = -(all.normal * s.normal) - cross(s.normal, shear);
  to.torque1 = -of_shear - turning;
  to.torque2 = turning - of_shear;

  // with damping, and of traction alone, or of the elastic part: as LAMMPS has it in that frame
  const bool of_particle = frame == BondFrame::PARTICLE;
  const FourWays<Real> acting =
      of_particle
          ? FourWays<Real>{all.normal, length_of(shear), magnitude(all.twist), magnitude(all.bend)}
          : FourWays<Real>{magnitude(elastic.normal), elastic.shear, elastic.twist, elastic.bend};
  const Real breaking = acting.normal / c.limit.normal + acting.shear / c.limit.shear +
                        acting.bend / c.limit.bend + acting.twist / c.limit.twist;
  to.breaking = larger(breaking, zero);
  to.energy = half * (k.normal * stretch * stretch + elastic.shear * s.length * s.angles.shear +
                      elastic.twist * s.angles.twist + elastic.bend * s.angles.bend);
  to.stored = half * (k.normal * stretch * stretch + k.shear * dot(sheared, sheared) +
                      elastic.twist * s.angles.twist + elastic.bend * s.angles.bend);
  if constexpr (damping == BondDamping::DEM) add_damping_of_velocities(to, s, b, c.damping);
  return to;
}

}    // namespace Talus

#endif
