// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Spheres and planes by the simplest program that can be: every pair in every step, one contact at
// a time, the leapfrog of `start half`, and the five measures by which contacts that dissipate
// become of second order in the time step, each of which can be left out. The reference that the
// laws of the engine are compared with: it shares no code with them. Any consistent units.
//
//   damping   velocities at the time of the positions: v(n-1/2) + dt/2 a(n-1), the normal one with
//             the force of the contact itself implicit, (K d - G v_p)/(1 + G dt/(2 m)), v_p with
//             what others contribute to a(n-1)
//   midpoint  increment of the tangential displacement with the normal half way
//   ends      the step in which a contact begins: a force A tau^p is summed by time steps with the
//             error A dt^p zeta(-p, theta) (Hurwitz), theta = time since touching/dt
//             (Euler-Maclaurin for a sum that does not begin on a grid point). Subtracted. The same
//             for forces that end, in the first step after
//   slip      a sliding contact moves along the mean of its old and its new force (generalized
//             midpoint rule: Ortiz and Popov 1985, Int. J. Numer. Meth. Eng. 21, 1561)
//   rolling   a rolling torque opposes the rotation at the time of the positions

#ifndef TALUS_TESTS_SECOND_ORDER_REFERENCE_H
#define TALUS_TESTS_SECOND_ORDER_REFERENCE_H

#include "second_order_reference_law.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Reference {

class System {
 public:
  Law law;
  Measures with;
  Vec gravity{};
  std::vector<Particle> particles;
  std::vector<Plane> planes;

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
    const double distance = length(r), d = i.radius + j.radius - distance;
    if (d <= 0.0 && !contacts[place].touches) return;
    act({&i, &j, (1.0 / distance) * r, i.v - j.v, i.radius * i.w + j.radius * j.w, i.a - j.a,
         i.radius * i.alpha + j.radius * j.alpha, d, distance, i.mass * j.mass / (i.mass + j.mass),
         i.radius * j.radius / (i.radius + j.radius), 1.0 / i.mass + 1.0 / j.mass},
        contacts[place]);
  }

  void meet(Particle &i, const Plane &plane, std::size_t place)
  {
    const double distance = dot(i.x - plane.point, plane.normal), d = i.radius - distance;
    if (d <= 0.0 && !contacts[place].touches) return;
    act({&i, nullptr, plane.normal, i.v, i.radius * i.w, i.a, i.radius * i.alpha, d, distance,
         i.mass, i.radius, 1.0 / i.mass},
        contacts[place]);
  }

  void act(const Pair &p, Contact &c)
  {
    if (p.d > 0.0)
      touch(p, c);
    else
      separate(p, c);
  }

  void apply(const Pair &p, Vec force, Vec moment, Vec twist)
  {
    p.i->force = p.i->force + force;
    p.i->torque = p.i->torque - p.i->radius * moment + twist;
    if (!p.j) return;
    p.j->force = p.j->force - force;
    p.j->torque = p.j->torque - p.j->radius * moment - twist;
  }

  /// The step in which bodies touch (sign -1) or part (+1): time from touching on or to parting
  /// over dt, overlap that the speed at the event adds in a step, its change in the step by
  /// others and the turning of the contact.
  struct EventStep {
    bool happens = false;
    double theta = 1.0, step_overlap = 1.0, curvature = 0.0;
  };

  EventStep event_step(const Pair &p, double d, double sign, double others) const
  {
    const double vn = dot(p.v, p.n);
    const double turning = p.j ? (dot(p.v, p.v) - vn * vn) / p.distance : 0.0;
    const double step = sign * dt * (vn - 0.5 * dt * turning);
    if (d <= 0.0 || step < d) return {};
    const double straight = d / step;
    const double curvature = std::clamp(-dt * dt * (others + turning) / step, -1.0, 1.0);
    const double theta = straight * (1.0 - 0.5 * curvature * (1.0 - straight));
    return {true, theta, step * (1.0 + curvature * (0.5 - theta)), curvature};
  }

  /// In parts of A dt^p; `later`: from touching or parting to the correction.
  double elastic_error(const EventStep &e, double later) const
  {
    const double p = law.elastic_exponent(), first = zeta(p, e.theta);
    return first + e.curvature * ((0.5 * p + 1.0) * zeta(p + 1.0, e.theta) - later * first);
  }

  /// The sum over the time steps of the force that a contact ends with, less its integral.
  void separate(const Pair &p, Contact &c)
  {
    const double speed = dot(p.v, p.n);
    const double turning = p.j ? (dot(p.v, p.v) - speed * speed) / p.distance : 0.0;
    const double before = p.d + dt * (speed - 0.5 * dt * turning);
    if (with.ends && with.after && before > 0.0) {
      const double theta = before / (before - p.d);
      const double error = c.force == 0.0      ? 0.0
                           : law.limit_damping ? limited_end(p, c, before, speed)
                                               : unlimited_end(p, theta, speed);
      Vec friction{};
      if (law.mu > 0.0 && c.force > 0.0) {
        const Coefficients was = coefficients(law, before, p.mass, p.radius);
        const Vec u = surface_velocity(p.v, p.spin, p.n);
        const Vec f = was.kt * rotated(c.s, p.n, half_turn(p)) + was.gt * u;
        if (c.slid)
          friction = law.mu * error * unit(f);
        else if (with.slip)
          friction = sticks_to_the_end(p, c, f, was, u, before, speed);
      }
      const double pull = -law.adhesion * zeta(0.0, theta);
      apply(p, -(error + pull) * p.n + friction, cross(p.n, friction), Vec{});
    }
    c = Contact{};
  }

  double unlimited_end(const Pair &p, double theta, double speed) const
  {
    const double reach = speed * dt;
    const Coefficients most = coefficients(law, reach, p.mass, p.radius);
    const double push = most.kn * reach * dt / (p.mass * speed);
    return -push * most.kn * reach * second_at_end(law.elastic_exponent(), theta) +
           most.kn * reach * zeta(law.elastic_exponent(), theta) -
           most.gn * speed * zeta(law.damping_exponent(), theta);
  }

  /// The force ends where damping has made up for the elastic force.
  double limited_end(const Pair &p, const Contact &c, double before, double speed) const
  {
    const Coefficients was = coefficients(law, before, p.mass, p.radius);
    const double rest = before - was.gn * speed / was.kn, exponent = law.elastic_exponent();
    const EventStep e = event_step(p, rest, 1.0, dot(p.a, p.n) - c.force / p.mass);
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
    const double rest = law.limit_damping ? before - was.gn * speed / was.kn : before;
    const EventStep e = event_step(p, rest, 1.0, dot(p.a, p.n) - c.force / p.mass);
    if (!e.happens) return {};
    const double limit = law.mu * c.force, falls = limit / e.theta;
    const Vec rate = dt * was.kt * u;
    const double rises = dot(unit(f), rate);
    double sticks = e.theta;
    if (falls + rises > 0.0) sticks = (limit - length(f)) / (falls + rises);
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
    const double vn = dot(p.v, p.n);
    const double turning = p.j ? (dot(p.v, p.v) - vn * vn) / p.distance : 0.0;
    const double change = dot(p.a, p.n) + turning;
    const double growth = -law.elastic_exponent() * now.kn * vn +
                          law.damping_exponent() * now.gn / p.d * vn * vn - now.gn * change;
    return growth * dt > force ? force / (growth * dt) : 1.0;
  }

  void touch(const Pair &p, Contact &c)
  {
    const Coefficients now = coefficients(law, p.d, p.mass, p.radius);
    const double vn = dot(p.v, p.n);
    const EventStep start =
        lag > 0.0 && !c.touches ? event_step(p, p.d, -1.0, dot(p.a, p.n)) : EventStep{};
    const bool begins = start.happens;
    const double theta = start.theta, approach = start.step_overlap;
    const Coefficients most =
        begins ? coefficients(law, approach, p.mass, p.radius) : Coefficients{};

    // normal
    const double forward = with.damping ? lag : 0.0;
    const double own = with.implicit && c.touches ? c.force / p.mass : 0.0;
    const double v_p = vn + forward * (dot(p.a, p.n) - own);
    double pure = now.kn * p.d - now.gn * v_p;
    if (with.implicit) pure /= 1.0 + now.gn * forward / p.mass;
    if (law.limit_damping) pure = std::max(pure, 0.0);
    double force = pure;
    if (begins && with.ends && with.after) {
      const double elastic = most.kn * approach, push = elastic * dt * dt / (p.mass * approach);
      force -= push * elastic * second_at_begin(law.elastic_exponent(), theta);
    }
    if (begins && with.ends)
      force -= most.kn * approach * elastic_error(start, theta) -
               most.gn * vn * zeta(law.damping_exponent(), theta);
    double pull = law.adhesion;
    if (begins && with.ends) pull *= 1.0 - zeta(0.0, theta);

    // tangential
    Vec friction{};
    const bool returns = with.slip && c.touches && c.force == 0.0 && pure > 0.0;
    const double share = returns ? since_return(p, now, pure) : theta;
    if (law.mu > 0.0) {
      const Vec u = surface_velocity(p.v + forward * p.a, p.spin + forward * p.alpha, p.n);
      const Vec wanted = friction_of(p, c, now, u, share, law.mu * std::fabs(pure));
      friction = wanted;
      if (begins && with.ends)
        friction = friction + elastic_error(start, theta) * most.kt * dt * u +
                   zeta(law.damping_exponent(), theta) * most.gt * u;
      friction = capped(friction, law.mu * std::fabs(force));
      // sliding all the time: the share of the normal force
      if (begins && with.ends && slides) friction = (law.mu * std::fabs(force)) * unit(wanted);
    }
    Vec moment = cross(p.n, friction), twist{};
    if (law.resistance.any()) {
      ResistanceInput in;
      in.n = in.half_n = in.old_n = p.n;
      in.rotation = p.spin;
      in.omega = p.i->w;
      in.rotation_change = lag * p.alpha;
      in.omega_change = lag * p.i->alpha;
      in.moment = moment;
      in.pure = std::max(pure, 0.0);
      in.force = std::max(force, 0.0);
      in.jump = law.damping_exponent() == 0.0 ? std::max(-now.gn * vn, 0.0) : 0.0;
      in.share = begins && with.ends ? 1.0 - zeta(0.0, theta) : 1.0;
      in.dt = dt;
      in.lasted = with.midpoint ? share * dt : dt;
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
      const Resisting resisting = resist(law.resistance, in, c.resistance, with.rolling);
      moment = moment + resisting.moment;
      twist = resisting.torque - resisting.twist * p.n;
    }
    apply(p, (force - pull) * p.n + friction, moment, twist);
    c.touches = true;
    c.force = pure;
    c.slid = law.mu > 0.0 && slides;
  }

  static Vec surface_velocity(Vec v, Vec spin, Vec n) { return across(v, n) - cross(spin, n); }

  /// Half of what the normal turns in a step.
  Vec half_turn(const Pair &p) const
  {
    return p.j ? (0.5 * dt / p.distance) * across(p.v, p.n) : Vec{};
  }

  static Vec capped(Vec a, double limit)
  {
    const double l = length(a);
    return l > limit ? (limit / l) * a : a;
  }

  bool slides = false;

  /// Advances the displacement. Spring and dashpot in parallel, both in series with a slider: the
  /// force is -f, f = kt s + gt s', |f| <= L, and the slip u - s' is along f.
  Vec friction_of(const Pair &p, Contact &c, const Coefficients &now, Vec u, double theta,
                  double limit)
  {
    const double lasted = with.midpoint ? theta * dt : dt;
    const double time = lag > 0.0 ? lasted : 0.0;
    Vec before, slip;
    if (with.midpoint) {
      const Vec q = half_turn(p), spin = p.spin + dot(p.spin, p.n) * q;
      before = rotated(c.s, p.n, q);
      slip = time * (surface_velocity(p.v, spin, p.n) + dot(p.v, p.n) * q);
    } else {
      before = across(c.s, p.n);
      slip = time * surface_velocity(p.v, p.spin, p.n);
    }
    const Vec trial = before + slip, f = now.kt * trial + now.gt * u;
    c.s = trial;
    slides = length(f) > limit;
    if (!slides) return -1.0 * f;
    const double tau = now.gt / now.kt;
    Vec end = limit * unit(f);
    if (!law.slider) {
      c.s = (1.0 / now.kt) * (end - now.gt * u);
      return -1.0 * end;
    }
    if (!with.slip || time == 0.0) {
      if (time > 0.0) c.s = (1.0 / (tau + time)) * (tau * before + (time / now.kt) * end);
      const Vec reach = now.kt * c.s + now.gt * u;
      return -limit * unit(reach);
    }
    // the force a step ago; of a contact that begins, that of the dashpot where it did
    const double h = c.touches ? dt : time;
    const double d0 = c.touches ? std::max(p.d + dt * dot(p.v, p.n), 0.0) : 0.0;
    const Coefficients old = coefficients(law, d0, p.mass, p.radius);
    const Coefficients mid = coefficients(law, 0.5 * (d0 + p.d), p.mass, p.radius);
    Vec g = (1.0 / now.kt) * end, rate{};
    if (c.touches) {
      const Vec u_mid = (1.0 / time) * slip, u_old = 2.0 * u_mid - u;
      const Vec f_old = capped(old.kt * before + old.gt * u_old, law.mu * std::fabs(c.force));
      const Vec along = unit(mid.kt * (before + 0.5 * slip) + mid.gt * u_mid);
      // g = f/kt: at its limit half way along `along`
      const Vec g_old = old.kt > 0.0 ? (1.0 / old.kt) * f_old : Vec{};
      const double most = limit / now.kt, b = dot(along, g_old);
      const double root = b * b + most * most - dot(g_old, g_old);
      if (root >= 0.0 && b + std::sqrt(root) > 0.0) g = (b + std::sqrt(root)) * along - g_old;
      if (old.gt > 0.0) rate = (1.0 / old.gt) * f_old;
    } else if (now.gt > 0.0)
      rate = std::max(-law.mu * now.gn * dot(p.v, p.n) / now.gt, 0.0) * unit(f);
    // s' = f/gt - s/tau with f/gt linear in time: second order for small h/tau, s = g for large
    if (now.gt > 0.0) rate = rate + (now.kt / now.gt) * g;
    const double t_mid = mid.gt / mid.kt;
    c.s = (1.0 / (t_mid * t_mid + t_mid * h + 0.5 * h * h)) *
          (t_mid * t_mid * (before + 0.5 * h * rate) + 0.5 * h * h * g);
    return -limit * unit(now.kt * c.s + now.gt * u);
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

}    // namespace Reference

#endif
