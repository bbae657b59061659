// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Two spheres, the kernel of one law and the semi-implicit Euler step of the reference method.

#ifndef TALUS_TEST_TWO_SPHERES_H
#define TALUS_TEST_TWO_SPHERES_H

#include "laws/intersection_radius.h"
#include "named_law.h"

#include <array>
#include <cmath>

namespace reference {

using Triple = std::array<double, 3>;

inline Triple operator+(const Triple &a, const Triple &b)
{
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Triple operator*(double s, const Triple &a)
{
  return {s * a[0], s * a[1], s * a[2]};
}
inline Triple operator-(const Triple &a, const Triple &b)
{
  return a + -1.0 * b;
}
inline double inner(const Triple &a, const Triple &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double norm(const Triple &a)
{
  return std::sqrt(inner(a, a));
}
struct Sphere {
  double radius, mass;
  Triple x, v, omega{};
  Triple force{};    ///< of the contact
};

class TwoSpheres {
 public:
  named::NamedLaw law;
  named::Numbers coefficients;
  std::array<Sphere, 2> body;
  double dt = 0.0;
  Triple gravity{};
  Talus::ContactBatch batch;    ///< lane 0 is the contact

  TwoSpheres(const Sphere &a, const Sphere &b) : body{a, b} { batch.clear(); }

  Triple separation() const { return body[0].x - body[1].x; }
  double overlap() const { return body[0].radius + body[1].radius - norm(separation()); }
  double effective_mass() const
  {
    return body[0].mass * body[1].mass / (body[0].mass + body[1].mass);
  }
  double effective_radius() const
  {
    return body[0].radius * body[1].radius / (body[0].radius + body[1].radius);
  }

  /// Forces of the current state; history advances.
  void compute()
  {
    for (int d = 0; d < 3; d++)
      batch.force[d][0] = batch.torque_per_radius[d][0] = batch.twisting_torque[d][0] = 0.0;
    if (overlap() <= 0.0) {
      for (int d = 0; d < 3; d++) batch.history[d][0] = batch.history[4 + d][0] = 0.0;
      batch.history[3][0] = 0.0;
    } else {
      fill();
      const Talus::ContactCoefficients row = row_of(law, coefficients);
      Talus::contact_kernel(law, true, true)(batch, 0, Talus::lanes, &row, dt);
    }
  }

  /// Moves both bodies with the forces of the last compute().
  void move()
  {
    const auto lane = [](const double(&v)[3][Talus::ContactBatch::width]) {
      return Triple{v[0][0], v[1][0], v[2][0]};
    };
    for (int b = 0; b < 2; b++) {
      Sphere &s = body[b];
      const double sign = b == 0 ? 1.0 : -1.0;
      s.force = sign * lane(batch.force);
      const Triple torque =
          -s.radius * lane(batch.torque_per_radius) + sign * lane(batch.twisting_torque);
      s.v = s.v + dt * (gravity + (1.0 / s.mass) * s.force);
      s.omega = s.omega + (dt / (0.4 * s.mass * s.radius * s.radius)) * torque;
      s.x = s.x + dt * s.v;
    }
  }

 private:
  void fill()
  {
    const Sphere &a = body[0], &b = body[1];
    const Triple n = (1.0 / norm(separation())) * separation(), v = a.v - b.v,
                 w = a.omega - b.omega;
    const Triple spin = a.radius * a.omega + b.radius * b.omega;
    for (int d = 0; d < 3; d++) {
      batch.normal[d][0] = n[d];
      batch.velocity[d][0] = v[d];
      batch.surface_rotation[d][0] = spin[d];
      batch.relative_omega[d][0] = w[d];
    }
    batch.overlap[0] = overlap();
    batch.inverse_mass[0] = 1.0 / effective_mass();
    batch.inverse_radius[0] = 1.0 / effective_radius();
    batch.inverse_distance[0] = 1.0 / norm(separation());
    batch.intersection_radius[0] = Talus::intersection_radius_of(a.radius, b.radius, overlap());
  }
};

}    // namespace reference

#endif
