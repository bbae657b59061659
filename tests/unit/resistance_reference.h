// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Resistance to rolling and twisting to second order in the time step, for
// second_order_reference.h. Moment M: torque -r_1 M on body 1, -r_2 M on body 2; twist T: -T n on
// body 1, T n on body 2.
//
//   holding   Coulomb's law of rotation: M = most w/|w| while w = r_1 omega_1 + r_2 omega_2, across
//             the normal, is not 0; else what keeps it at 0
//   delayed   M = most w/|w| at the time of the positions, once the contact has lasted some time
//   spring    f = k x + g v, not above its limit, where x is set back to (f - g v)/k; f returns along
//             the mean of the old and the new one. Where a contact begins f jumps to g v, or to
//             the limit if that jumps as well
//
// Holding needs the torque of all other contacts, which is known of the last step:
//   * if it was steady, the flow w' = T - most w/|w| is followed through the step, exactly where w
//     comes to rest or goes through 0;
//   * what is at rest, and where the torque of others jumped, M changes by a share of what would
//     stop the rotation within the step: others do the same.

#ifndef TALUS_TESTS_RESISTANCE_REFERENCE_H
#define TALUS_TESTS_RESISTANCE_REFERENCE_H

#include "reference_vector.h"

#include <algorithm>

namespace Reference {

struct Resistance {
  double mu_r = 0.0, mu_s = 0.0;    // holding, or delayed
  bool delayed = false;
  double delay = 0.0;
  double k_roll = 0.0, gamma_roll = 0.0, mu_roll = 0.0;    // spring
  double share = 0.15, steady = 0.2;                       // of holding

  bool any() const { return mu_r > 0.0 || mu_s > 0.0 || mu_roll > 0.0; }
};

/// Of the last step.
struct Held {
  Vec moment;    // that of the contact, for rolling with that of friction
  Vec others;    // torque of others over `most`
  bool moves = true;
};

struct RememberedResistance {
  Held roll, twist;
  Vec x;
  double age = 0.0;
};

struct ResistanceInput {
  Vec n, half_n, old_n;
  Vec rotation, omega;                  // r_1 omega_1 + r_2 omega_2, omega_1 - omega_2
  Vec rotation_change, omega_change;    // from the time of the velocities to that of the positions
  Vec moment;                           // of friction
  double pure, force, jump;    // normal force, with its correction, where the contact began
  double share;                // of a dashpot of exponent 0 in the first step
  double dt, lasted, lag, inverse_mass, inverse_inertia, radius, intersection_radius;
  bool touches;    // did so a step ago
};

struct Resisting {
  Vec moment, torque;    // torque: of springs, on body 1
  double twist = 0.0;
};

inline Vec no_longer(Vec a, double most)
{
  return length(a) > most ? most * unit(a) : a;
}

/// Impulse of Coulomb's law in a step, over dt/inertia as w: w' = free - most w/|w|.
struct Flow {
  Vec impulse;
  bool stops = false;
};

inline Flow flow_of(Vec w, Vec free, double most)
{
  const Vec u = unit(w), rate = free - most * u;
  const double squared = dot(rate, rate);
  const double until = squared > 0.0 ? -dot(w, rate) / squared : 0.0;
  if (length(w) > 0.0 && (until <= 0.0 || until >= 1.0)) return {most * unit(w + 0.5 * rate)};
  const Vec left = w + until * rate + (1.0 - until) * free;
  if (length(left) <= most * (1.0 - until)) return {w + free, true};
  return {until * most * u + (1.0 - until) * most * unit(left)};
}

/// All in units of w. `own`: moment a step ago; `given`: what friction has of the moment now.
inline Vec holding(const Resistance &law, Vec w, Vec change, Vec own, Vec given, double most,
                   Held &kept)
{
  const auto limited = [](double a) { return std::clamp(a, -16.0, 16.0); };
  const Vec others = 2.0 * change + own;
  Vec ratio;
  if (most > 0.0)
    ratio = {limited(others.x / most), limited(others.y / most), limited(others.z / most)};
  const bool steady = length(ratio - kept.others) <= law.steady;
  const bool moved = kept.moves;
  kept.others = ratio;
  if (steady) {
    const Flow flow = flow_of(w, others - given, most);
    kept.moves = !flow.stops;
    if (moved || kept.moves) return no_longer(flow.impulse, most);
  }
  const Vec before = own - given, held = before + law.share * (w + 2.0 * change);
  kept.moves = length(held) > most;
  return kept.moves ? most * unit(before + law.share * (w + change)) : held;
}

/// Force of spring, dashpot and slider, which is against the rotation. v: velocity now, change: to
/// there from v(n-1/2); old_v: a step ago.
inline Vec spring(const Resistance &law, const ResistanceInput &in, Vec before, Vec slip, Vec v,
                  Vec change, Vec old_v, bool second, Vec &x)
{
  const double k = law.k_roll, g = law.gamma_roll, most = law.mu_roll * in.pure;
  const double now = law.mu_roll * in.force;
  x = before + slip;
  if (second && !in.touches && in.lag > 0.0) {
    const Vec v_0 = v - (2.0 * in.lasted / in.dt) * change;
    const double jump = law.mu_roll * in.jump;
    if (k > 0.0) x = slip + (1.0 / k) * (no_longer(g * v_0, jump) - g * v_0);
    const Vec f = k * x + g * v;
    if (length(f) > most) return now * unit(f);
    return no_longer(f + (in.share - 1.0) * no_longer(g * v, jump), now);
  }
  const Vec f = k * x + g * v;
  if (length(f) <= most) return no_longer(f, now);
  Vec end = most * unit(f);
  if (second) {
    const Vec old = k * before + g * old_v;
    const double c = dot(f, f) - most * most, b = dot(f, old) + most * most;
    const double root = b * b - (dot(old, old) - most * most) * c;
    if (root >= 0.0 && b + std::sqrt(root) > 0.0)
      end = most * unit(f - (c / (b + std::sqrt(root))) * old);
  }
  if (k > 0.0) x = (1.0 / k) * (end - g * v);
  return now * unit(end);
}

/// About the normal: most w_n/|w|, |w| with what is across the normal. Held like rolling unless that
/// makes the law smooth.
inline double twisting(const Resistance &law, const ResistanceInput &in, RememberedResistance &kept,
                       bool second)
{
  const double turn = in.dt * in.inverse_inertia,
               most = law.mu_s * in.intersection_radius * in.force;
  const Vec now = in.omega + (second ? 1.0 : 0.0) * in.omega_change;
  const double w = dot(in.omega, in.n), speed = length(now), along = dot(now, in.n);
  const double smooth = speed > 0.0 ? most * along / speed : 0.0;
  if (law.delayed) return kept.age >= law.delay ? smooth : 0.0;
  if (!second) return std::copysign(std::min(std::fabs(smooth), 0.25 * std::fabs(w) / turn), w);
  const double aside = length(across(now, in.n)), reach = turn * most;
  const double high = std::max(std::fabs(along), reach);
  const double limit = high > 0.0 ? reach * high / std::hypot(high, aside) : 0.0;
  const Vec own{in.touches ? turn * kept.twist.moment.x : 0.0, 0.0, 0.0};
  Vec moment = (1.0 / turn) * holding(law, {w, 0.0, 0.0}, {dot(in.omega_change, in.n), 0.0, 0.0},
                                      own, {}, limit, kept.twist);
  if (aside > 4.0 * reach) {
    moment.x = smooth;
    kept.twist.moves = true;
  }
  kept.twist.moment = moment;
  return moment.x;
}

inline Resisting resist(const Resistance &law, const ResistanceInput &in,
                        RememberedResistance &kept, bool second)
{
  Resisting result;
  const double turns = 2.5 * in.dt * in.inverse_mass;
  const Vec w = across(in.rotation, in.n);
  const Vec change = second ? across(in.rotation_change, in.n) : Vec{};
  if (!in.touches) kept = RememberedResistance{};
  if (law.mu_r > 0.0) {
    const double most = law.mu_r * in.force;
    if (law.delayed)
      result.moment = kept.age >= law.delay ? most * unit(w + change) : Vec{};
    else if (second) {
      const Vec own = turns * turned(kept.roll.moment, in.n);
      result.moment =
          (1.0 / turns) * holding(law, w, change, own, turns * in.moment, turns * most, kept.roll);
      kept.roll.moment = result.moment + in.moment;
    } else
      result.moment = no_longer((0.25 / turns) * w - in.moment, most);
  }
  if (law.mu_s > 0.0) result.twist = twisting(law, in, kept, second);
  const double time = in.lag > 0.0 ? in.lasted : 0.0, ahead = second ? 1.0 : 0.0;
  if (law.mu_roll > 0.0) {
    const auto velocity = [&in](Vec omega, Vec n) { return in.radius * cross(omega, n); };
    const Vec slip = time * turned(velocity(in.omega, in.half_n), in.n);
    const Vec v_change = ahead * velocity(in.omega_change, in.n);
    const Vec v = velocity(in.omega, in.n) + v_change;
    const Vec old_v = turned(velocity(in.omega - in.omega_change, in.old_n), in.n);
    const Vec f = spring(law, in, turned(kept.x, in.n), slip, v, v_change, old_v, second, kept.x);
    result.torque = -in.radius * cross(in.n, f);
  }
  kept.age += in.dt;
  return result;
}

}    // namespace Reference

#endif
