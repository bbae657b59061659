// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The tangential laws of LAMMPS' pair granular. Spring and dashpot, F_t = -(k d + g v_t) with the
// stiffness k = kt, or kt a of Mindlin's (contact radius a), and g = xt gn of the damping law; not
// longer than L = mu times critical_force, by the rule "stock" of sliding.h. Lever arms end in the
// middle of the overlap. What is kept is
//
//   the displacement d, which every step turns into the tangent plane with its length, if it has
//   left it by more than 1e-10 of the limit (Luding 2008, Granular Matter 10, 235, equation 17),
//   and then lengthens by dt v_t;
//
//   or (.../force) the elastic force, which every step changes by -k dt v_t: so that it stays when
//   k changes with the overlap (Thornton, Cummins and Cleary 2013, Powder Technology 233, 30);
//
//   and with mindlin_rescale* also the contact radius of the last step: both shrink with the
//   contact radius when a contact is unloaded.
//
// The classic ones lengthen first and then take away the part along the normal, as gran/*/history.
// A step with dt = 0 is how LAMMPS sets up a run: only the limit acts.

#ifndef TALUS_LAWS_TANGENTIAL_GRANULAR_H
#define TALUS_LAWS_TANGENTIAL_GRANULAR_H

#include "laws/restitution.h"
#include "laws/tangential/common.h"
#include "laws/tangential/multistep.h"
#include "laws/tangential/sliding.h"

namespace Talus {

template <class Real> struct GranularRow {
  Real kt, xt, mu;
};

/// Words [kt] xt mu; with_kt of laws with a spring; NULL, if allowed, is 8 times the effective
/// shear modulus of the materials.
void read_granular_friction(LawReader &r, bool with_kt, bool null_allowed);

struct GranularFriction : TangentialLaw {
  static constexpr bool lever_arms = true;
  static constexpr bool of_force = false, rescales = false;
  template <class Real> using Row = GranularRow<Real>;
  static constexpr CoefficientName coefficients[] = {{"kt"}, {"xt"}, {"mu"}};

  static GranularRow<double> mix(const Mixing &m)
  {
    return {m.both_have("kt") ? m.geometric("kt") : 0.0, m.geometric("xt"), m.friction("mu")};
  }
};

struct LinearNoHistory : GranularFriction {
  static constexpr const char *name = "linear_nohistory", *label = name;
  static const Law *order_2(bool adhesive);
  static constexpr CoefficientName coefficients[] = {{"kt", Shown::NEVER}, {"xt"}, {"mu"}};

  static void read(LawReader &r) { read_granular_friction(r, false, false); }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    const Vector3<Real> drag = -(c.xt * s.gn) * surface_velocity(s);
    add_tangential_in_overlap(s, capped(drag, c.mu * s.critical_force));
  }
};

/// kt a is the stiffness; the force is kept; it is rescaled.
enum class Scaled : bool { NO, YES };
enum class Kept : bool { DISPLACEMENT, FORCE };
enum class Rescaled : bool { NO, YES };

template <Scaled scaled, class Real>
TALUS_INLINE Real granular_stiffness(const GranularRow<Real> &c, const ContactLanes<Real> &s)
{
  return scaled == Scaled::YES ? c.kt * s.contact_radius : c.kt;
}

/// kt = NULL of a law that scales is that of the materials.
template <Scaled scaled> GranularRow<double> mix_of_spring(const Mixing &m)
{
  GranularRow<double> row = GranularFriction::mix(m);
  if (scaled == Scaled::YES && !m.both_have("kt")) {
    const GivenNumbers &a = m.a.given, &b = m.b.given;
    row.kt = 8.0 * effective_shear(a.value("E"), a.value("nu"), b.value("E"), b.value("nu"));
  }
  return row;
}

/// The history is at its limit if the force of spring and dashpot is so but for rounding: nothing
/// else has to be kept to find that out.
template <class Real> TALUS_INLINE TangentialHistory<Real> granular_history(const Vector3<Real> &d)
{
  const Real zero = splat<Real>(0.0);
  return {d, select(dot(d, d) > zero, splat<Real>(1.0), zero)};
}

/// By more than what LAMMPS takes for rounding.
template <class Real>
TALUS_INLINE bool_of<Real> leaves_plane(const SlidingInput<Real> &in, const Vector3<Real> &d,
                                        const Vector3<Real> &normal)
{
  return magnitude(dot(d, normal)) * in.kt > 1.0e-10 * in.limit;
}

template <Scaled scaled, Kept kept, Rescaled rescaled> struct GranularSpring : GranularFriction {
  static constexpr bool needs_radius = scaled == Scaled::YES;
  /// One that shrinks with the contact radius loses a good part of its energy.
  static constexpr bool has_spring = rescaled == Rescaled::NO;
  static constexpr bool stiffens = scaled == Scaled::YES && has_spring;
  static constexpr int odd_history = 3, even_history = rescaled == Rescaled::YES ? 1 : 0;
  static constexpr bool of_force = kept == Kept::FORCE, rescales = rescaled == Rescaled::YES;

  static GranularRow<double> mix(const Mixing &m) { return mix_of_spring<scaled>(m); }

  template <class Real>
  static Real stored(const ContactLanes<Real> &s, const Row<Real> &c, const Real *h)
  {
    const Real k = granular_stiffness<scaled>(c, s),
               square = h[0] * h[0] + h[1] * h[1] + h[2] * h[2], zero = splat<Real>(0.0);
    if (of_force) return select(k > zero, 0.5 * square / k, zero);
    return 0.5 * k * square;
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    follow<advance, false>(c, s, h, dt);
  }

  /// `synchronized`: see synchronized.h.
  template <bool advance, bool synchronized, class Real>
  TALUS_INLINE static void follow(const GranularRow<Real> &c, ContactLanes<Real> &s, Real *h,
                                  double dt)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const Real k = granular_stiffness<scaled>(c, s);
    // a force that is kept is the displacement of a spring of stiffness 1, with the other sign
    const double sign = of_force ? -1.0 : 1.0;
    SlidingInput<Real> in{of_force ? one : k, c.xt * s.gn, surface_velocity(s),
                          c.mu * s.critical_force, splat<Real>(dt)};
    Vector3<Real> d{sign * h[0], sign * h[1], sign * h[2]};
    if constexpr (rescaled == Rescaled::YES) {
      const auto shrinks = s.contact_radius < h[3];
      d = select(shrinks, s.contact_radius / h[3], one) * d;
    }
    auto moved = splat<Real>(dt) > zero;
    if (advance && dt > 0.0) {
      d = select(leaves_plane(in, d, s.normal), rotated_to_plane(d, s.normal), d);
      d = d + (of_force ? k * dt : splat<Real>(dt)) * in.velocity;
      if constexpr (rescaled == Rescaled::YES) h[3] = s.contact_radius;
      if constexpr (synchronized) {
        const auto turns = leaves_plane(in, d, s.full_normal);
        d = select(turns, rotated_to_plane(d, s.full_normal), d);
        in.velocity = select(turns, rotated_to_plane(in.velocity, s.full_normal), in.velocity);
      }
    } else
      moved = dot(d, d) > zero;
    TangentialHistory<Real> history = granular_history(d);
    add_tangential_in_overlap(s, limited_force<advance, false>(in, d, moved, history));
    if constexpr (advance) {
      h[0] = sign * history.displacement.x;
      h[1] = sign * history.displacement.y;
      h[2] = sign * history.displacement.z;
    }
  }
};

struct LinearHistory : GranularSpring<Scaled::NO, Kept::DISPLACEMENT, Rescaled::NO> {
  static constexpr const char *name = "linear_history", *label = name;
  static const Law *order_2(bool adhesive);
  static void read(LawReader &r) { read_granular_friction(r, true, false); }
};

struct Mindlin : GranularSpring<Scaled::YES, Kept::DISPLACEMENT, Rescaled::NO> {
  static constexpr const char *name = "mindlin", *label = name;
  static const Law *order_2(bool adhesive);
  static void read(LawReader &r) { read_granular_friction(r, true, true); }
};

struct MindlinForce : GranularSpring<Scaled::YES, Kept::FORCE, Rescaled::NO> {
  static constexpr const char *name = "mindlin/force", *label = name;
  static const Law *order_2(bool adhesive);
  static void read(LawReader &r) { read_granular_friction(r, true, true); }
};

struct MindlinRescale : GranularSpring<Scaled::YES, Kept::DISPLACEMENT, Rescaled::YES> {
  static constexpr const char *name = "mindlin_rescale", *label = name;
  static const Law *order_2(bool adhesive);
  static void read(LawReader &r) { read_granular_friction(r, true, true); }
};

struct MindlinRescaleForce : GranularSpring<Scaled::YES, Kept::FORCE, Rescaled::YES> {
  static constexpr const char *name = "mindlin_rescale/force", *label = name;
  static const Law *order_2(bool adhesive);
  static void read(LawReader &r) { read_granular_friction(r, true, true); }
};

/// Chosen by name only in LAMMPS of 4 Feb 2025: there both classic laws scale with the contact
/// radius, and a displacement that is set back at the limit is divided by kt instead of kt a.
enum class SetBack : bool { BY_STIFFNESS, BY_COEFFICIENT };

template <Scaled scaled, SetBack set_back = SetBack::BY_STIFFNESS>
struct GranularClassic : GranularFriction {
  static constexpr bool needs_radius = scaled == Scaled::YES, has_spring = true;
  static constexpr bool stiffens = scaled == Scaled::YES;
  static constexpr int odd_history = 3;

  static GranularRow<double> mix(const Mixing &m) { return mix_of_spring<scaled>(m); }

  template <class Real>
  static Real stored(const ContactLanes<Real> &s, const Row<Real> &c, const Real *h)
  {
    return 0.5 * granular_stiffness<scaled>(c, s) * (h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    follow<advance, false>(c, s, h, dt);
  }

  /// A displacement that is synchronized is not turned once more: so in LAMMPS.
  template <bool advance, bool synchronized, class Real>
  TALUS_INLINE static void follow(const GranularRow<Real> &c, ContactLanes<Real> &s, Real *h,
                                  double dt)
  {
    const Real zero = splat<Real>(0.0);
    const SlidingInput<Real> in{granular_stiffness<scaled>(c, s), c.xt * s.gn, surface_velocity(s),
                                c.mu * s.critical_force, splat<Real>(dt)};
    Vector3<Real> d{h[0], h[1], h[2]};
    auto moved = splat<Real>(dt) > zero;
    if (advance && dt > 0.0) {
      d = d + in.dt * in.velocity;
      d = d - dot(d, s.normal) * s.normal;
    } else
      moved = dot(d, d) > zero;
    TangentialHistory<Real> history = granular_history(d);
    add_tangential_in_overlap(s, limited_force<advance, false>(in, d, moved, history));
    if constexpr (!advance) return;
    const auto slides = history.sliding > zero;
    const Real length = set_back == SetBack::BY_COEFFICIENT
                            ? select(slides, s.contact_radius, splat<Real>(1.0))
                            : splat<Real>(1.0);
    h[0] = length * history.displacement.x;
    h[1] = length * history.displacement.y;
    h[2] = length * history.displacement.z;
  }
};

struct LinearHistoryClassic : GranularClassic<Scaled::NO> {
  static constexpr const char *name = "linear_history_classic", *label = name;
  static const Law *order_2(bool adhesive) { return LinearHistory::order_2(adhesive); }
  static void read(LawReader &r) { read_granular_friction(r, true, false); }
};

struct MindlinClassic : GranularClassic<Scaled::YES> {
  static constexpr const char *name = "mindlin_classic", *label = name;
  static const Law *order_2(bool adhesive) { return Mindlin::order_2(adhesive); }
  static void read(LawReader &r) { read_granular_friction(r, true, true); }
};

struct ClassicOfFeb2025 : GranularClassic<Scaled::YES, SetBack::BY_COEFFICIENT> {
  static constexpr const char *name = "classic of 4 Feb 2025", *label = "classic";
};

}    // namespace Talus

#endif
