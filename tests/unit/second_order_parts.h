// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What second_order_reference.h computes with: laws, particles, planes, the errors of sums over
// time steps, and resistance to rolling and twisting. Moment M: torque -r_1 M on body 1, -r_2 M on
// body 2; twist T: -T n on body 1, T n on body 2.
//
//   holding   Coulomb's law of rotation: M = most w/|w| while w = r_1 omega_1 + r_2 omega_2, across
//             the normal, is not 0; else what keeps it at 0
//   spring    f = k x + g v, not above its limit, where x is set back to (f - g v)/k; f returns along
//             the mean of the old and the new one. Where a contact begins f jumps to g v, or to
//             the limit if that jumps as well
//
// Holding needs the torque of all other contacts, which is known of the last step:
//   * if it was steady, the flow w' = T - most w/|w| is followed through the step, exactly where w
//     comes to rest or goes through 0;
//   * what is at rest, and where the torque of others jumped, M changes by a share of what would
//     stop the rotation within the step: others do the same.

#ifndef TALUS_TEST_SECOND_ORDER_PARTS_H
#define TALUS_TEST_SECOND_ORDER_PARTS_H

#include "reference_vector.h"

#include <algorithm>
#include <cmath>

namespace second_order {

using namespace reference;

using Vec = Triple<double>;

inline Vec unit(Vec a)
{
  const double l = norm(a);
  return l > 0.0 ? (1.0 / l) * a : Vec{};
}
inline Vec across(Vec a, Vec n)
{
  return a - inner(a, n) * n;
}
/// a in the plane normal to n, with its length.
inline Vec turned(Vec a, Vec n)
{
  return norm(a) * unit(across(a, n));
}
/// a by the rotation from one normal to n, which is half way at n - q; to second order in q.
inline Vec rotated(Vec a, Vec n, Vec q)
{
  return a + inner(a, n) * (q - n);
}
inline Vec no_longer(Vec a, double most)
{
  return norm(a) > most ? most * unit(a) : a;
}

/// Hurwitz' zeta(-p, t), p >= 0, t > 0: Euler-Maclaurin behind the first terms of the sum.
inline double zeta(double p, double t)
{
  constexpr int terms = 12;
  double sum = 0.0;
  for (int k = 0; k < terms; k++) sum += std::pow(t + k, p);
  const double a = t + terms;
  return sum - std::pow(a, p + 1.0) / (p + 1.0) + 0.5 * std::pow(a, p) -
         p * std::pow(a, p - 1.0) / 12.0 +
         p * (p - 1.0) * (p - 2.0) * std::pow(a, p - 3.0) / 720.0 -
         p * (p - 1.0) * (p - 2.0) * (p - 3.0) * (p - 4.0) * std::pow(a, p - 5.0) / 30240.0;
}

/// Next terms in push = A dt^(p+1)/(m v), in parts of push A dt^p, for p = 1 (from the invariant
/// v_(n+1/2)^2 + k/m d_n d_(n+1)) and 3/2 (found by trial).
inline double second_at_begin(double p, double t)
{
  if (p == 1.0) return t * t / 12.0 - t * t * t * t / 8.0;
  return 0.000834058 + t * (-0.0195192 + t * (-0.000165652 +
                                              t * (0.0916618 + t * (0.000220944 - t * 0.0801479))));
}
inline double second_at_end(double p, double t)
{
  if (p == 1.0)
    return (1.0 - 6.0 * t - 12.0 * t * t + 36.0 * t * t * t - 18.0 * t * t * t * t) / 144.0;
  return 0.000166992 +
         t * (0.0303978 + t * (-0.0539675 + t * (-0.0992979 + t * (0.2033 - t * 0.0804567))));
}

struct Resistance {
  double mu_r = 0.0, mu_s = 0.0;                           // holding
  double k_roll = 0.0, gamma_roll = 0.0, mu_roll = 0.0;    // spring

  bool any() const { return mu_r > 0.0 || mu_s > 0.0 || mu_roll > 0.0; }
};

enum class Damping { MASS, RADIUS, ROOT };    // m g; a m g; g sqrt(m dF/dd)

struct Law {
  bool hertz = false;
  Damping damping = Damping::MASS;
  double kn = 0.0, gn = 0.0, kt = 0.0, gt = 0.0, mu = 0.0;    // tangential spring with slider
  double adhesion = 0.0;
  Resistance resistance;

  double elastic_exponent() const { return hertz ? 1.5 : 1.0; }
  /// Of the coefficients of damping.
  double damping_exponent() const
  {
    if (!hertz || damping == Damping::MASS) return 0.0;
    return damping == Damping::RADIUS ? 0.5 : 0.25;
  }
};

/// Normal laws with adhesion of their own, damping in proportion to the contact radius, and a
/// tangential dashpot:
///   dmt  F = 4/3 E sqrt(R) d^(3/2) - 4 pi gamma R while d > 0
///   jkr  d = a^2/R - 2 sqrt(pi gamma a/E), F = 4/3 E a^3/R - 4 a^(3/2) sqrt(pi gamma E), from d = 0
///        on, where F = -8/9 F_p, until F = -F_p = -3 pi gamma R with dF/dd = 0 (Johnson, Kendall
///        and Roberts 1971, Proc. R. Soc. A 324, 301; loads are given, not displacements)
///   friction -xt g u, limited by mu (F + 2 F_p), F without damping; lever arms end in the middle of
///        the overlap of two spheres
struct AdhesiveLaw {
  bool detaches = false;    // jkr
  double young = 0.0, gamma = 0.0, damping = 0.0, xt = 0.0, mu = 0.0;

  double pulloff_force(double R) const { return (detaches ? 3.0 : 4.0) * M_PI * gamma * R; }
  /// How far a contact lasts beyond d = 0.
  double pulloff_distance(double R) const
  {
    return detaches ? std::cbrt(3.0 * M_PI * M_PI / 16.0 * R * gamma * gamma / (young * young))
                    : 0.0;
  }
  double contact_radius(double d, double R) const
  {
    if (!detaches) return std::sqrt(R * std::max(d, 0.0));
    const auto overlap = [&](double a) {
      return a * a / R - 2.0 * std::sqrt(M_PI * gamma * a / young);
    };
    double low = std::cbrt(0.25 * M_PI * gamma * R * R / young), high = R;    // d rises from there
    for (int n = 0; n < 100; n++) {
      const double middle = 0.5 * (low + high);
      (overlap(middle) < d ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
  /// F + F_p.
  double rest(double d, double R) const
  {
    const double a = contact_radius(d, R), hertz = 4.0 / 3.0 * young * a * a * a / R;
    if (!detaches) return hertz;
    return hertz - 4.0 * std::sqrt(M_PI * gamma * young * a * a * a) + pulloff_force(R);
  }
  double rest_at_begin(double R) const { return detaches ? pulloff_force(R) / 9.0 : 0.0; }
  double dashpot(double d, double m, double R) const { return damping * m * contact_radius(d, R); }
  /// With which the elastic force, but for its jump, and damping begin.
  double elastic_exponent() const { return detaches ? 1.0 : 1.5; }
  double damping_exponent() const { return detaches ? 0.0 : 0.5; }
};

struct Particle {
  Vec x{}, v{}, w{};
  double radius = 0.5, mass = 1.0;
  Vec a{}, alpha{};    // accelerations of the last step
  Vec force{}, torque{};

  double inertia() const { return 0.4 * mass * radius * radius; }
};

inline Particle sphere(Vec x, Vec v, Vec w = {}, double radius = 0.5)
{
  Particle p;
  p.x = x;
  p.v = v;
  p.w = w;
  p.radius = radius;
  p.mass = 4.0 / 3.0 * M_PI * radius * radius * radius;
  return p;
}

struct Plane {
  Vec point, normal;
};

/// Of the last step.
struct Held {
  Vec moment{};    // that of the contact, for rolling with that of friction
  Vec others{};    // torque of others over `most`
  bool moves = true;
};

struct RememberedResistance {
  Held roll, twist;
  Vec x{};
};

struct Contact {
  bool touches = false;
  double force = 0.0;    // normal one of the last step, without the correction of its beginning
  bool slid = false;
  Vec s{};    // tangential displacement
  RememberedResistance resistance;
};

/// Stiffness and damping of a contact with overlap d.
struct Coefficients {
  double kn, gn, kt, gt;
};

inline Coefficients coefficients(const Law &law, double d, double mass, double radius)
{
  const double a = law.hertz ? std::sqrt(radius * std::max(d, 0.0)) : 1.0;
  const double kn = a * law.kn, kt = a * law.kt;
  switch (law.damping) {
  case Damping::MASS:
    return {kn, mass * law.gn, kt, mass * law.gt};
  case Damping::RADIUS:
    return {kn, a * mass * law.gn, kt, a * mass * law.gt};
  default:
    return {kn, law.gn * std::sqrt(mass * law.elastic_exponent() * kn), kt,
            law.gt * std::sqrt(mass * kt)};
  }
}

struct ResistanceInput {
  Vec n{}, half_n{}, old_n{};
  Vec rotation{}, omega{};    // r_1 omega_1 + r_2 omega_2, omega_1 - omega_2
  Vec rotation_change{},
      omega_change{};          // from the time of the velocities to that of the positions
  Vec moment{};                // of friction
  double pure, force, jump;    // normal force, with its correction, where the contact began
  double share;                // of a dashpot of exponent 0 in the first step
  double dt, lasted, lag, inverse_mass, inverse_inertia, radius, intersection_radius;
  bool touches;    // did so a step ago
};

struct Resisting {
  Vec moment{}, torque{};    // torque: of springs, on body 1
  double twist = 0.0;
};

/// Impulse of Coulomb's law in a step, over dt/inertia as w: w' = free - most w/|w|.
struct Flow {
  Vec impulse;
  bool stops = false;
};

inline Flow flow_of(Vec w, Vec free, double most)
{
  const Vec u = unit(w), rate = free - most * u;
  const double squared = inner(rate, rate);
  const double until = squared > 0.0 ? -inner(w, rate) / squared : 0.0;
  if (norm(w) > 0.0 && (until <= 0.0 || until >= 1.0)) return {most * unit(w + 0.5 * rate)};
  const Vec left = w + until * rate + (1.0 - until) * free;
  if (norm(left) <= most * (1.0 - until)) return {w + free, true};
  return {until * most * u + (1.0 - until) * most * unit(left)};
}

/// All in units of w. `own`: moment a step ago; `given`: what friction has of the moment now.
inline Vec holding(Vec w, Vec change, Vec own, Vec given, double most, Held &kept)
{
  constexpr double share = 0.15, jump = 0.2;
  const Vec others = 2.0 * change + own;
  Vec ratio{};
  for (int d = 0; d < 3 && most > 0.0; d++) ratio[d] = std::clamp(others[d] / most, -16.0, 16.0);
  const bool steady = norm(ratio - kept.others) <= jump, moved = kept.moves;
  kept.others = ratio;
  if (steady) {
    const Flow flow = flow_of(w, others - given, most);
    kept.moves = !flow.stops;
    if (moved || kept.moves) return no_longer(flow.impulse, most);
  }
  const Vec before = own - given, held = before + share * (w + 2.0 * change);
  kept.moves = norm(held) > most;
  return kept.moves ? most * unit(before + share * (w + change)) : held;
}

/// Force of spring, dashpot and slider, which is against the rotation. v: velocity now, change: to
/// there from v(n-1/2); old_v: a step ago.
inline Vec spring(const Resistance &law, const ResistanceInput &in, Vec before, Vec slip, Vec v,
                  Vec change, Vec old_v, Vec &x)
{
  const double k = law.k_roll, g = law.gamma_roll, most = law.mu_roll * in.pure;
  const double now = law.mu_roll * in.force;
  x = before + slip;
  if (!in.touches && in.lag > 0.0) {
    const Vec v_0 = v - (2.0 * in.lasted / in.dt) * change;
    const double jump = law.mu_roll * in.jump;
    if (k > 0.0) x = slip + (1.0 / k) * (no_longer(g * v_0, jump) - g * v_0);
    const Vec f = k * x + g * v;
    if (norm(f) > most) return now * unit(f);
    return no_longer(f + (in.share - 1.0) * no_longer(g * v, jump), now);
  }
  const Vec f = k * x + g * v;
  if (norm(f) <= most) return no_longer(f, now);
  Vec end = most * unit(f);
  const Vec old = k * before + g * old_v;
  const double c = inner(f, f) - most * most, b = inner(f, old) + most * most;
  const double root = b * b - (inner(old, old) - most * most) * c;
  if (root >= 0.0 && b + std::sqrt(root) > 0.0)
    end = most * unit(f - (c / (b + std::sqrt(root))) * old);
  if (k > 0.0) x = (1.0 / k) * (end - g * v);
  return now * unit(end);
}

/// About the normal: most w_n/|w|, |w| with what is across the normal. Held like rolling unless that
/// makes the law smooth.
inline double twisting(const Resistance &law, const ResistanceInput &in, RememberedResistance &kept)
{
  const double turn = in.dt * in.inverse_inertia,
               most = law.mu_s * in.intersection_radius * in.force;
  const Vec now = in.omega + in.omega_change;
  const double speed = norm(now), along = inner(now, in.n);
  const double aside = norm(across(now, in.n)), reach = turn * most;
  const double high = std::max(std::fabs(along), reach);
  const double limit = high > 0.0 ? reach * high / std::hypot(high, aside) : 0.0;
  const Vec own{in.touches ? turn * kept.twist.moment[0] : 0.0, 0.0, 0.0};
  Vec moment =
      (1.0 / turn) * holding({inner(in.omega, in.n), 0.0, 0.0},
                             {inner(in.omega_change, in.n), 0.0, 0.0}, own, {}, limit, kept.twist);
  if (aside > 4.0 * reach) {
    moment[0] = speed > 0.0 ? most * along / speed : 0.0;
    kept.twist.moves = true;
  }
  kept.twist.moment = moment;
  return moment[0];
}

inline Resisting resist(const Resistance &law, const ResistanceInput &in,
                        RememberedResistance &kept)
{
  Resisting result;
  const double turns = 2.5 * in.dt * in.inverse_mass;
  if (!in.touches) kept = RememberedResistance{};
  if (law.mu_r > 0.0) {
    const Vec own = turns * turned(kept.roll.moment, in.n);
    result.moment =
        (1.0 / turns) * holding(across(in.rotation, in.n), across(in.rotation_change, in.n), own,
                                turns * in.moment, turns * law.mu_r * in.force, kept.roll);
    kept.roll.moment = result.moment + in.moment;
  }
  if (law.mu_s > 0.0) result.twist = twisting(law, in, kept);
  if (law.mu_roll > 0.0) {
    const auto velocity = [&in](Vec omega, Vec n) { return in.radius * outer(omega, n); };
    const double time = in.lag > 0.0 ? in.lasted : 0.0;
    const Vec slip = time * turned(velocity(in.omega, in.half_n), in.n);
    const Vec v_change = velocity(in.omega_change, in.n);
    const Vec v = velocity(in.omega, in.n) + v_change;
    const Vec old_v = turned(velocity(in.omega - in.omega_change, in.old_n), in.n);
    const Vec f = spring(law, in, turned(kept.x, in.n), slip, v, v_change, old_v, kept.x);
    result.torque = -in.radius * outer(in.n, f);
  }
  return result;
}

}    // namespace second_order

#endif
