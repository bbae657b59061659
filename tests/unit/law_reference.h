// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The slow reference of all contact laws: one contact of two bodies, from what the user types to
// forces and torques, in plain scalar code and in the long double of the machine. Written from the
// equations of the reference method, in its conventions (normal from body 1 to body 2, force on
// body 2, v_r = v_2 - v_1), sharing no line with src. The scales are sums of the magnitudes of all
// terms of a result, with the factors by which the operations that follow enlarge an error: a small
// difference of large terms cannot be better than these.

#ifndef TALUS_TEST_LAW_REFERENCE_H
#define TALUS_TEST_LAW_REFERENCE_H

#include "material/contact_spec.h"
#include "named_law.h"
#include "reference_vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace reference {

using Number = long double;
using Vector = Triple<Number>;
using named::Adhesion;
using named::NamedLaw;
using named::Normal;
using named::Tangential;

inline const Number pi = std::acos(Number(-1));
inline constexpr double epsilon = std::numeric_limits<double>::epsilon();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Composite material of a contact.
struct Composite {
  Number young = 0, shear = 0, restitution = 1;
  Number kn = 0, gn = 0, kt = 0, gt = 0;
  bool kt_given = false, gt_given = false;    // of material laws
  bool limited = false;
  Number damping = 0, damping_flores = 0;    // damping ratios
  Number speed = 0, mu = 0, mu_roll = 0, mu_twist = 0;
  Number adhesion = 0, dmt = 0, perko = 0, slip_min = 0, roll_min = 0, twist_min = 0;
};

/// ln(1/e) of a linear contact of damping ratio z that ends when its force vanishes (Schwager and Poeschel 2007).
inline Number limited_decay(Number z)
{
  if (z < 1) {
    const Number s = std::sqrt(1 - z * z);
    return z / s * std::atan2(2 * z * s, 2 * z * z - 1);
  }
  const Number s = std::sqrt(z * z - 1);
  return s > 0 ? z / s * std::log((z + s) / (z - s)) : Number(2);
}

/// |beta|: the ratio of damping to critical damping that gives the restitution e.
inline Number damping_ratio(Number e, bool limited)
{
  if (!limited) {
    const Number l = std::log(std::max(e, Number(epsilon)));
    return -l / std::sqrt(l * l + pi * pi);
  }
  const Number decay = -std::log(std::max(e, Number(0.01)));
  Number low = 0, high = 6;
  for (int n = 0; n < 90; n++) {
    const Number middle = (low + high) / 2;
    (limited_decay(middle) < decay ? low : high) = middle;
  }
  return low;
}

inline Composite compose(const Talus::ContactSpec &a, const Talus::ContactSpec &b,
                         Talus::FrictionMix rule)
{
  const auto mean = [](Number p, Number q) { return (p + q) / 2; };
  const auto friction = [=](Number p, Number q) {
    if (rule == Talus::FrictionMix::ARITHMETIC) return mean(p, q);
    return rule == Talus::FrictionMix::GEOMETRIC ? std::sqrt(p * q) : std::min(p, q);
  };
  const auto &p = a.given, &q = b.given;
  const auto both = [&](const char *name) { return p.has(name) && q.has(name); };
  const auto mean_of = [&](const char *name) { return mean(p.value(name), q.value(name)); };
  const auto smaller = [&](const char *name) { return std::min(p.value(name), q.value(name)); };
  const auto larger = [&](const char *name) { return std::max(p.value(name), q.value(name)); };
  const auto rubbing = [&](const char *name) { return friction(p.value(name), q.value(name)); };
  Composite c;
  c.limited = p.has("limit_damping") || q.has("limit_damping");
  if (p.has("E")) {
    const Number ya = p.value("E"), yb = q.value("E"), na = p.value("nu"), nb = q.value("nu");
    c.young = ya * yb / (yb * (1 - na * na) + ya * (1 - nb * nb));
    c.shear = ya * yb / (2 * yb * (2 - na) * (1 + na) + 2 * ya * (2 - nb) * (1 + nb));
    const Number e = c.restitution = smaller("e");
    const bool clipped = a.law.normal().name == std::string("hooke/material") && !c.limited;
    c.damping = damping_ratio(clipped ? std::min(e, Number(1.0 - epsilon)) : e, c.limited);
    c.damping_flores = damping_ratio(std::clamp(e, Number(0.01), Number(1.0 - epsilon)), false);
    c.kt_given = both("kt");
    c.gt_given = both("gt");
    c.kt = mean_of("kt");
    c.gt = mean_of("gt");
  } else {
    const auto kt = [](const auto &s) {
      return s.has("kt") ? Number(s.value("kt")) : Number(2) / 7 * s.value("kn");
    };
    const auto gt = [](const auto &s) {
      return s.has("gt") ? Number(s.value("gt")) : Number(s.value("gn")) / 2;
    };
    c.kn = mean_of("kn");
    c.gn = mean_of("gn");
    c.kt = mean(kt(p), kt(q));
    c.gt = mean(gt(p), gt(q));
  }
  c.mu = rubbing("mu");
  c.mu_roll = rubbing("mu_r");
  c.mu_twist = rubbing("mu_s");
  c.adhesion = smaller("adhesive force");
  c.dmt = smaller("adhesion W");
  c.perko = smaller("adhesion S");
  c.speed = larger("vchar");
  c.slip_min = larger("slip_min");
  c.roll_min = larger("roll_min");
  c.twist_min = larger("twist_min");
  return c;
}

struct Stiffness {
  Number kn, gn, kt, gt;
};

inline Stiffness stiffness(Normal law, const Composite &c, Number overlap, Number mass,
                           Number radius, Number speed)
{
  const Number disc = std::sqrt(radius * overlap), root = std::sqrt(overlap);
  const Number sn = 2 * c.young * disc, st = c.kt_given ? c.kt * disc : 8 * c.shear * disc;
  const Number hertz = 2 * std::sqrt(Number(5) / 6) * c.damping;
  switch (law) {
  case Normal::HOOKE:
    return {c.kn, mass * c.gn, c.kt, mass * c.gt};
  case Normal::HERTZ:
    return {disc * c.kn, disc * mass * c.gn, disc * c.kt, disc * mass * c.gt};
  case Normal::FLORES:
    return {disc * c.kn, disc * mass * c.gn * overlap, disc * c.kt, disc * mass * c.gt};
  case Normal::PLAINCOULOMB:
    return {c.kn * root, c.gn * root, 0, 0};
  case Normal::HOOKE_MATERIAL: {
    const Number scale = Number(16) / 15 * std::sqrt(radius) * c.young;
    const Number kn = scale * std::pow(mass * speed * speed / scale, Number(1) / 5);
    const Number gn = 2 * c.damping * std::sqrt(mass * kn);
    return {kn, gn, kn, c.gt_given ? c.gt * std::sqrt(mass * kn) : gn};
  }
  case Normal::HERTZ_MATERIAL:
    return {2 * sn / 3, hertz * std::sqrt(sn * mass), st,
            (c.gt_given ? c.gt : hertz) * std::sqrt(st * mass)};
  case Normal::FLORES_MATERIAL: {
    const Number e = std::clamp(c.restitution, Number(0.01), Number(1.0 - epsilon));
    const Number shear =
        c.kt_given ? c.kt * disc * 3 / 2 : st;    // the number given is the stiffness
    const Number h = 2 * std::sqrt(Number(5) / 6) * c.damping_flores;
    return {2 * sn / 3, 8 * (1 - e) * (2 * sn / 3) * overlap / (5 * e * speed), 2 * shear / 3,
            (c.gt_given ? c.gt : h) * std::sqrt(shear * mass)};
  }
  default: {
    const Number plain = 2 * c.young * root;
    return {2 * plain / 3, hertz * std::sqrt(plain * mass), 0, 0};
  }
  }
}

/// Two bodies in contact, [0] is body 1 of the reference. Infinite masses are allowed; a body of
/// infinite radius does not spin.
struct Contact {
  Vector normal{};    ///< from body 1 to body 2; zero if the centers coincide
  Number overlap = 0;
  std::array<Number, 2> radius{1, 1}, mass{1, 1};
  std::array<Vector, 2> velocity{}, omega{};
  Vector history{};    ///< displacement of body 2 relative to body 1
  bool sliding = false, begun = false;
  Number impact_speed = 0, age = 0;
};

struct Outcome {
  Vector force{};    ///< on body 1
  std::array<Vector, 2> torque{};
  Vector history{};
  bool sliding = false, begun = false;
  Number impact_speed = 0, age = 0;

  Number force_scale = 0, history_scale = 0, speed_scale = 0;
  std::array<Number, 2> torque_scale{};
  bool clear_case =
      true;    ///< false if rounding decides on which side of a threshold the contact is
  // what happened
  Number normal_force = 0;
  bool slides = false, sticks = false, rolls = false, rotation = false, delayed = false;
};

inline Number reduced(Number a, Number b)
{
  if (std::isinf(a) && std::isinf(b)) return 0;
  if (std::isinf(a)) return b;
  return std::isinf(b) ? a : a * b / (a + b);
}

/// Radius of the circle of intersection of two spheres: height of the triangle of the radii and the distance, by Heron.
inline Number intersection_radius(Number a, Number b, Number overlap)
{
  const Number d = a + b - overlap, s = a + b - overlap / 2;
  const Number square = s * (overlap / 2) * (b - overlap / 2) * (a - overlap / 2);
  return square > 0 ? 2 * std::sqrt(square) / d : Number(0);
}

/// 0 before one collision time of an under-damped contact, else 1.
inline Number delay(Normal law, const Stiffness &s, Number overlap, Number mass, Number age,
                    bool &clear)
{
  Number k = s.kn, g = s.gn;
  if (law != Normal::HOOKE && law != Normal::HOOKE_MATERIAL) {
    const bool flores = law == Normal::FLORES || law == Normal::FLORES_MATERIAL;
    k /= std::sqrt(overlap);
    g /= std::pow(overlap, flores ? Number(1.5) : Number(0.25));
  }
  const Number d = g / (2 * mass * std::sqrt(k / mass));
  if (std::isnan(d)) return 1;    // no overlap or no mass: no force either
  if (std::fabs(d - 1) < 1e-13) clear = false;
  if (d >= 1) return 1;
  const Number duration = pi * std::sqrt(mass / (k * (1 - d * d)));
  if (std::fabs(age - duration) < 1e-13 / (1 - d * d) * duration) clear = false;
  return age <= duration ? 0 : 1;
}

/// d turned into the plane normal to n, with its length; enlarges its scale if it is almost along n.
inline Vector turned(const Vector &d, const Vector &n, Number &scale)
{
  const Vector flat = d - inner(d, n) * n;
  if (!(norm(flat) > 0)) return {};
  scale *= norm(d) / norm(flat);
  return (norm(d) / norm(flat)) * flat;
}

/// Displacement of body 2 against body 1 in the step that led here, along the surface half way through it.
struct Step {
  Vector displacement;
  Number scale, lasted;
};

inline Step step_half_way(const Contact &c, Number v_n, Number dt)
{
  const Number distance = c.radius[0] + c.radius[1] - c.overlap;
  const Vector v = c.velocity[1] - c.velocity[0];
  Vector n = distance * c.normal - (norm(c.normal) > 0 ? dt / 2 : Number(0)) * v;
  const Number length = norm(n);
  const Number enlarged = length > 0 ? 1 + (distance + dt * norm(v)) / length : Number(1);
  n = (length > 0 ? 1 / length : Number(0)) * n;
  const Vector surface =
      v - outer(c.omega[1], c.radius[1] * n) - outer(c.omega[0], c.radius[0] * n);
  // a contact that began on the way lasted overlap/|v_n|
  const Number lasted = -v_n * dt > c.overlap ? c.overlap / -v_n : dt;
  const Number centers = norm(c.velocity[0]) + norm(c.velocity[1]);
  const Number speeds = centers + c.radius[0] * norm(c.omega[0]) + c.radius[1] * norm(c.omega[1]);
  const Number uncertain = lasted < dt ? 1 + centers / std::fabs(v_n) : Number(1);
  return {lasted * (surface - inner(surface, n) * n), lasted * speeds * enlarged * uncertain,
          lasted};
}

inline Outcome evaluate(const Contact &c, NamedLaw law, const Composite &p, Number dt, bool advance)
{
  Outcome out;
  const Number mass = reduced(c.mass[0], c.mass[1]), radius = reduced(c.radius[0], c.radius[1]);
  Vector arm[2], surface[2];
  Number centers = 0, turning = 0;
  for (int b = 0; b < 2; b++) {
    const Number length = std::isinf(c.radius[b]) ? Number(0) : c.radius[b];
    arm[b] = (b == 0 ? length : -length) * c.normal;
    surface[b] = c.velocity[b] + outer(c.omega[b], arm[b]);
    centers += norm(c.velocity[b]);
    turning += length * norm(c.omega[b]);
  }
  const Number speeds = centers + turning;
  const Vector relative = surface[1] - surface[0];
  const Number v_n = inner(c.velocity[1] - c.velocity[0], c.normal);
  const Vector v_t = relative - inner(relative, c.normal) * c.normal;

  out.begun = advance || c.begun;
  out.impact_speed = c.begun ? c.impact_speed : std::fabs(v_n);
  out.age = c.begun ? c.age + (advance ? dt : Number(0)) : Number(0);
  out.speed_scale = c.begun ? c.impact_speed : centers;
  const bool impact = law.has_impact();
  const Number v_c = impact ? std::max(out.impact_speed, p.speed) : p.speed;
  const Stiffness k = stiffness(law.normal, p, c.overlap, mass, radius, v_c);

  const Number normal_scale = k.kn * c.overlap + k.gn * centers;
  Number f_n = k.kn * c.overlap - k.gn * v_n;
  if (p.limited) f_n = std::max(f_n, Number(0));
  const Number limit = p.mu * std::fabs(f_n);
  out.normal_force = f_n;
  out.history = c.history;
  out.sliding = c.sliding;

  Vector f_t{};
  Number scale_t = 0;
  const auto cap = [&](Number scale) {
    const Number size = norm(f_t);
    out.slides = size > limit;
    out.sticks = !out.slides;
    if (out.slides) f_t = (limit / size) * f_t;
    scale_t = scale + p.mu * normal_scale;
  };
  if (law.tangential == Tangential::DASHPOT) {
    f_t = k.gt * v_t;
    cap(k.gt * speeds);
  } else if (law.tangential == Tangential::ONESTEP) {
    f_t = (k.kt * dt) * v_t + k.gt * v_t;
    cap((k.kt * dt + k.gt) * speeds);
  } else if (law.tangential == Tangential::TANH) {
    const Number slip = norm(v_t);
    if (slip > 0 && std::fabs(slip - p.slip_min) < 1e-13 * speeds) out.clear_case = false;
    out.slides = slip > 0 && slip >= p.slip_min;
    out.sticks = !out.slides;
    if (out.slides) f_t = (p.mu * std::tanh(5 * slip) * f_n / slip) * v_t;
    scale_t = p.mu * normal_scale +
              limit * (slip > 0 ? std::min(Number(5), 1 / slip) : Number(5)) * speeds;
  } else if (law.has_history()) {
    Vector s = c.history;
    Number reach = norm(c.history);
    bool moved = norm(s) > 0;
    const bool slider =
        law.tangential == Tangential::SLIDER || law.tangential == Tangential::SLIDER_MIDPOINT;
    const bool midpoint =
        law.tangential == Tangential::MIDPOINT || law.tangential == Tangential::SLIDER_MIDPOINT;
    Number lasted = dt;
    if (advance && !midpoint) {
      s = s + dt * v_t;
      moved = norm(s) > 0;
      s = s - inner(s, c.normal) * c.normal;
      reach += dt * speeds;
    } else if (advance) {
      Step step = step_half_way(c, v_n, dt);
      s = turned(s, c.normal, reach) + turned(step.displacement, c.normal, step.scale);
      moved = norm(s) > 0;
      reach = reach + step.scale;
      lasted = step.lasted;
    }
    f_t = k.kt * s + k.gt * v_t;
    const Number size = norm(f_t);
    const Number trial_scale = k.kt * reach + k.gt * speeds;
    if (std::fabs(size - limit) < 1e-13 * (trial_scale + p.mu * normal_scale))
      out.clear_case = false;
    const bool exceeds = size > limit;
    bool capped = exceeds && moved;
    out.history_scale = norm(c.history);
    if (advance) {
      out.history_scale = reach;
      if (capped && slider && k.gt > 0) {
        // gt (s - s_0)/dt + kt s = F, with s_0 from before the step
        const Vector before = s - lasted * v_t;
        const Number sum = lasted * k.kt + k.gt;
        s = (1 / sum) * ((lasted * limit / size) * f_t + k.gt * before);
        out.history_scale += lasted * (trial_scale + p.mu * normal_scale) / sum + lasted * speeds;
      } else if (capped) {
        s = (1 / k.kt) * ((limit / size) * f_t - k.gt * v_t);
        out.history_scale += (trial_scale + p.mu * normal_scale) / k.kt;
      }
      out.history = s;
      out.sliding = capped;
    }
    const bool near_limit = size + 1e-12 * (k.kt * norm(s) + k.gt * norm(v_t) + limit) >= limit;
    capped = capped || (!advance && c.sliding && near_limit);
    // a force that was at the limit stays there, along the trial force
    if (capped)
      f_t = size > 0 ? (limit / size) * f_t : Vector{};
    else if (exceeds)
      f_t = {};
    scale_t = trial_scale * (capped && size > 0 ? std::max(limit / size, Number(1)) : Number(1)) +
              p.mu * normal_scale;
    out.slides = capped;
    out.sticks = !capped;
  }

  // force on body 2 is f_n n - f_t
  const Vector on_two = f_n * c.normal - f_t;
  out.torque[0] = outer(arm[0], f_t);    // -a_1 x force; the normal force is central
  out.torque[1] = Number(-1) * outer(arm[1], f_t);
  for (int b = 0; b < 2; b++) out.torque_scale[b] = c.radius[b] * scale_t;

  if (law.resists) {
    Number acts = 1;
    if (law.delayed)
      acts = delay(law.normal, k, c.overlap, mass, impact ? out.age : Number(0), out.clear_case);
    out.delayed = acts == 0;

    const Number presses = law.delayed ? f_n : std::max(f_n, Number(0));
    const Number quarter = Number(1) / 4;    // of the rotation may be taken away in a step
    const Number turns =
        Number(5) / 2 * dt *
        ((std::isinf(c.mass[0]) ? 0 : 1 / c.mass[0]) + (std::isinf(c.mass[1]) ? 0 : 1 / c.mass[1]));
    const Vector v_rot = outer(c.omega[1], arm[1]) - outer(c.omega[0], arm[0]);
    const Number rolling = norm(v_rot);
    if (p.roll_min > 0 && std::fabs(rolling - p.roll_min) < 1e-13 * turning) out.clear_case = false;
    if (!law.delayed && rolling >= p.roll_min) {
      // torque on body b is -r_b times the moment; that of friction is n x f_t by our normal
      const Vector sum = c.radius[0] * c.omega[0] + c.radius[1] * c.omega[1];
      const Vector friction = outer(f_t, c.normal);
      const Number stop = turns > 0 ? quarter / turns : 0;
      Vector moment = stop * (sum - inner(sum, c.normal) * c.normal) - friction;
      if (!(norm(c.normal) > 0)) moment = {};
      const Number needed = norm(moment), strength = p.mu_roll * presses;
      const Number share = needed > strength ? strength / needed : Number(1);
      out.rolls = needed > 0 && strength > 0;
      for (int b = 0; b < 2; b++) {
        out.torque[b] = out.torque[b] - c.radius[b] * share * moment;
        out.torque_scale[b] +=
            c.radius[b] * (p.mu_roll * normal_scale + share * (stop * turning + scale_t));
      }
    }
    if (law.delayed && rolling > p.roll_min && acts > 0) {
      out.rolls = true;
      for (int b = 0; b < 2; b++) {
        const Vector moment = (p.mu_roll * presses / rolling) * outer(arm[b], v_rot);
        out.torque[b] = b == 0 ? out.torque[b] + moment : out.torque[b] - moment;
        out.torque_scale[b] +=
            c.radius[b] * p.mu_roll * (normal_scale + std::fabs(presses) * turning / rolling);
      }
    }
    const Vector w = c.omega[1] - c.omega[0];
    const Number spinning = norm(w), w_scale = norm(c.omega[0]) + norm(c.omega[1]);
    if (p.twist_min > 0 && std::fabs(spinning - p.twist_min) < 1e-13 * w_scale)
      out.clear_case = false;
    const bool above = law.delayed ? spinning > p.twist_min : spinning >= p.twist_min && turns > 0;
    if (above && spinning > 0 && acts > 0) {
      out.rotation = true;
      const Number strength = p.mu_twist * intersection_radius(c.radius[0], c.radius[1], c.overlap);
      Number factor = strength * presses / spinning;
      const Number bend = 1 / c.radius[0] + 1 / c.radius[1];
      if (!law.delayed) factor = std::min(factor, quarter / (turns * bend * bend));
      const Vector twisting_torque = (factor * inner(w, c.normal)) * c.normal;
      out.torque[0] = out.torque[0] + twisting_torque;
      out.torque[1] = out.torque[1] - twisting_torque;
      for (Number &scale : out.torque_scale)
        scale += strength * normal_scale + std::fabs(factor) * w_scale;
    }
  }

  Number pull = 0;
  if (law.adhesion != Adhesion::NONE)
    pull = p.adhesion + p.dmt * std::sqrt(radius) + p.perko * radius;
  out.force = Number(-1) * (on_two - pull * c.normal);
  out.force_scale = normal_scale + scale_t + pull;
  return out;
}

}    // namespace reference

#endif
