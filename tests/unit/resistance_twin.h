// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Resistance to rolling and twisting to second order in the time step, for second_order_twin.h.
// Moment M: torque -r_1 M on body 1, -r_2 M on body 2; twist T: -T n on body 1, T n on body 2.
//
//   holding   Coulomb's law of rotation: M = most w/|w| while w = r_1 omega_1 + r_2 omega_2, across
//             the normal, is not 0; else what keeps it at 0
//   delayed   M = most w/|w| at the time of the positions, once the contact has lasted some time
//   spring    k x + g x', not above its limit, in series with a slider
//
// Holding needs the torque of all other contacts, which is known of the last step:
//   * if it was steady, the flow w' = T - most w/|w| is followed through the step, exactly where w
//     comes to rest or goes through 0;
//   * what is at rest, and where the torque of others jumped, M changes by a share of what would
//     stop the rotation within the step: others do the same.

#ifndef TALUS_TESTS_RESISTANCE_TWIN_H
#define TALUS_TESTS_RESISTANCE_TWIN_H

#include "twin_vector.h"

#include <algorithm>

namespace Twin {

struct Resistance {
  double mu_r = 0.0, mu_s = 0.0;    // holding, or delayed
  bool delayed = false;
  double delay = 0.0;
  double k_roll = 0.0, gamma_roll = 0.0, mu_roll = 0.0;       // springs
  double k_twist = 0.0, gamma_twist = 0.0, mu_twist = 0.0;    // mu_twist a length
  double share = 0.15, steady = 0.2;                          // of holding

  bool any() const { return mu_r > 0.0 || mu_s > 0.0 || mu_roll > 0.0 || mu_twist > 0.0; }
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
  double angle = 0.0, age = 0.0;
};

struct ResistanceInput {
  Vec n, half_n, old_n;
  Vec rotation, omega;                  // r_1 omega_1 + r_2 omega_2, omega_1 - omega_2
  Vec rotation_change, omega_change;    // from the time of the velocities to that of the positions
  Vec moment;                           // of friction
  double pure, old_pure, force;         // normal force, a step ago, with its correction
  double share;                         // of a dashpot of exponent 0 in the first step
  double dt, lasted, lag, inverse_mass, inverse_inertia, radius, circle;
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

/// Spring and dashpot in parallel, both in series with a slider; the force is the opposite.
inline Vec spring(double k, double g, const ResistanceInput &in, double mu, Vec before, Vec slip,
                  Vec v, Vec old_v, bool second, Vec &x)
{
  const double most = mu * in.pure, now = mu * in.force, tau = k > 0.0 ? g / k : 0.0;
  x = before + slip;
  const Vec f = k * x + g * v;
  if (length(f) <= most) return no_longer(f + (in.share - 1.0) * g * v, now);
  if (k > 0.0) {
    const Vec end = most * unit(f);
    const double dt = in.dt;
    if (second && in.touches) {
      const Vec old = (1.0 / k) * no_longer(k * before + g * old_v, mu * in.old_pure);
      const Vec along = unit(k * (before + 0.5 * slip) + (g / dt) * slip);
      const double b = dot(along, old), limit = most / k;
      const double root = b * b + limit * limit - dot(old, old);
      Vec last = (1.0 / k) * end;
      if (root >= 0.0 && b + std::sqrt(root) > 0.0) last = (b + std::sqrt(root)) * along - old;
      x = (1.0 / (tau * tau + tau * dt + 0.5 * dt * dt)) *
          (tau * tau * before + (0.5 * tau * dt) * old + (0.5 * dt * (tau + dt)) * last);
    } else if (in.lag > 0.0)
      x = (1.0 / (tau + in.lasted)) * (tau * before + (in.lasted / k) * end);
  }
  return now * unit(k * x + g * v);
}

/// About the normal: most w_n/|w|, |w| with what is across the normal. Held like rolling unless that
/// makes the law smooth.
inline double twisting(const Resistance &law, const ResistanceInput &in, RememberedResistance &kept,
                       bool second)
{
  const double turn = in.dt * in.inverse_inertia, most = law.mu_s * in.circle * in.force;
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
    const Vec v = velocity(in.omega + ahead * in.omega_change, in.n);
    const Vec old_v = turned(velocity(in.omega - in.omega_change, in.old_n), in.n);
    const Vec f = spring(law.k_roll, law.gamma_roll, in, law.mu_roll, turned(kept.x, in.n), slip, v,
                         old_v, second, kept.x);
    result.torque = -in.radius * cross(in.n, f);
  }
  if (law.mu_twist > 0.0) {
    const Vec along{dot(in.omega, in.n), 0.0, 0.0},
        its_change{dot(in.omega_change, in.n), 0.0, 0.0};
    Vec angle;
    result.twist +=
        spring(law.k_twist, law.gamma_twist, in, law.mu_twist, {kept.angle, 0.0, 0.0}, time * along,
               along + ahead * its_change, along - its_change, second, angle)
            .x;
    kept.angle = angle.x;
  }
  kept.age += in.dt;
  return result;
}

}    // namespace Twin

#endif
