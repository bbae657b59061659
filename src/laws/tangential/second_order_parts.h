// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the law of second_order.h is made of: which friction, spring and adhesion it has, what the history tells of
// the last step, and the numbers of a contact that both its steps and its end (second_order_end.h) need.

#ifndef TALUS_LAWS_TANGENTIAL_SECOND_ORDER_PARTS_H
#define TALUS_LAWS_TANGENTIAL_SECOND_ORDER_PARTS_H

#include "laws/rounding.h"
#include "laws/tangential/adhesive_contact.h"
#include "laws/tangential/common.h"
#include "laws/tangential/end_of_contact.h"

#include <type_traits>

namespace Talus {

/// What the history tells of the last step of a contact.
template <class Real> struct LastStep {
  bool_of<Real> known;       ///< it was there
  bool_of<Real> is_given;    ///< with a force that is known
  Real force;                ///< normal one, 0 if not
  bool_of<Real> began, slid;
};

template <class Real> TALUS_INLINE LastStep<Real> last_step(Real past, Real force)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), two = splat<Real>(2.0);
  const bool_of<Real> known = past < zero;
  const bool_of<Real> is_given = known & (past > splat<Real>(Past::of_order_1));
  const Real flags = -past - one;
  const bool_of<Real> slid = is_given & (flags >= two);
  const bool_of<Real> began = is_given & (select(slid, flags - two, flags) >= one);
  return {known, is_given, select(is_given, force, zero), began, slid};
}

/// DASHPOT: a spring without stiffness. TANH: that of tanh.h, with the velocity at the time of the
/// positions.
enum class Friction { NONE, SPRING, DASHPOT, TANH };

/// Whether the normal law has adhesion of its own, see adhesive_contact.h.
enum class Adhesion : bool { NO, YES };

/// What a spring does when its stiffness changes: nothing if it has none of its own.
template <class Granular> struct SpringOf {
  static constexpr bool scaled = Granular::needs_radius, of_force = Granular::of_force,
                        rescales = Granular::rescales;
};
template <> struct SpringOf<void> {
  static constexpr bool scaled = false, of_force = false, rescales = false;
};

/// See SecondOrder.
template <Friction kind_of_friction, class Granular, Adhesion adhesion_of_normal_law>
struct SecondOrderKind {
  static constexpr Friction kind = kind_of_friction;
  static constexpr bool friction = kind == Friction::SPRING || kind == Friction::DASHPOT;
  static constexpr bool granular = !std::is_void_v<Granular>;
  static constexpr bool scaled = SpringOf<Granular>::scaled;
  static constexpr bool of_force = SpringOf<Granular>::of_force;
  static constexpr bool rescales = SpringOf<Granular>::rescales;
  static constexpr bool follows_radius = of_force || rescales;
  static constexpr bool adhesive = adhesion_of_normal_law == Adhesion::YES;
};

template <class Kind> struct SecondOrderParts : Kind {
  using Kind::adhesive, Kind::granular, Kind::of_force;
  template <class Real> using Row = SecondOrderRow<Real>;

  template <class Real>
  TALUS_INLINE static Real stiffness(const Row<Real> &c, const ContactLanes<Real> &s)
  {
    if constexpr (Kind::kind == Friction::DASHPOT) return splat<Real>(0.0);
    if constexpr (Kind::scaled) return c.kt * s.contact_radius;
    return granular ? c.kt : s.kt;
  }

  /// For p = 0. Never exactly 1: other stages recognize by it contacts that begin.
  template <class Real> TALUS_INLINE static Real share_at_begin(Real theta)
  {
    const Real one = splat<Real>(1.0), share = splat<Real>(0.5) + theta;
    return select(magnitude(share - one) > splat<Real>(0.0), share, splat<Real>(1.0 + 1.0e-15));
  }

  /// The history of a spring is its displacement or, with the sign of the laws of order 1, its
  /// force.
  template <class Real> TALUS_INLINE static Vector3<Real> displacement_of(Real kt, const Real *h)
  {
    const Vector3<Real> kept{h[0], h[1], h[2]};
    if constexpr (!of_force) return kept;
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    return select(kt > zero, splat<Real>(-1.0) / select(kt > zero, kt, one), zero) * kept;
  }
  template <class Real> TALUS_INLINE static Vector3<Real> elastic_force_of(Real kt, const Real *h)
  {
    const Vector3<Real> kept{h[0], h[1], h[2]};
    return of_force ? -kept : kt * kept;
  }

  /// SpringStep::mean of the step in which a contact begins, its contact radius at 0 or, of jkr,
  /// above it.
  template <class Real> TALUS_INLINE static Real mean_at_begin(const Row<Real> &c)
  {
    const Real one = splat<Real>(1.0);
    if constexpr (!of_force) return one;
    return select(detaches<adhesive>(c), one, splat<Real>(2.0 / 3.0));
  }

  /// Contact radius a step ago over that of now.
  template <class Real>
  TALUS_INLINE static Real radius_ratio(const Row<Real> &c, const ContactLanes<Real> &s, double dt)
  {
    const Real zero = splat<Real>(0.0), v = s.normal_velocity;
    const Real way = -dt * (v - 0.5 * dt * centrifugal(s, v)), old = s.overlap - way;
    const Real ratio = square_root(quotient(select(old > zero, old, zero), s.overlap));
    if constexpr (!adhesive) return ratio;
    const auto at_once = detaches<adhesive>(c);
    return any(at_once) ? select(at_once, jkr_radius_ratio(s, way), ratio) : ratio;
  }

  template <class Real> TALUS_INLINE static void add_adhesion(ContactLanes<Real> &s)
  {
    const Real adhesion = s.adhesive_share * s.pulloff_force;
    s.elastic = s.elastic - adhesion;
    s.normal_force = s.normal_force - adhesion;
    s.critical_force = s.critical_force + adhesion;
    s.force = s.force - adhesion * s.normal;
  }

  /// Of the surfaces, at the time of the positions.
  template <class Real>
  TALUS_INLINE static Vector3<Real> present_velocity(const ContactLanes<Real> &s)
  {
    return surface_velocity_of(s.velocity + s.velocity_change,
                               s.surface_rotation + s.rotation_change, s.normal);
  }

  /// Rounded as in the history; without adhesion above zero.
  template <class Real>
  TALUS_INLINE static Real find_normal_force(const ContactLanes<Real> &s,
                                             const LastStep<Real> &last)
  {
    const Real one = splat<Real>(1.0), least = splat<Real>(zero_force);
    const Real by_others = dot(s.velocity_change, s.normal) - s.lag * s.inverse_mass * last.force;
    const Real v = s.normal_velocity + by_others;
    const Real force = (s.elastic - s.gn * v) / (one + s.gn * s.lag * s.inverse_mass);
    return rounded<47>(adhesive ? force : select(force > least, force, least));
  }

  /// Of friction where the overlap is 0 and the normal force is that of damping, with gn over gt of
  /// now; 0 if it goes faster to 0 than gt.
  template <class Real>
  TALUS_INLINE static Real limit_at_begin(const Row<Real> &c, const ContactLanes<Real> &s)
  {
    const Real zero = splat<Real>(0.0), limit = -c.mu * s.gn * s.normal_velocity;
    if constexpr (adhesive)
      return c.mu *
             (s.pulloff_force + select(detaches<adhesive>(c), jkr_begin * s.pulloff_force, zero));
    return select((limit > zero) & (c.damping <= c.dashpot), limit, zero);
  }

  /// What friction at a limit that is above 0 at the ends of a contact lacks, because it grows to it
  /// there: as a spring, `of_spring`, or as a dashpot.
  template <class Real>
  static Real grows_to_limit(const Row<Real> &c, const ContactLanes<Real> &s, Real of_spring,
                             Real limit, const Vector3<Real> &trial, Real theta)
  {
    const Real zero = splat<Real>(0.0), size = square_root(dot(trial, trial));
    const auto exceeds = size > limit;
    const Real of_dashpot = select(detaches<adhesive>(c), zero, c.dashpot);
    const Real p = select(s.kt > zero, of_spring, of_dashpot);
    const Real share = missing_share(limit, select(exceeds, size, splat<Real>(1.0)), p);
    return select(exceeds, theta * limit * share, zero);
  }
};

}    // namespace Talus

#endif
