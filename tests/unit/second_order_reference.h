// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Spheres and planes by the simplest program that can be: every pair in every step, one contact at
// a time, the leapfrog of `start half`, and the five measures by which contacts that dissipate
// become of second order in the time step. The reference that the laws of the engine are compared
// with: it shares no code with them. Any consistent units.
//
//   damping   velocities at the time of the positions: v(n-1/2) + dt/2 a(n-1), the normal one with
//             the force of the contact itself implicit, (K d - G v_p)/(1 + G dt/(2 m)), v_p with
//             what others contribute to a(n-1)
//   midpoint  increment of the tangential displacement with the normal half way
//   ends      the step in which a contact begins: a force A tau^p is summed by time steps with the
//             error A dt^p zeta(-p, theta) (Hurwitz), theta = time since touching/dt
//             (Euler-Maclaurin for a sum that does not begin on a grid point). Subtracted. The same
//             for forces that end, in the first step after, and for those that do so with jumps
//   slip      a sliding contact moves along the mean of its old and its new force (generalized
//             midpoint rule: Ortiz and Popov 1985, Int. J. Numer. Meth. Eng. 21, 1561)
//   rolling   a rolling torque opposes the rotation at the time of the positions

#ifndef TALUS_TEST_SECOND_ORDER_REFERENCE_H
#define TALUS_TEST_SECOND_ORDER_REFERENCE_H

#include "second_order_parts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace second_order {

class System {
 public:
  Law law;
  std::optional<AdhesiveLaw> adhesive;    // in its place
  Vec gravity{};
  std::vector<Particle> particles;
  std::vector<Plane> planes;
  bool parted = false;    // a contact has ended

  /// From the present time on for `time` in `steps` steps; velocities at the end are those of the
  /// end.
  void run(double time, int steps)
  {
    dt = time / steps;
    contacts.assign(particles.size() * (particles.size() + planes.size()), Contact{});
    lag = 0.0;
    for (int n = 0; n < steps; n++) {
      find_forces();
      if (n == 0) contacts.assign(contacts.size(), Contact{});    // a setup stores no history
      for (Particle &p : particles) {
        p.v = p.v + (lag + 0.5 * dt) * p.a;
        p.w = p.w + (lag + 0.5 * dt) * p.alpha;
        p.x = p.x + dt * p.v;
      }
      lag = 0.5 * dt;
    }
    find_forces();
    for (Particle &p : particles) {
      p.v = p.v + lag * p.a;
      p.w = p.w + lag * p.alpha;
    }
  }

 private:
  double dt = 0.0, lag = 0.0;    // lag: time by which velocities are behind positions
  std::vector<Contact> contacts;

  struct Pair {
    Particle *i, *j;    // j: nullptr for a plane
    Vec n, v, spin, a, alpha;
    double d, distance, mass, radius, inverse_mass;
  };

  void find_forces()
  {
    for (Particle &p : particles) p.force = p.torque = Vec{};
    std::size_t place = 0;
    for (std::size_t i = 0; i < particles.size(); i++) {
      for (std::size_t j = 0; j < i; j++, place++) meet(particles[j], particles[i], place);
      for (const Plane &plane : planes) meet(particles[i], plane, place++);
    }
    for (Particle &p : particles) {
      p.a = gravity + (1.0 / p.mass) * p.force;
      p.alpha = (1.0 / p.inertia()) * p.torque;
    }
  }

  void meet(Particle &i, Particle &j, std::size_t place)
  {
    const Vec r = i.x - j.x;
    const double distance = norm(r), d = i.radius + j.radius - distance;
    if (d <= 0.0 && !contacts[place].touches) return;
    act({&i, &j, (1.0 / distance) * r, i.v - j.v, i.radius * i.w + j.radius * j.w, i.a - j.a,
         i.radius * i.alpha + j.radius * j.alpha, d, distance, i.mass * j.mass / (i.mass + j.mass),
         i.radius * j.radius / (i.radius + j.radius), 1.0 / i.mass + 1.0 / j.mass},
        contacts[place]);
  }

  void meet(Particle &i, const Plane &plane, std::size_t place)
  {
    const double distance = inner(i.x - plane.point, plane.normal), d = i.radius - distance;
    if (d <= 0.0 && !contacts[place].touches) return;
    act({&i, nullptr, plane.normal, i.v, i.radius * i.w, i.a, i.radius * i.alpha, d, distance,
         i.mass, i.radius, 1.0 / i.mass},
        contacts[place]);
  }

  void act(const Pair &p, Contact &c)
  {
    if (p.d > (adhesive ? -adhesive->pulloff_distance(p.radius) : 0.0)) {
      adhesive ? adhere(p, c) : touch(p, c);
      return;
    }
    adhesive ? detach(p, c) : separate(p, c);
    c = Contact{};
    parted = true;
  }

  void apply(const Pair &p, Vec force, Vec moment, Vec twist)
  {
    p.i->force = p.i->force + force;
    const double short_by = adhesive && p.j ? 0.5 * p.d : 0.0;
    p.i->torque = p.i->torque - (p.i->radius - short_by) * moment + twist;
    if (!p.j) return;
    p.j->force = p.j->force - force;
    p.j->torque = p.j->torque - (p.j->radius - short_by) * moment - twist;
  }

  /// The step in which bodies touch (sign -1) or part (+1): time from touching on or to parting
  /// over dt, overlap that the speed at the event adds in a step, its change in the step by
  /// others and the turning of the contact.
  struct EventStep {
    bool happens = false;
    double theta = 1.0, step_overlap = 1.0, curvature = 0.0;
  };

  static double turning_of(const Pair &p)
  {
    const double vn = inner(p.v, p.n);
    return p.j ? (inner(p.v, p.v) - vn * vn) / p.distance : 0.0;
  }

  EventStep event_step(const Pair &p, double d, double sign, double others) const
  {
    const double turning = turning_of(p);
    const double step = sign * dt * (inner(p.v, p.n) - 0.5 * dt * turning);
    if (d <= 0.0 || step < d) return {};
    const double straight = d / step;
    const double curvature = std::clamp(-dt * dt * (others + turning) / step, -1.0, 1.0);
    const double theta = straight * (1.0 - 0.5 * curvature * (1.0 - straight));
    return {true, theta, step * (1.0 + curvature * (0.5 - theta)), curvature};
  }

  /// In parts of A dt^p; `later`: from touching or parting to the correction.
  double elastic_error(const EventStep &e, double later) const
  {
    const double p = adhesive ? adhesive->elastic_exponent() : law.elastic_exponent();
    const double first = zeta(p, e.theta);
    return first + e.curvature * ((0.5 * p + 1.0) * zeta(p + 1.0, e.theta) - later * first);
  }

  /// The sum over the time steps of the force that a contact ends with, less its integral.
  void separate(const Pair &p, const Contact &c)
  {
    const double speed = inner(p.v, p.n), before = p.d + dt * (speed - 0.5 * dt * turning_of(p));
    if (before <= 0.0) return;
    const double theta = before / (before - p.d);
    const double error = c.force == 0.0 ? 0.0 : end_of_force(p, c, before, speed);
    Vec friction{};
    if (law.mu > 0.0 && c.force > 0.0) {
      const Coefficients was = coefficients(law, before, p.mass, p.radius);
      const Vec u = surface_velocity(p.v, p.spin, p.n);
      const Vec f = was.kt * rotated(c.s, p.n, half_turn(p)) + was.gt * u;
      friction =
          c.slid ? law.mu * error * unit(f) : sticks_to_the_end(p, c, f, was, u, before, speed);
    }
    const double pull = -law.adhesion * zeta(0.0, theta);
    apply(p, -(error + pull) * p.n + friction, outer(p.n, friction), Vec{});
  }

  /// The force ends where damping has made up for the elastic force.
  double end_of_force(const Pair &p, const Contact &c, double before, double speed) const
  {
    const Coefficients was = coefficients(law, before, p.mass, p.radius);
    const double rest = before - was.gn * speed / was.kn, exponent = law.elastic_exponent();
    const EventStep e = event_step(p, rest, 1.0, inner(p.a, p.n) - c.force / p.mass);
    if (!e.happens) return 0.0;
    const double most =
        (was.kn * before - was.gn * speed) * std::pow(e.step_overlap / rest, exponent);
    const double push = most * dt * dt / (p.mass * e.step_overlap);
    return most * (elastic_error(e, e.theta - 1.0) - push * second_at_end(exponent, e.theta));
  }

  /// The sum of a friction that sticks in the last step, less its integral: from there on to the
  /// end of the normal force it changes as its spring does, and follows the limit once it meets it.
  Vec sticks_to_the_end(const Pair &p, const Contact &c, Vec f, const Coefficients &was, Vec u,
                        double before, double speed) const
  {
    const double rest = before - was.gn * speed / was.kn;
    const EventStep e = event_step(p, rest, 1.0, inner(p.a, p.n) - c.force / p.mass);
    if (!e.happens) return {};
    const double limit = law.mu * c.force, falls = limit / e.theta;
    const Vec rate = dt * was.kt * u;
    const double rises = inner(unit(f), rate);
    double sticks = e.theta;
    if (falls + rises > 0.0) sticks = (limit - norm(f)) / (falls + rises);
    sticks = std::clamp(sticks, 0.0, e.theta);
    const double slides_on = e.theta - sticks;
    const Vec integral =
        sticks * f + 0.5 * sticks * sticks * rate + 0.5 * falls * slides_on * slides_on * unit(f);
    return 0.5 * f + (1.0 / 12.0) * rate - integral;
  }

  /// Damping has held the normal force at zero a step ago: since when in the step it has grown to
  /// F, in parts of it. Its rate: of elastic force, dashpot's coefficient and velocity.
  double since_return(const Pair &p, const Coefficients &now, double force) const
  {
    const double vn = inner(p.v, p.n);
    const double change = inner(p.a, p.n) + turning_of(p);
    const double growth = -law.elastic_exponent() * now.kn * vn +
                          law.damping_exponent() * now.gn / p.d * vn * vn - now.gn * change;
    return growth * dt > force ? force / (growth * dt) : 1.0;
  }

  void touch(const Pair &p, Contact &c)
  {
    const Coefficients now = coefficients(law, p.d, p.mass, p.radius);
    const double vn = inner(p.v, p.n);
    const EventStep start =
        lag > 0.0 && !c.touches ? event_step(p, p.d, -1.0, inner(p.a, p.n)) : EventStep{};
    const bool begins = start.happens;
    const double theta = start.theta, approach = start.step_overlap;
    const Coefficients most =
        begins ? coefficients(law, approach, p.mass, p.radius) : Coefficients{};

    // normal
    const double own = c.touches ? c.force / p.mass : 0.0;
    const double v_p = vn + lag * (inner(p.a, p.n) - own);
    const double pure =
        std::max((now.kn * p.d - now.gn * v_p) / (1.0 + now.gn * lag / p.mass), 0.0);
    double force = pure, pull = law.adhesion;
    if (begins) {
      const double elastic = most.kn * approach, push = elastic * dt * dt / (p.mass * approach);
      force -= elastic * (push * second_at_begin(law.elastic_exponent(), theta) +
                          elastic_error(start, theta)) -
               most.gn * vn * zeta(law.damping_exponent(), theta);
      pull *= 1.0 - zeta(0.0, theta);
    }

    // tangential
    Vec friction{};
    const bool returns = c.touches && c.force == 0.0 && pure > 0.0;
    const double share = returns ? since_return(p, now, pure) : theta;
    if (law.mu > 0.0) {
      const Vec u = surface_velocity(p.v + lag * p.a, p.spin + lag * p.alpha, p.n);
      const Vec wanted = friction_of(p, c, now, u, share, law.mu * pure);
      const double limit = law.mu * std::fabs(force);
      friction = wanted;
      if (begins)
        friction = friction + elastic_error(start, theta) * most.kt * dt * u +
                   zeta(law.damping_exponent(), theta) * most.gt * u;
      // sliding all the time: the share of the normal force
      friction = begins && c.slid ? limit * unit(wanted) : no_longer(friction, limit);
    }
    Vec moment = outer(p.n, friction), twist{};
    if (law.resistance.any()) {
      ResistanceInput in;
      in.n = in.half_n = in.old_n = p.n;
      in.rotation = p.spin;
      in.omega = p.i->w;
      in.rotation_change = lag * p.alpha;
      in.omega_change = lag * p.i->alpha;
      in.moment = moment;
      in.pure = pure;
      in.force = std::max(force, 0.0);
      in.jump = law.damping_exponent() == 0.0 ? std::max(-now.gn * vn, 0.0) : 0.0;
      in.share = begins ? 1.0 - zeta(0.0, theta) : 1.0;
      in.dt = dt;
      in.lasted = share * dt;
      in.lag = lag;
      in.inverse_mass = p.inverse_mass;
      in.inverse_inertia = 1.0 / p.i->inertia();
      in.radius = p.radius;
      in.intersection_radius = intersection_radius_of(p);
      in.touches = c.touches;
      if (p.j) {
        in.omega = in.omega - p.j->w;
        in.omega_change = in.omega_change - lag * p.j->alpha;
        in.inverse_inertia += 1.0 / p.j->inertia();
        in.half_n = unit(p.distance * p.n - 0.5 * dt * p.v);
        in.old_n = unit(p.distance * p.n - dt * p.v);
      }
      const Resisting resisting = resist(law.resistance, in, c.resistance);
      moment = moment + resisting.moment;
      twist = resisting.torque - resisting.twist * p.n;
    }
    apply(p, (force - pull) * p.n + friction, moment, twist);
    c.touches = true;
    c.force = pure;
  }

  static Vec surface_velocity(Vec v, Vec spin, Vec n) { return across(v, n) - outer(spin, n); }

  /// Half of what the normal turns in a step.
  Vec half_turn(const Pair &p) const
  {
    return p.j ? (0.5 * dt / p.distance) * across(p.v, p.n) : Vec{};
  }

  /// Advances the displacement. Spring and dashpot in parallel, both in series with a slider: the
  /// force is -f, f = kt s + gt s', |f| <= L, and the slip u - s' is along f.
  Vec friction_of(const Pair &p, Contact &c, const Coefficients &now, Vec u, double theta,
                  double limit)
  {
    const double time = lag > 0.0 ? theta * dt : 0.0;
    const Vec q = half_turn(p), before = rotated(c.s, p.n, q);
    const Vec slip =
        time * (surface_velocity(p.v, p.spin + inner(p.spin, p.n) * q, p.n) + inner(p.v, p.n) * q);
    c.s = before + slip;
    const Vec f = now.kt * c.s + now.gt * u;
    c.slid = norm(f) > limit;
    if (!c.slid) return -1.0 * f;
    const Vec end = limit * unit(f);
    if (time == 0.0) return -1.0 * end;
    // the force a step ago; of a contact that begins, that of the dashpot where it did
    const double h = c.touches ? dt : time;
    const double d0 = c.touches ? std::max(p.d + dt * inner(p.v, p.n), 0.0) : 0.0;
    const Coefficients old = coefficients(law, d0, p.mass, p.radius);
    const Coefficients mid = coefficients(law, 0.5 * (d0 + p.d), p.mass, p.radius);
    Vec g = (1.0 / now.kt) * end, rate{};
    if (c.touches) {
      const Vec u_mid = (1.0 / time) * slip, u_old = 2.0 * u_mid - u;
      const Vec f_old = no_longer(old.kt * before + old.gt * u_old, law.mu * std::fabs(c.force));
      const Vec along = unit(mid.kt * (before + 0.5 * slip) + mid.gt * u_mid);
      // g = f/kt: at its limit half way along `along`
      const Vec g_old = old.kt > 0.0 ? (1.0 / old.kt) * f_old : Vec{};
      const double most = limit / now.kt, b = inner(along, g_old);
      const double root = b * b + most * most - inner(g_old, g_old);
      if (root >= 0.0 && b + std::sqrt(root) > 0.0) g = (b + std::sqrt(root)) * along - g_old;
      if (old.gt > 0.0) rate = (1.0 / old.gt) * f_old;
    } else if (now.gt > 0.0)
      rate = std::max(-law.mu * now.gn * inner(p.v, p.n) / now.gt, 0.0) * unit(f);
    // s' = f/gt - s/tau with f/gt linear in time: second order for small h/tau, s = g for large
    if (now.gt > 0.0) rate = rate + (now.kt / now.gt) * g;
    const double t_mid = mid.gt / mid.kt;
    c.s = (1.0 / (t_mid * t_mid + t_mid * h + 0.5 * h * h)) *
          (t_mid * t_mid * (before + 0.5 * h * rate) + 0.5 * h * h * g);
    return -limit * unit(now.kt * c.s + now.gt * u);
  }

  /// touch() of a law with adhesion of its own.
  void adhere(const Pair &p, Contact &c)
  {
    const AdhesiveLaw &its = *adhesive;
    const double vn = inner(p.v, p.n), pulloff = its.pulloff_force(p.radius);
    const double rest = its.rest(p.d, p.radius), g = its.dashpot(p.d, p.mass, p.radius);
    const double own = c.touches ? c.force / p.mass : 0.0;
    const double v_p = vn + lag * (inner(p.a, p.n) - own);
    const double pure = (rest - g * v_p) / (1.0 + g * lag / p.mass);
    const EventStep e =
        lag > 0.0 && !c.touches ? event_step(p, p.d, -1.0, inner(p.a, p.n)) : EventStep{};

    const double jump = its.rest_at_begin(p.radius), ratio = e.happens ? e.step_overlap / p.d : 1.0;
    double early = 0.0, of_dashpot = 0.0, share = 1.0;
    if (e.happens) {
      const double most = (rest - jump) * std::pow(ratio, its.elastic_exponent());
      early = jump * zeta(0.0, e.theta) + most * elastic_error(e, e.theta);
      if (!its.detaches)
        early += most * most * dt * dt / (p.mass * e.step_overlap) * second_at_begin(1.5, e.theta);
      of_dashpot = std::pow(ratio, its.damping_exponent()) * zeta(its.damping_exponent(), e.theta);
      share = 1.0 - zeta(0.0, e.theta);
    }

    const Vec u = surface_velocity(p.v + lag * p.a, p.spin + lag * p.alpha, p.n);
    const Vec drag = -its.xt * g * u;
    double most = its.mu * (rest - early + share * pulloff);
    if (e.happens) most -= e.theta * grows(its.mu * (pulloff + jump), norm(drag));
    c.slid = norm(drag) > its.mu * (rest + pulloff);
    const Vec friction = c.slid ? most * unit(drag) : no_longer((1.0 - of_dashpot) * drag, most);
    apply(p, (pure - early + of_dashpot * g * vn - share * pulloff) * p.n + friction,
          outer(p.n, friction), Vec{});
    c.touches = true;
    c.force = pure;
  }

  /// separate() of a law with adhesion of its own.
  void detach(const Pair &p, const Contact &c)
  {
    const AdhesiveLaw &its = *adhesive;
    const double vn = inner(p.v, p.n), way = dt * (vn - 0.5 * dt * turning_of(p));
    const double before = p.d + way, left = before + its.pulloff_distance(p.radius);
    const EventStep e = event_step(p, left, 1.0, inner(p.a, p.n) - c.force / p.mass);
    if (!e.happens) return;
    const double g = its.dashpot(before, p.mass, p.radius);
    double elastic = 0.0;
    if (!its.detaches) {
      const double most = its.rest(before, p.radius) * std::pow(e.step_overlap / left, 1.5);
      const double push = most * dt * dt / (p.mass * e.step_overlap);
      elastic = -most * (elastic_error(e, e.theta - 1.0) - push * second_at_end(1.5, e.theta));
    }
    const double pull = (left / way - 0.5) * its.pulloff_force(p.radius);
    const double of_dashpot = std::pow(e.step_overlap / left, its.damping_exponent()) *
                              zeta(its.damping_exponent(), e.theta);
    const Vec drag = -its.xt * g * surface_velocity(p.v, p.spin, p.n);
    const double end = e.theta * grows(its.mu * its.pulloff_force(p.radius), norm(drag));
    const Vec friction =
        c.slid ? (its.mu * (elastic + pull) - end) * unit(drag) : -of_dashpot * drag;
    apply(p, (elastic + of_dashpot * g * vn - pull) * p.n + friction, outer(p.n, friction), Vec{});
  }

  /// What the integral of a dashpot's friction `drag` that grows to a limit in the first step, or
  /// falls from it in the last one, lacks of that of the limit.
  double grows(double limit, double drag) const
  {
    const double p = adhesive->damping_exponent();
    if (drag <= limit || p == 0.0) return 0.0;
    return limit * std::pow(limit / drag, 1.0 / p) * p / (1.0 + p);
  }

  static double intersection_radius_of(const Pair &p)
  {
    const double ri = p.i->radius;
    const double to_plane =
        p.j ? (p.distance * p.distance + ri * ri - p.j->radius * p.j->radius) / (2.0 * p.distance)
            : p.distance;
    return std::sqrt(std::max(ri * ri - to_plane * to_plane, 0.0));
  }
};

}    // namespace second_order

#endif
