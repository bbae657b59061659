// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The slow reference of second_order_reference.h for contacts with adhesion of their own: two
// spheres, or a sphere and a plane, with the normal laws dmt and jkr, their damping in proportion
// to the contact radius, and a tangential dashpot. The forces of such contacts begin and end with
// jumps:
//
//   dmt  F = 4/3 E sqrt(R) d^(3/2) - 4 pi gamma R while d > 0
//   jkr  d = a^2/R - 2 sqrt(pi gamma a/E), F = 4/3 E a^3/R - 4 a^(3/2) sqrt(pi gamma E), from d = 0
//        on, where F = -8/9 F_p, until F = -F_p = -3 pi gamma R with dF/dd = 0 (Johnson, Kendall
//        and Roberts 1971, Proc. R. Soc. A 324, 301; loads are given, not displacements)
//   friction -xt g u, limited by mu (F + 2 F_p), F without damping; lever arms end in the middle of
//        the overlap of two spheres
//
// `ends`: what the sum over time steps lacks of them is made up for; `damping`: it belongs to the
// time of the positions and is implicit. Without both it is a leapfrog of first order.

#ifndef TALUS_TESTS_ADHESIVE_REFERENCE_H
#define TALUS_TESTS_ADHESIVE_REFERENCE_H

#include "second_order_reference.h"

namespace Reference {

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

class AdhesiveImpact {
 public:
  AdhesiveLaw law;
  bool ends = true, damping = true;
  bool detached = false;    ///< the contact has ended

  /// Of the first two particles of `its`, or of the first one and its plane. Velocities at the end
  /// are those of the end.
  void run(System &moving, double time, int steps)
  {
    system = &moving;
    dt = time / steps;
    lag = 0.0;
    contact = {};
    for (int n = 0; n < steps; n++) {
      find_forces();
      kick(lag + 0.5 * dt);
      for (Particle &p : moving.particles) p.x = p.x + dt * p.v;
      lag = 0.5 * dt;
    }
    find_forces();
    kick(lag);
  }

 private:
  struct {
    bool touches = false, slid = false;
    double force = 0.0;    // F + F_p with damping, of the last step
  } contact;
  System *system = nullptr;
  double dt = 0.0, lag = 0.0;

  struct Pair {
    Vec n, v, spin, a, alpha;
    double d, distance, mass, radius;    // distance: infinite from a plane
  };
  struct Forces {
    double normal = 0.0;
    Vec friction{};
  };

  void kick(double time)
  {
    for (Particle &p : system->particles) {
      p.v = p.v + time * p.a;
      p.w = p.w + time * p.alpha;
    }
  }

  Pair pair() const
  {
    const Particle &i = system->particles[0];
    if (!system->planes.empty()) {
      const Plane &plane = system->planes[0];
      return {plane.normal,
              i.v,
              i.radius * i.w,
              i.a,
              i.radius * i.alpha,
              i.radius - dot(i.x - plane.point, plane.normal),
              HUGE_VAL,
              i.mass,
              i.radius};
    }
    const Particle &j = system->particles[1];
    const double distance = length(i.x - j.x);
    return {unit(i.x - j.x),
            i.v - j.v,
            i.radius * i.w + j.radius * j.w,
            i.a - j.a,
            i.radius * i.alpha + j.radius * j.alpha,
            i.radius + j.radius - distance,
            distance,
            i.mass * j.mass / (i.mass + j.mass),
            i.radius * j.radius / (i.radius + j.radius)};
  }

  void find_forces()
  {
    const Pair p = pair();
    Forces f;
    if (contact.touches && p.d <= -law.pulloff_distance(p.radius)) {
      f = separate(p);
      contact = {};
      detached = true;
    } else if (contact.touches || p.d > 0.0) {
      f = touch(p);
      if (lag == 0.0) contact = {};    // a setup stores no history
    }
    for (std::size_t n = 0; n < system->particles.size(); n++) {
      Particle &it = system->particles[n];
      const double arm = it.radius - (std::isinf(p.distance) ? 0.0 : 0.5 * p.d);
      const double sign = n == 0 ? 1.0 : -1.0;
      it.a = system->gravity + (sign / it.mass) * (f.normal * p.n + f.friction);
      it.alpha = (-arm / it.inertia()) * cross(p.n, f.friction);
    }
  }

  /// As System::EventStep: whether the contact begins or ends in this step, time since or until
  /// then over dt, overlap that one step adds, curvature.
  struct EventStep {
    bool happens = false;
    double theta = 1.0, step_overlap = 1.0, curvature = 0.0;
  };
  EventStep event_step(const Pair &p, double d, double sign, double others) const
  {
    const double turning = this->turning(p);
    const double step = sign * dt * (dot(p.v, p.n) - 0.5 * dt * turning);
    if (!ends || d <= 0.0 || step < d) return {};
    const double curvature = std::clamp(-dt * dt * (others + turning) / step, -1.0, 1.0);
    const double theta = d / step * (1.0 - 0.5 * curvature * (1.0 - d / step));
    return {true, theta, step * (1.0 + curvature * (0.5 - theta)), curvature};
  }
  static double turning(const Pair &p)
  {
    const double vn = dot(p.v, p.n);
    return (dot(p.v, p.v) - vn * vn) / p.distance;
  }
  double bent(const EventStep &e, double later) const
  {
    const double p = law.elastic_exponent(), first = zeta(p, e.theta);
    return first + e.curvature * ((0.5 * p + 1.0) * zeta(p + 1.0, e.theta) - later * first);
  }

  Forces touch(const Pair &p)
  {
    const double vn = dot(p.v, p.n), forward = damping ? lag : 0.0;
    const double rest = law.rest(p.d, p.radius), g = law.dashpot(p.d, p.mass, p.radius);
    const double own = damping && contact.touches ? contact.force / p.mass : 0.0;
    const double v_p = vn + forward * (dot(p.a, p.n) - own);
    const double pure = (rest - g * v_p) / (1.0 + g * forward / p.mass);
    const EventStep e =
        lag > 0.0 && !contact.touches ? event_step(p, p.d, -1.0, dot(p.a, p.n)) : EventStep{};

    const double jump = law.rest_at_begin(p.radius), ratio = e.happens ? e.step_overlap / p.d : 1.0;
    double early = 0.0, of_dashpot = 0.0, share = 1.0;
    if (e.happens) {
      const double most = (rest - jump) * std::pow(ratio, law.elastic_exponent());
      early = jump * zeta(0.0, e.theta) + most * bent(e, e.theta);
      if (!law.detaches)
        early += most * most * dt * dt / (p.mass * e.step_overlap) * second_at_begin(1.5, e.theta);
      of_dashpot = std::pow(ratio, law.damping_exponent()) * zeta(law.damping_exponent(), e.theta);
      share = 1.0 - zeta(0.0, e.theta);
    }
    Forces f{pure - early + of_dashpot * g * vn - share * law.pulloff_force(p.radius), {}};

    const Vec u = surface_velocity(p.v + forward * p.a, p.spin + forward * p.alpha, p.n);
    const double limit = law.mu * (rest + law.pulloff_force(p.radius));
    const Vec drag = -law.xt * g * u;
    double most = law.mu * (rest - early + share * law.pulloff_force(p.radius));
    if (e.happens)
      most -= e.theta * grows(law.mu * (law.pulloff_force(p.radius) + jump), length(drag));
    contact.slid = length(drag) > limit;
    f.friction = contact.slid ? most * unit(drag) : capped((1.0 - of_dashpot) * drag, most);
    contact.touches = true;
    contact.force = pure;
    return f;
  }

  /// The first step after its end: what the sum of its forces lacks.
  Forces separate(const Pair &p) const
  {
    const double vn = dot(p.v, p.n), way = dt * (vn - 0.5 * dt * turning(p));
    const double before = p.d + way, left = before + law.pulloff_distance(p.radius);
    const EventStep e = event_step(p, left, 1.0, dot(p.a, p.n) - contact.force / p.mass);
    if (!e.happens) return {};
    const double g = law.dashpot(before, p.mass, p.radius);
    double elastic = 0.0;
    if (!law.detaches) {
      const double most = law.rest(before, p.radius) * std::pow(e.step_overlap / left, 1.5);
      const double push = most * dt * dt / (p.mass * e.step_overlap);
      elastic = -most * (bent(e, e.theta - 1.0) - push * second_at_end(1.5, e.theta));
    }
    const double share = left / way - 0.5, pull = share * law.pulloff_force(p.radius);
    const double of_dashpot = std::pow(e.step_overlap / left, law.damping_exponent()) *
                              zeta(law.damping_exponent(), e.theta);
    const Vec drag = -law.xt * g * surface_velocity(p.v, p.spin, p.n);
    Forces f{elastic + of_dashpot * g * vn - pull, -of_dashpot * drag};
    const double end = e.theta * grows(law.mu * law.pulloff_force(p.radius), length(drag));
    if (contact.slid) f.friction = (law.mu * (elastic + pull) - end) * unit(drag);
    return f;
  }

  /// What the integral of a dashpot's friction `drag` that grows to a limit in the first step, or
  /// falls from it in the last one, lacks of that of the limit.
  double grows(double limit, double drag) const
  {
    const double p = law.damping_exponent();
    if (drag <= limit || p == 0.0) return 0.0;
    return limit * std::pow(limit / drag, 1.0 / p) * p / (1.0 + p);
  }

  static Vec surface_velocity(Vec v, Vec spin, Vec n) { return across(v, n) - cross(spin, n); }
  static Vec capped(Vec a, double limit) { return length(a) > limit ? limit * unit(a) : a; }
};

}    // namespace Reference

#endif
