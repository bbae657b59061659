// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Random contacts for the kernels, ordinary and degenerate, and the way into and out of a batch.

#ifndef TALUS_TEST_RANDOM_CONTACT_H
#define TALUS_TEST_RANDOM_CONTACT_H

#include "named_law.h"
#include "random_source.h"
#include "slow_contact.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace slow {

inline const double infinity = std::numeric_limits<double>::infinity();

/// The laws of the reference in slow_contact.h: those that the stock styles have as well.
inline std::vector<named::NamedLaw> all_laws()
{
  using N = named::Normal;
  using T = named::Tangential;
  std::vector<named::NamedLaw> laws;
  for (N normal : {N::HOOKE, N::HERTZ})
    for (T tangential : {T::NONE, T::DASHPOT, T::ONESTEP, T::MULTISTEP})
      laws.push_back({normal, tangential});
  return laws;
}

inline std::string title(named::NamedLaw law)
{
  return std::string(name_of(law.normal)) + " " + name_of(law.tangential);
}

inline named::Numbers random_coefficients(RandomSource &random, bool limit_damping)
{
  named::Numbers c;
  c.kn = random.decade(3.0, 7.0);
  c.kt = c.kn * random.uniform(0.1, 1.0);
  c.gn = random.chance(0.1) ? 0.0 : random.decade(0.0, 4.0);
  c.gt = random.chance(0.1) ? 0.0 : random.decade(-0.5, 0.5) * std::max(c.gn, 1.0);
  c.mu = random.chance(0.1) ? 0.0 : random.uniform(0.05, 1.5);
  c.force_floor = limit_damping ? 0.0 : -infinity;
  return c;
}

/// Velocities and history are in proportion to overlap, collision time and damping, so that
/// contacts stick and slide, approach and separate, in comparable numbers; one in three is
/// degenerate in some way.
inline Contact random_contact(RandomSource &random, named::NamedLaw law, const named::Numbers &p)
{
  Contact c;
  c.normal = random.unit_vector();
  for (int b = 0; b < 2; b++) {
    c.radius[b] = random.decade(-3.0, 0.0);
    c.mass[b] = random.decade(-4.0, 1.0);
  }
  c.overlap = c.radius[0] * random.decade(-6.0, -0.5);
  double k = p.kn;
  if (law.normal == named::Normal::HERTZ) k *= std::sqrt(c.overlap * c.radius[0]);
  double speed = c.overlap * std::sqrt(k / c.mass[0]);
  if (random.chance(0.5) && p.gn > 0.0)    // where damping balances the spring
    speed = p.kn * c.overlap / (p.gn * reduced(c.mass[0], c.mass[1]));
  speed *= random.decade(-1.5, 1.5);
  for (int b = 0; b < 2; b++) {
    c.velocity[b] = random.in_cube(speed);
    c.omega[b] = random.in_cube(speed / c.radius[b]);
  }
  const double slip = c.overlap * random.decade(-2.0, 1.0);
  c.history = random.in_cube(slip);
  c.sliding = random.chance(0.3);

  double scale = 1.0;
  switch (random.below(36)) {
  case 0:
    c.velocity = {};
    break;
  case 1:
    c.omega = {};
    break;
  case 2:
    c.velocity = {};
    c.omega = {};
    break;
  case 3:
    c.history = {};
    c.sliding = false;
    break;
  case 4:
    c.history = {};
    break;
  case 5:
    c.velocity = {};
    c.omega = {};
    c.history = {};
    break;
  case 6:
    c.overlap = 0.0;
    break;
  case 7:
    c.overlap = 0.0;
    c.normal = {};
    break;    // coincident centers
  case 8:
    c.mass[0] = infinity;
    break;
  case 9:
    c.mass = {infinity, infinity};
    break;
  case 10:
    scale = 1e40;
    break;
  case 11:
    scale = 1e-40;
    break;
  default:
    break;
  }
  c.overlap *= scale;
  for (int b = 0; b < 2; b++) {
    c.radius[b] *= scale;
    for (double &v : c.velocity[b]) v *= scale;
  }
  for (double &s : c.history) s *= scale;
  return c;
}

inline Talus::ContactState<double> state_of(const Contact &c)
{
  Talus::ContactState<double> s;
  s.normal = {c.normal[0], c.normal[1], c.normal[2]};
  s.overlap = c.overlap;
  double v[3], w[3];
  for (int d = 0; d < 3; d++) {
    v[d] = c.velocity[0][d] - c.velocity[1][d];
    w[d] = c.radius[0] * c.omega[0][d] + c.radius[1] * c.omega[1][d];
  }
  s.velocity = {v[0], v[1], v[2]};
  s.surface_rotation = {w[0], w[1], w[2]};
  s.inverse_mass = 1.0 / c.mass[0] + 1.0 / c.mass[1];
  s.inverse_radius = 1.0 / c.radius[0] + 1.0 / c.radius[1];
  return s;
}

inline void put(Talus::ContactBatch &batch, int lane, const Contact &c, int row)
{
  const Talus::ContactState<double> s = state_of(c);
  const double normal[3] = {s.normal.x, s.normal.y, s.normal.z};
  const double velocity[3] = {s.velocity.x, s.velocity.y, s.velocity.z};
  const double spin[3] = {s.surface_rotation.x, s.surface_rotation.y, s.surface_rotation.z};
  for (int d = 0; d < 3; d++) {
    batch.normal[d][lane] = normal[d];
    batch.velocity[d][lane] = velocity[d];
    batch.surface_rotation[d][lane] = spin[d];
    batch.history[d][lane] = c.history[d];
    batch.force[d][lane] = batch.torque_per_radius[d][lane] = 0.0;
  }
  batch.overlap[lane] = s.overlap;
  batch.inverse_mass[lane] = s.inverse_mass;
  batch.inverse_radius[lane] = s.inverse_radius;
  batch.history[3][lane] = c.sliding ? 1.0 : 0.0;
  batch.coefficients[lane] = row;
}

/// Three numbers side by side.
inline Vector lane_of(const double (*v)[Talus::ContactBatch::width], int lane)
{
  return {v[0][lane], v[1][lane], v[2][lane]};
}

}    // namespace slow

#endif
