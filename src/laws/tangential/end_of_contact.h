// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The end of a contact to second order in the time step. A force A t^p that ends a time t = theta
// dt after a step is summed by the steps with the error A dt^p zeta(-p, theta), see second_order.h.
// When it ends is only known in the first step without overlap: there it is made up for, by a force
// that acts in this step alone. Contacts of second order last until then:
//
//   last_overlap()     before the laws are computed: that of a step ago takes the place of the one
//                      that is not there any more, and the laws give the forces that end
//   EndOfContact       what to add for them
//
// Damping with `limit_damping` ends the normal force before the overlap, by gn v/kn. The history
// tells that a contact has ended, so that a set-up finds the same force, and is cleared in the next
// step.
//
// With these corrections alone an elastic impact loses a share of its energy in proportion to
// push^2, push = A dt^(p+1)/(m v): the change of the speed v by the force in a step from v dt on,
// in parts of it. Begin and end of a contact take the next terms, push A dt^p second_term(), so
// that what is left is push^3. For p = 1 they follow from v_(n+1/2)^2 + k/m d_n d_(n+1), which
// leapfrog keeps in a contact; for p = 3/2 they are fits, to 2e-5, to the corrections that give all
// contacts the same largest overlap, whenever they begin, and the same speed at the end.
//
// The overlap is curved: d(t) = w t + a t^2/2 with the acceleration a by others and by the turning
// of the contact (v_t^2 over the distance). With e = a dt/w the force A t^p (1 + p a t/(2 w)) and
// the moment at which its error is made up for, s dt from touching on, change the error in work to
// that of A dt^p (zeta(-p, theta) + e ((p/2 + 1) zeta(-p-1, theta) - s zeta(-p, theta))).

#ifndef TALUS_LAWS_TANGENTIAL_END_OF_CONTACT_H
#define TALUS_LAWS_TANGENTIAL_END_OF_CONTACT_H

#include "base/simd.h"
#include "laws/approach.h"

namespace Talus {

/// History value of second order that tells of the last step of a contact: 0: it was not there;
/// below zero: it was, -1, less 1 if it began in it, less 2 if it slid; above zero: it ended, 1,
/// and 2 if it slid.
struct Past {
  /// It was there in a run with order 1, with an unknown force.
  static constexpr double of_order_1 = -8.0;
};

/// Whether a contact without overlap lasts for this step: it has ended on the way here, or, in a
/// set-up, in the last step.
inline bool has_just_ended(double past, bool advance)
{
  return advance ? past < 0.0 : past != 0.0;
}

/// Sets `separated`, and in the place of the overlap that of the last step where the bodies are
/// apart, by more than `pulloff_distance`.
template <class Real> TALUS_INLINE void last_overlap(ContactState<Real> &s, double dt)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), least = -s.pulloff_distance;
  const auto touches = s.overlap > least;
  const Real v = dot(s.velocity, s.normal);
  const Real before = s.overlap + dt * (v - 0.5 * dt * centrifugal(s, v));
  s.separated = select(touches, zero, one);
  s.overlap = select(touches, s.overlap, select(before > least, before, least));
}

enum class Event : bool { BEGIN, END };

/// The step in which a contact begins or ends: the event.
template <class Real> struct EventStep {
  bool_of<Real> happens;
  Real theta;           ///< time since the begin, or until the end, over dt; in (0, 1]
  Real step_overlap;    ///< overlap that the speed at the event adds in a step
  Real curvature;       ///< e
};

/// `others`: change of the normal velocity in dt by other contacts and fields. `may`: where an
/// event is possible.
template <Event which, class Real>
EventStep<Real> event_step(const ContactState<Real> &s, Real overlap, Real v_n, Real others,
                           bool_of<Real> may, double dt)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), half = splat<Real>(0.5);
  const Real turning = dt * centrifugal(s, v_n), apart = v_n - half * turning;
  const Real half_way = dt * (which == Event::END ? apart : -apart);
  EventStep<Real> event;
  event.happens = may & (overlap > zero) & (half_way >= overlap);
  const Real step = select(event.happens, half_way, one);
  const Real curvature = select(event.happens, -dt * (others + turning) / step, zero);
  event.curvature = select(curvature > one, one, select(curvature < -one, -one, curvature));
  const Real straight = select(event.happens, overlap / step, one);
  event.theta = straight * (one - half * event.curvature * (one - straight));
  event.step_overlap = step * (one + event.curvature * (half - event.theta));
  return event;
}

/// Stands for a normal force of zero, so that limits of friction are lengths that a vector can be given;
/// not above `no_force`.
inline constexpr double zero_force = 1.0e-200, no_force = 2.0e-200;

/// Where damping ~ overlap^p has held the normal force at 0 which is `force` now, the part of the
/// step since it began to grow: before, springs were at rest.
template <class Real>
TALUS_INLINE Real share_since_return(const ContactLanes<Real> &s, Real p, Real force, double dt)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), v = s.normal_velocity;
  const Real change = 2.0 * dot(s.velocity_change, s.normal) + dt * centrifugal(s, v);
  const auto touches = s.overlap > zero;
  const Real of_gn = p * s.gn * v / select(touches, s.overlap, one);
  const Real growth = dt * v * (of_gn - s.tangent_n) - s.gn * change;
  return select(growth > force, force / select(growth > zero, growth, one), one);
}

/// For p = 1 and 3/2, 0 < theta <= 1; a decelerating force at the begin of a contact, an
/// accelerating one at its end.
template <Event which, class Real> TALUS_INLINE Real second_term(Real p, Real theta)
{
  constexpr int terms = 6;
  constexpr double linear[2][terms] = {{0.0, 0.0, 1.0 / 12.0, 0.0, -0.125, 0.0},
                                       {1.0 / 144.0, -1.0 / 24.0, -1.0 / 12.0, 0.25, -0.125, 0.0}};
  constexpr double hertzian[2][terms] = {
      {0.000834058, -0.0195192, -0.000165652, 0.0916618, 0.000220944, -0.0801479},
      {0.000166992, 0.0303978, -0.0539675, -0.0992979, 0.2033, -0.0804567}};
  constexpr int at = which == Event::END ? 1 : 0;
  Real sum = splat<Real>(0.0);
  for (int n = terms - 1; n >= 0; n--)
    sum = theta * sum +
          select(p < splat<Real>(1.25), splat<Real>(linear[at][n]), splat<Real>(hertzian[at][n]));
  return sum;
}

/// What the sum over the steps lacks of the friction f of a contact that sticks in its last step
/// and ends theta steps later, where its limit is 0: on the way there it changes by `rate` in a
/// step until it meets the limit, and follows it.
template <class Real>
TALUS_INLINE Vector3<Real> end_of_sticking(const Vector3<Real> &f, const Vector3<Real> &rate,
                                           Real limit, Real theta)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), half = splat<Real>(0.5);
  const Real size = square_root(dot(f, f)), some = select(size > zero, one / size, zero);
  const Real falls = limit / theta, closes = falls + some * dot(f, rate);
  const Real until = select(closes > zero, (limit - size) / closes, theta);
  const Real sticks = select(until < theta, select(until > zero, until, zero), theta);
  const Real slides = theta - sticks;
  return (sticks - half + half * slides * slides * falls * some) * f +
         (half * sticks * sticks - splat<Real>(1.0 / 12.0)) * rate;
}

/// Forces of contacts that have ended, and their history from now on.
template <class Real> struct EndOfContact {
  bool_of<Real> separated;
  Real normal_force, elastic, adhesive_share;
  Vector3<Real> tangential;
  Real history[5];

  /// A contact without overlap stores nothing, and its force dissipates nothing.
  void replace(ContactLanes<Real> &s, Vector3<Real> &t, Real *h) const
  {
    const Real zero = splat<Real>(0.0);
    s.overlap = select(separated, zero, s.overlap);
    s.elastic = select(separated, elastic, s.elastic);
    s.kt = select(separated, zero, s.kt);
    s.normal_force = select(separated, normal_force, s.normal_force);
    s.critical_force = select(separated, magnitude(normal_force), s.critical_force);
    s.adhesive_share = select(separated, adhesive_share, s.adhesive_share);
    s.force = select(separated, normal_force * s.normal, s.force);
    t = select(separated, tangential, t);
    for (int n = 0; n < 5; n++) h[n] = select(separated, history[n], h[n]);
  }
};

}    // namespace Talus

#endif
