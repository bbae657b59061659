// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How the tangential displacement of a contact of second order gets through a step, see
// second_order.h. All of it is of second order in the step and takes roots and quotients only where
// a contact slides:
//
//   turning   the normal turns by 2 q, across it, in the step. What is in the old tangent plane
//             gets into the new one by the rotation that takes one normal to the other: with the
//             one half way, n - q, x -> x - (x.n)(n - q).
//   slip      of the surfaces half way through the step, turned by q; v and w, the sum of r omega,
//             are those half way: v_t + v_n q - (w + w_n q) x n.
//   return    a sliding contact moves along the mean of its old and its new force (generalized
//             midpoint rule of plasticity: Ortiz and Popov 1985, Int. J. Numer. Meth. Eng. 21,
//             1561), and the spring follows the force g kt, |g kt| = L at its limit, by
//             (gt/kt) d' + d = g: with g kt/gt linear in the step, since g is infinite where a
//             contact begins whose spring is softer than its dashpot, an L-stable rule of second
//             order. Equal to the rule of Ortiz and Popov if gt = 0.

#ifndef TALUS_LAWS_TANGENTIAL_MIDPOINT_H
#define TALUS_LAWS_TANGENTIAL_MIDPOINT_H

#include "base/simd.h"
#include "laws/contact_lanes.h"

namespace Talus {

/// q, of a pair from the velocity of the centers, of a large body from what it tells.
template <class Real> TALUS_INLINE Vector3<Real> half_turn(const ContactState<Real> &s, double dt)
{
  const Vector3<Real> q =
      splat<Real>(0.5) * ((dt * s.inverse_distance) * s.velocity + s.normal_change);
  return q - dot(q, s.normal) * s.normal;
}

template <class Real>
TALUS_INLINE Vector3<Real> turned_by(const Vector3<Real> &q, const Vector3<Real> &d,
                                     const Vector3<Real> &n)
{
  return d - dot(d, n) * (n - q);
}

/// v_t of these velocities, n across the surface.
template <class Real>
TALUS_INLINE Vector3<Real>
surface_velocity_of(const Vector3<Real> &v, const Vector3<Real> &rotation, const Vector3<Real> &n)
{
  return v - dot(v, n) * n - cross(rotation, n);
}

/// Velocity of the surfaces half way through the step that led here, turned by q.
template <class Real>
TALUS_INLINE Vector3<Real> velocity_half_way(const ContactLanes<Real> &s, const Vector3<Real> &q)
{
  const Vector3<Real> &w = s.surface_rotation;
  const Vector3<Real> along = s.velocity - s.normal_velocity * s.normal;
  return along + s.normal_velocity * q - cross(w + dot(w, s.normal) * q, s.normal);
}

/// What the return of a sliding contact to its limit takes.
template <class Real> struct Slide {
  Real kt, gt, overlap;
  Real old_overlap;                 ///< a step ago
  Real kt_exponent, gt_exponent;    ///< kt ~ overlap^p
  Real limit, old_limit;            ///< of the force now and a step ago; in the first step, of the
                                    ///< force where the contact began, with gt of now
  Vector3<Real> before;             ///< displacement, turned into the plane of now
  Vector3<Real> half_way, end;      ///< velocity of the surfaces half way and now
  Vector3<Real> trial;              ///< force of spring and dashpot if it did not slide
  Real time;                        ///< that the displacement has grown for in the step
  double dt;
};

/// x^p for p = 0, 1/4, 1/2, 1, 3/2 and x >= 0.
template <class Real> TALUS_INLINE Real power(Real x, Real p)
{
  const Real root = square_root(x);
  const auto chosen = [p](double below, Real yes, Real no) {
    return select(p < splat<Real>(below), yes, no);
  };
  return chosen(0.125, splat<Real>(1.0),
                chosen(0.375, square_root(root), chosen(0.75, root, chosen(1.25, x, x * root))));
}

/// Displacement of a contact that slides in its first step, its overlap half of what it is now half
/// way.
template <class Real> Vector3<Real> first_slide(const Slide<Real> &s)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), half = splat<Real>(0.5);
  const auto safe = [&](Real a) { return select(a > zero, a, one); };
  const Real of_g = power(half, s.gt_exponent), g = s.gt * of_g;
  const Real m = s.time * s.kt * power(half, s.kt_exponent), sum = g * g + g * m + half * m * m;
  const Real along = one / safe(square_root(dot(s.trial, s.trial)));
  const Real rate = of_g * g * (s.old_limit + s.limit), rest = m * m * s.limit / safe(s.kt);
  return one / safe(sum) * ((g * g) * s.before + (half * along * (s.time * rate + rest)) * s.trial);
}

/// Displacement of a contact that slides and was there a step ago.
template <class Real> TALUS_INLINE Vector3<Real> slide(const Slide<Real> &s)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const double dt = s.dt;
  const auto safe = [&](Real a) { return select(a > zero, a, one); };

  // stiffness and damping a step ago and half way
  const Real kt = safe(s.kt), overlap = safe(s.overlap), inverse = one / (kt * overlap);
  const Real x_old = kt * inverse * select(s.old_overlap > zero, s.old_overlap, zero);
  const Real x_mid = 0.5 * (one + x_old);
  const Real kt_old = s.kt * power(x_old, s.kt_exponent),
             gt_old = s.gt * power(x_old, s.gt_exponent);
  const Real of_g = power(x_mid, s.gt_exponent);
  const Real k = s.kt * power(x_mid, s.kt_exponent), g = s.gt * of_g;

  // spring at rest under the force of a step ago
  const Vector3<Real> old_end = splat<Real>(2.0) * s.half_way - s.end;
  const Vector3<Real> old_force = kt_old * s.before + gt_old * old_end;
  const Real old_size = square_root(dot(old_force, old_force));
  const Real held = select(old_size > s.old_limit, s.old_limit, old_size);
  const Real by = safe(kt_old), share = held / (safe(old_size) * by * safe(gt_old));
  const Vector3<Real> rest_old = select(kt_old > zero, share * safe(gt_old), zero) * old_force;

  // and under that of now, so that the mean of both is along the force half way
  const Vector3<Real> along = k * (s.before + (0.5 * s.time) * s.half_way) + g * s.half_way;
  const Real rest = s.limit * overlap * inverse;
  const Real b = dot(along, rest_old), square = dot(along, along);
  const Real root = b * b + square * (rest * rest - dot(rest_old, rest_old));
  const Real reach = b + square_root(select(root > zero, root, zero));
  const auto meets = (root >= zero) & (reach > zero) & (square > zero);
  Vector3<Real> rest_now = reach / select(meets, square, one) * along - rest_old;
  if (any(root < zero) || any(reach <= zero)) {
    const Real size = square_root(dot(s.trial, s.trial));
    rest_now = select(meets, rest_now, rest / safe(size) * s.trial);
  }

  const Real m = dt * k, sum = g * g + g * m + 0.5 * m * m;
  const Real old_rate = dt * g * g * share * by, rate = dt * g * of_g * s.kt;
  return one / safe(sum) *
         ((g * g) * s.before +
          splat<Real>(0.5) * (old_rate * old_force + (rate + m * m) * rest_now));
}

}    // namespace Talus

#endif
