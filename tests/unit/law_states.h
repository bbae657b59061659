// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Random materials and contacts for every law, ordinary and degenerate, and the way into and out of a batch.

#ifndef TALUS_TEST_LAW_STATES_H
#define TALUS_TEST_LAW_STATES_H

#include "law_reference.h"
#include "laws/contact_kernel.h"
#include "laws/intersection_radius.h"
#include "random_source.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace reference {

using Talus::ContactSpec;

inline bool is_material(Normal law)
{
  return law >= Normal::HOOKE_MATERIAL;
}
inline bool is_plaincoulomb(Normal law)
{
  return law == Normal::PLAINCOULOMB || law == Normal::PLAINCOULOMB_MATERIAL;
}

/// Normal and tangential laws that the grammar allows together.
inline std::vector<NamedLaw> law_pairs()
{
  std::vector<NamedLaw> laws;
  for (int n = 0; n < named::num_normal_laws; n++)
    for (int t = 0; t < named::num_tangential_laws; t++) {
      const NamedLaw law{static_cast<Normal>(n), static_cast<Tangential>(t)};
      if (is_plaincoulomb(law.normal) == (law.tangential == Tangential::TANH)) laws.push_back(law);
    }
  return laws;
}

/// Those that the stock styles have as well.
inline std::vector<NamedLaw> stock_laws()
{
  std::vector<NamedLaw> laws;
  for (Normal normal : {Normal::HOOKE, Normal::HERTZ})
    for (Tangential tangential :
         {Tangential::NONE, Tangential::DASHPOT, Tangential::ONESTEP, Tangential::MULTISTEP})
      laws.push_back({normal, tangential});
  return laws;
}

/// Of laws that take stiffness and damping as they are given.
inline Composite composite_of(const named::Numbers &n)
{
  Composite c;
  c.kn = n.kn;
  c.gn = n.gn;
  c.kt = n.kt;
  c.gt = n.gt;
  c.mu = n.mu;
  c.limited = n.force_floor == 0.0;
  return c;
}

/// The same law with and without resistance, at once or delayed, and adhesion of every kind.
inline std::vector<NamedLaw> variants(NamedLaw law)
{
  std::vector<NamedLaw> laws;
  for (int v = 0; v < 3 * named::num_adhesions; v++) {
    law.resists = v % 3 > 0;
    law.delayed = v % 3 == 2;
    law.adhesion = static_cast<Adhesion>(v / 3);
    laws.push_back(law);
  }
  return laws;
}

inline std::string title(NamedLaw law)
{
  return std::string(name_of(law.normal)) + " " + name_of(law.tangential) +
         (law.resists ? law.delayed ? " delayed" : " resists" : "") +
         (law.adhesion == Adhesion::NONE ? "" : std::string(" ") + name_of(law.adhesion));
}

/// Name of a law as GoogleTest allows it.
inline std::string identifier(NamedLaw law)
{
  std::string name = title(law);
  for (char &c : name)
    if (c == ' ' || c == '/') c = '_';
  return name;
}

inline ContactSpec random_spec(RandomSource &random, NamedLaw law, bool limited)
{
  ContactSpec s;
  s.law = law;
  auto &given = s.given;
  if (limited) given["limit_damping"] = 1.0;
  const auto zero_or = [&](double value) { return random.chance(0.1) ? 0.0 : value; };
  const bool with_kt = random.chance(0.5), with_gt = random.chance(0.5);
  if (is_material(law.normal)) {
    given["E"] = random.decade(4.0, 8.0);
    given["nu"] = random.chance(0.1) ? 0.5 : random.uniform(-0.9, 0.5);
    const double special[] = {0.0, 1.0, 1e-3, 0.01, 0.999};
    given["e"] = random.chance(0.3) ? special[random.below(5)] : random.uniform(0.0, 1.0);
    given["vchar"] = random.decade(-3.0, 1.0);
    // the grammar's rule
    if (with_kt && law.normal != Normal::HOOKE_MATERIAL)
      given["kt"] = given["E"] * random.uniform(0.5, 2.0);
    if (with_gt) given["gt"] = zero_or(random.uniform(0.1, 2.0));
  } else {
    given["kn"] = random.decade(3.0, 7.0);
    given["gn"] = zero_or(random.decade(0.0, 4.0));
    if (with_kt) given["kt"] = given["kn"] * random.uniform(0.1, 1.0);
    if (with_gt) given["gt"] = zero_or(random.decade(-0.5, 0.5) * std::max(given["gn"], 1.0));
    if (law.normal == Normal::FLORES) given["gn"] *= 1e3;
  }
  given["mu"] = zero_or(random.uniform(0.05, 1.5));
  given["mu_r"] = zero_or(random.uniform(0.01, 0.5));
  given["mu_s"] = zero_or(random.uniform(0.01, 0.5));
  const double pull = zero_or(random.decade(-3.0, 1.0));
  if (law.adhesion == Adhesion::CONSTANT) given["adhesive force"] = pull;
  if (law.adhesion == Adhesion::DMT) given["adhesion W"] = pull;
  if (law.adhesion == Adhesion::PERKO) given["adhesion S"] = pull;
  given["slip_min"] = zero_or(random.decade(-6.0, -1.0));
  given["roll_min"] = zero_or(random.decade(-6.0, -1.0));
  given["twist_min"] = zero_or(random.decade(-6.0, 0.0));
  return s;
}

inline Vector widen(const std::array<double, 3> &v)
{
  return {v[0], v[1], v[2]};
}

/// Velocities and history are in proportion to overlap, collision time and damping, so that contacts stick and
/// slide, approach and separate, in comparable numbers; one in three is degenerate in some way. All numbers
/// are doubles.
inline Contact random_contact(RandomSource &random, NamedLaw law, const Composite &p, double dt)
{
  double radius[2], mass[2];
  for (int b = 0; b < 2; b++) {
    radius[b] = random.decade(-3.0, 0.0);
    mass[b] = random.decade(-4.0, 1.0);
  }
  double overlap = std::min(radius[0], radius[1]) * random.decade(-6.0, -0.5);
  const Number m = reduced(mass[0], mass[1]);
  const Stiffness k = stiffness(law.normal, p, overlap, m, reduced(radius[0], radius[1]),
                                std::max(p.speed, Number(1e-3)));
  double speed = rounded(static_cast<double>(overlap * std::sqrt(k.kn / m)));
  if (random.chance(0.5) && k.gn > 0)    // where damping balances the spring
    speed = std::min(1e6 * speed, rounded(static_cast<double>(k.kn * overlap / k.gn)));
  speed *= random.decade(-1.5, 1.5);
  std::array<double, 3> velocity[2], omega[2];
  for (int b = 0; b < 2; b++) {
    velocity[b] = random.in_cube(speed);
    omega[b] = random.in_cube(speed / radius[b]);
  }
  std::array<double, 3> history = random.in_cube(overlap * random.decade(-2.0, 1.0));
  const double collision_time = rounded(static_cast<double>(pi * std::sqrt(m / k.kn)));

  Contact c;
  c.normal = widen(random.unit_vector());
  c.sliding = random.chance(0.3);
  c.begun = random.chance(0.8);
  c.age = c.begun ? static_cast<double>(collision_time * random.decade(-1.0, 1.0)) : 0.0;
  double impact_speed = c.begun ? speed * random.decade(-0.5, 1.0) : 0.0;
  if (random.chance(0.05)) c.age = dt * random.below(3);

  double scale = 1.0;
  const std::array<double, 3> none{};
  switch (random.below(42)) {
  case 0:
    velocity[0] = velocity[1] = none;
    break;
  case 1:
    omega[0] = omega[1] = none;
    break;
  case 2:
    velocity[0] = velocity[1] = omega[0] = omega[1] = none;
    break;
  case 3:
    history = none;
    c.sliding = c.begun = false;
    break;
  case 4:
    history = none;
    break;
  case 5:
    velocity[0] = velocity[1] = omega[0] = omega[1] = history = none;
    break;
  case 6:
    overlap = 0.0;
    break;
  case 7:
    overlap = 0.0;
    c.normal = {};
    break;    // coincident centers
  case 8:
    mass[0] = infinity;
    break;
  case 9:
    mass[0] = mass[1] = infinity;
    break;
  case 10:
    scale = 1e40;
    break;
  case 11:
    scale = 1e-40;
    break;
  case 12:
    radius[1] = radius[0];
    mass[1] = mass[0];
    break;
  case 13:
    omega[1] = omega[0];
    break;
  default:
    break;
  }
  if (!c.begun) c.age = impact_speed = 0.0;
  c.overlap = std::min(radius[0], radius[1]) < overlap ? 0.1 * overlap * scale : overlap * scale;
  c.impact_speed = impact_speed * scale;
  for (int b = 0; b < 2; b++) {
    c.radius[b] = radius[b] * scale;
    c.mass[b] = mass[b];
    c.omega[b] = widen(omega[b]);
    for (int d = 0; d < 3; d++) c.velocity[b][d] = velocity[b][d] * scale;
  }
  for (int d = 0; d < 3; d++) c.history[d] = history[d] * scale;
  return c;
}

/// What the kernels see: the first body is body 1, their normal points to it.
inline Talus::ContactState<double> state_of(const Contact &c)
{
  double n[3], v[3], w[3], relative[3];
  const double r[2] = {static_cast<double>(c.radius[0]), static_cast<double>(c.radius[1])};
  for (int d = 0; d < 3; d++) {
    const double w0 = static_cast<double>(c.omega[0][d]), w1 = static_cast<double>(c.omega[1][d]);
    n[d] = static_cast<double>(-c.normal[d]);
    v[d] = static_cast<double>(c.velocity[0][d]) - static_cast<double>(c.velocity[1][d]);
    w[d] = r[0] * w0 + r[1] * w1;
    relative[d] = w0 - w1;
  }
  Talus::ContactState<double> s;
  s.normal = {n[0], n[1], n[2]};
  s.overlap = static_cast<double>(c.overlap);
  s.velocity = {v[0], v[1], v[2]};
  s.surface_rotation = {w[0], w[1], w[2]};
  s.inverse_mass = 1.0 / static_cast<double>(c.mass[0]) + 1.0 / static_cast<double>(c.mass[1]);
  s.inverse_radius = 1.0 / r[0] + 1.0 / r[1];
  s.relative_omega = {relative[0], relative[1], relative[2]};
  const bool apart = norm(c.normal) > 0;    // from the sum of radii, as the kernels' callers
  s.inverse_distance = apart ? 1.0 / (r[0] + r[1] - s.overlap) : 0.0;
  s.intersection_radius = Talus::intersection_radius_of(r[0], r[1], s.overlap);
  return s;
}

/// Displacement, sliding; impact speed, age and begun, which the laws keep if they need them.
inline Talus::HistoryValues remembered(const Contact &c)
{
  const auto d = [](Number n) { return static_cast<double>(n); };
  return {{d(-c.history[0]), d(-c.history[1]), d(-c.history[2]), c.sliding ? 1.0 : 0.0,
           d(c.impact_speed), d(c.age), c.begun ? 1.0 : 0.0}};
}

using Lanes = double[3][Talus::ContactBatch::width];

inline void put(Lanes &lanes, int lane, const Talus::Vector3<double> &v)
{
  lanes[0][lane] = v.x;
  lanes[1][lane] = v.y;
  lanes[2][lane] = v.z;
}

inline void put(Talus::ContactBatch &batch, int lane, const Talus::ContactState<double> &s,
                const Talus::HistoryValues &history, int row)
{
  put(batch.normal, lane, s.normal);
  put(batch.velocity, lane, s.velocity);
  put(batch.surface_rotation, lane, s.surface_rotation);
  put(batch.relative_omega, lane, s.relative_omega);
  for (Lanes *result : {&batch.force, &batch.torque_per_radius, &batch.twisting_torque})
    put(*result, lane, {0.0, 0.0, 0.0});
  batch.overlap[lane] = s.overlap;
  batch.inverse_mass[lane] = s.inverse_mass;
  batch.inverse_radius[lane] = s.inverse_radius;
  batch.intersection_radius[lane] = s.intersection_radius;
  batch.inverse_distance[lane] = s.inverse_distance;
  batch.arm_loss[lane] = s.arm_loss;
  batch.arm_difference[lane] = s.arm_difference;
  batch.coefficients[lane] = row;
  for (int n = 0; n < Talus::ContactBatch::history_size; n++) batch.history[n][lane] = history[n];
}

inline void put(Talus::ContactBatch &batch, int lane, const Contact &c, int row)
{
  put(batch, lane, state_of(c), remembered(c), row);
}

/// Three numbers side by side.
inline Vector lane_of(const double (*v)[Talus::ContactBatch::width], int lane)
{
  return {v[0][lane], v[1][lane], v[2][lane]};
}

/// What a kernel makes of a contact.
struct KernelResult {
  Triple<double> force, torque_per_radius, twisting_torque;
  Talus::HistoryValues history;
};

inline bool same_bits(const KernelResult &a, const KernelResult &b)
{
  return std::memcmp(&a, &b, sizeof a) == 0;
}

inline Triple<double> plain(const Talus::Vector3<double> &v)
{
  return {v.x, v.y, v.z};
}

inline KernelResult result_in(const Talus::ContactBatch &batch, int lane)
{
  const auto three = [lane](const Lanes &v) {
    return Triple<double>{v[0][lane], v[1][lane], v[2][lane]};
  };
  KernelResult r{
      three(batch.force), three(batch.torque_per_radius), three(batch.twisting_torque), {}};
  for (int n = 0; n < Talus::ContactBatch::history_size; n++) r.history[n] = batch.history[n][lane];
  return r;
}

/// Of what is in one lane of a batch whose other lanes hold whatever they held before.
inline KernelResult run(Talus::ContactBatch &batch, Talus::ContactKernel kernel, int lane,
                        const Talus::ContactCoefficients &row, double dt)
{
  const int begin = lane / Talus::lanes * Talus::lanes, end = begin + Talus::lanes;
  std::fill(batch.coefficients + begin, batch.coefficients + end, 0);
  kernel(batch, begin, end, &row, dt);
  return result_in(batch, lane);
}

}    // namespace reference

#endif
