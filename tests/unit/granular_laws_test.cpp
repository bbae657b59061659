// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of LAMMPS' pair granular, all combinations drawn at random: what one trajectory needs to the last bit, that
// forces are those of the stored energies, and what is known of JKR. (That the numbers are those of LAMMPS is shown by
// the scripts in tests/style.)

#include "law_states.h"
#include "laws/contact_energy.h"
#include "laws/contact_kernel.h"
#include "laws/fused_kernels.h"
#include "laws/intersection_radius.h"
#include "laws/law_list.h"
#include "material/contact_spec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

using namespace Talus;
using reference::KernelResult;
using reference::plain;
using reference::put;
using reference::same_bits;

namespace {

constexpr double dt = 2e-5, pi = 3.14159265358979323846;
constexpr int width = ContactBatch::width;

struct Drawn {
  ContactSpec spec;
  ContactCoefficients row;
  ContactState<double> state;
  HistoryValues history;
};

const char *one_of(RandomSource &random, std::initializer_list<const char *> names)
{
  return names.begin()[random.below(static_cast<int>(names.size()))];
}

ContactSpec random_law(RandomSource &random)
{
  ContactSpec s;
  const auto choose = [&](Stage stage, std::initializer_list<const char *> names) {
    s.law.choose(stage, find_law(stage, one_of(random, names)));
  };
  choose(Stage::NORMAL, {"hooke", "hertz", "dmt", "jkr"});
  if (s.law.normal().cohesive)
    choose(Stage::DAMPING, {"none", "velocity", "mass_velocity", "viscoelastic"});
  else
    choose(Stage::DAMPING,
           {"none", "velocity", "mass_velocity", "viscoelastic", "tsuji", "coeff_restitution"});
  choose(Stage::TANGENTIAL,
         {"linear_nohistory", "linear_history", "linear_history_classic", "mindlin",
          "mindlin/force", "mindlin_rescale", "mindlin_rescale/force", "mindlin_classic"});
  choose(Stage::ROLLING, {"none", "sds"});
  choose(Stage::TWISTING, {"none", "marshall", "sds"});
  auto &given = s.given;
  given["kn"] = random.decade(4.0, 6.0);
  given["E_eff"] = random.decade(5.0, 7.0);
  given["gamma"] = random.chance(0.1) ? 0.0 : random.decade(-1.0, 1.0);
  given["gn"] = random.decade(0.0, 2.0);
  given["eta"] = random.uniform(0.1, 1.0);
  given["kt"] = random.chance(0.1) ? 0.0 : random.decade(4.0, 6.0);
  for (const char *name : {"xt", "mu", "mu_roll", "mu_twist"})
    given[name] = random.uniform(0.0, 1.0);
  for (const char *name : {"k_roll", "k_twist"}) given[name] = random.decade(3.0, 5.0);
  for (const char *name : {"gamma_roll", "gamma_twist"}) given[name] = random.decade(0.0, 2.0);
  if (!s.law.normal().cohesive && random.chance(0.3)) given["limit_damping"] = 1.0;
  return s;
}

/// Of two spheres, 1 to 10 cm; `swapped`: the other one first.
ContactState<double> state_of(const double (&r)[2], const Vector3<double> &n, double overlap,
                              const Vector3<double> (&v)[2], const Vector3<double> (&w)[2],
                              bool swapped)
{
  const int a = swapped ? 1 : 0, b = 1 - a;
  ContactState<double> s;
  s.normal = swapped ? -1.0 * n : n;
  s.overlap = overlap;
  s.velocity = v[a] - v[b];
  s.surface_rotation = swapped ? r[1] * w[1] + r[0] * w[0] : r[0] * w[0] + r[1] * w[1];
  s.relative_omega = w[a] - w[b];
  s.inverse_mass = 1.0 / (r[0] * r[0] * r[0]) + 1.0 / (r[1] * r[1] * r[1]);
  s.inverse_radius = 1.0 / r[0] + 1.0 / r[1];
  s.inverse_distance = 1.0 / (r[0] + r[1] - overlap);
  s.intersection_radius = intersection_radius_of(r[a], r[b], overlap);
  s.arm_loss = overlap / (r[0] + r[1]);
  s.arm_difference = 0.5 * s.arm_loss * (r[b] - r[a]);
  return s;
}

Vector3<double> random_vector(RandomSource &random, double half)
{
  const auto v = random.in_cube(half);
  return {v[0], v[1], v[2]};
}

class GranularLaws : public testing::Test {
 protected:
  GranularLaws() { batch.clear(); }

  void next()
  {
    drawn.spec = random_law(random);
    drawn.row = contact_coefficients(drawn.spec, drawn.spec, FrictionMix::MINIMUM);
    const double smaller = random.uniform(0.01, 0.05),
                 r[2] = {smaller, smaller * random.uniform(1.0, 10.0)};
    const auto n = random.unit_vector();
    const Vector3<double> normal{n[0], n[1], n[2]};
    const Vector3<double> v[2] = {random_vector(random, 0.5), random_vector(random, 0.5)};
    const Vector3<double> w[2] = {random_vector(random, 20.0), random_vector(random, 20.0)};
    const double reach = pulloff_distance_of(drawn.spec.law, drawn.row, r[0], r[1]);
    const double overlap = random.chance(0.3) ? -0.9 * reach : smaller * random.decade(-5.0, -1.0);
    if (overlap <= 0.0 && reach == 0.0) return next();
    drawn.state = state_of(r, normal, overlap, v, w, false);
    other = state_of(r, normal, overlap, v, w, true);
    for (double &value : drawn.history) value = 0.0;
    if (random.chance(0.8)) {
      const double scale = random.decade(-7.0, -3.0);
      for (double &value : drawn.history) value = scale * random.uniform(-1.0, 1.0);
      drawn.history[3] = std::fabs(drawn.history[3]) * 100.0;
    }
  }

  KernelResult run(int lane, const ContactState<double> &s, const HistoryValues &history,
                   bool uniform, bool advance)
  {
    put(batch, lane, s, history, 0);
    return reference::run(batch, contact_kernel(drawn.spec.law, uniform, advance), lane, drawn.row,
                          dt);
  }
  std::string title() const { return describe_law(drawn.spec.law); }

  RandomSource random{22};
  ContactBatch batch;
  Drawn drawn;
  ContactState<double> other;
};

TEST_F(GranularLaws, DoNotDependOnLaneKernelOrPath)
{
  for (int n = 0; n < 3000; n++) {
    next();
    const KernelResult first = run(0, drawn.state, drawn.history, true, true);
    for (int lane = 1; lane < width; lane += 7) {
      const KernelResult again = run(lane, drawn.state, drawn.history, lane % 2 == 0, true);
      ASSERT_TRUE(same_bits(first, again)) << title();
    }
    const KernelResult read = run(5, drawn.state, drawn.history, true, false);
    const ContactLanes<double> query =
        single_contact(drawn.spec.law, drawn.row, drawn.state, dt, drawn.history);
    ASSERT_EQ(plain(query.force), read.force) << title();
    ASSERT_EQ(plain(query.torque_per_radius), read.torque_per_radius) << title();
    ASSERT_EQ(plain(query.twisting_torque), read.twisting_torque) << title();
  }
}

TEST_F(GranularLaws, FusedKernelsAreTheirStages)
{
  int fused = 0;
  for (const ContactLaw &law : fused_laws()) {
    if (!law.tangential().lever_arms) continue;
    fused++;
    ASSERT_FALSE(contact_kernel(law, true, true) == staged_kernel(law, true, true));
    for (int n = 0; n < 2000; n++) {
      const ContactSpec numbers = random_law(random);
      ContactSpec spec{law, numbers.given};
      const ContactCoefficients row = contact_coefficients(spec, spec, FrictionMix::MINIMUM);
      for (int lane = 0; lane < width; lane++) {
        next();
        if (!law.normal().lasts_beyond_contact)
          drawn.state.overlap = std::fabs(drawn.state.overlap);
        put(batch, lane, drawn.state, drawn.history, 0);
      }
      ContactBatch staged = batch;
      const int end = lanes * (1 + n % (width / lanes));
      contact_kernel(law, true, true)(batch, 0, end, &row, dt);
      staged_kernel(law, true, true)(staged, 0, end, &row, dt);
      ASSERT_EQ(std::memcmp(batch.force, staged.force, sizeof batch.force), 0) << describe_law(law);
      ASSERT_EQ(std::memcmp(batch.torque_per_radius, staged.torque_per_radius,
                            sizeof batch.torque_per_radius),
                0)
          << describe_law(law);
      ASSERT_EQ(std::memcmp(batch.twisting_torque, staged.twisting_torque,
                            sizeof batch.torque_per_radius),
                0);
      ASSERT_EQ(std::memcmp(batch.history, staged.history, sizeof batch.history), 0)
          << describe_law(law);
    }
  }
  EXPECT_EQ(fused, 5);
}

// A run that stops and starts again computes the force of its last step from what is stored.
TEST_F(GranularLaws, ForceIsReproducedFromTheStoredHistory)
{
  int with_history = 0;
  for (int n = 0; n < 20000; n++) {
    next();
    const KernelResult before = run(n % width, drawn.state, drawn.history, true, true);
    with_history += drawn.spec.law.has_history();
    const KernelResult after = run((n + 3) % width, drawn.state, before.history, false, false);
    ASSERT_TRUE(same_bits(before, after)) << title() << " " << n;
  }
  EXPECT_GT(with_history, 10000);
}

TEST_F(GranularLaws, SwappingTheBodiesNegatesForceAndTorqueExactly)
{
  for (int n = 0; n < 20000; n++) {
    next();
    HistoryValues mirrored = drawn.history;
    for (int d = 0; d < 3; d++) mirrored[d] = -mirrored[d];
    const KernelResult a = run(n % width, drawn.state, drawn.history, true, true);
    const KernelResult b = run((n + 11) % width, other, mirrored, true, true);
    for (int d = 0; d < 3; d++) {
      ASSERT_EQ(a.force[d], -b.force[d]) << title();
      ASSERT_EQ(a.torque_per_radius[d], b.torque_per_radius[d]) << title();
      ASSERT_EQ(a.twisting_torque[d], -b.twisting_torque[d]) << title();
      ASSERT_EQ(a.history[d], -b.history[d]) << title();
    }
    for (int k = 3; k < ContactBatch::history_size; k++)
      ASSERT_EQ(a.history[k], b.history[k]) << title();
  }
}

// Lever arms: the torques on both bodies are those of the force at the middle of the overlap.
TEST_F(GranularLaws, FrictionActsInTheMiddleOfTheOverlap)
{
  for (int n = 0; n < 5000; n++) {
    next();
    drawn.spec.law.choose(Stage::ROLLING, find_law(Stage::ROLLING, "none"));
    drawn.spec.law.choose(Stage::TWISTING, find_law(Stage::TWISTING, "none"));
    drawn.row = contact_coefficients(drawn.spec, drawn.spec, FrictionMix::MINIMUM);
    const ContactState<double> &s = drawn.state;
    const ContactLanes<double> out =
        single_contact(drawn.spec.law, drawn.row, s, dt, drawn.history);
    const double sum = 1.0 / s.inverse_distance + s.overlap;
    const double r1 = 0.5 * (sum - s.arm_difference / (0.5 * s.arm_loss)), r2 = sum - r1;
    const Vector3<double> torque_per_radius = cross(s.normal, out.tangential);
    const Vector3<double> on_first = -r1 * out.torque_per_radius + out.twisting_torque,
                          on_second = -r2 * out.torque_per_radius - out.twisting_torque;
    const Vector3<double> errors[] = {on_first + (r1 - 0.5 * s.overlap) * torque_per_radius,
                                      on_second + (r2 - 0.5 * s.overlap) * torque_per_radius};
    const double size = std::sqrt(dot(torque_per_radius, torque_per_radius)) * sum;
    for (const auto &error : errors)
      ASSERT_LE(std::sqrt(dot(error, error)), 1e-11 * size) << title();
  }
}

/// Energy of the normal law at an overlap, and its elastic force.
ContactLanes<double> at_overlap(const ContactSpec &spec, const ContactCoefficients &row,
                                double radius, double overlap)
{
  ContactState<double> s;
  s.normal = {1.0, 0.0, 0.0};
  s.overlap = overlap;
  s.inverse_mass = 1.0;
  s.inverse_radius = 1.0 / radius;
  return single_contact(spec.law, row, s, 0.0);
}

TEST_F(GranularLaws, NormalForceAndStiffnessAreDerivativesOfTheEnergy)
{
  for (const char *name : {"hooke", "hertz", "dmt", "jkr"})
    for (int n = 0; n < 300; n++) {
      ContactSpec spec = random_law(random);
      spec.law.choose(Stage::NORMAL, find_law(Stage::NORMAL, name));
      spec.law.choose(Stage::DAMPING, find_law(Stage::DAMPING, "none"));
      const ContactCoefficients row = contact_coefficients(spec, spec, FrictionMix::MINIMUM);
      const double radius = 0.02,
                   reach = pulloff_distance_of(spec.law, row, 2.0 * radius, 2.0 * radius);
      const double overlap = random.uniform(-0.9 * reach, 0.1 * radius),
                   h = 1e-5 * (overlap + reach);
      if (overlap - h <= 0.0 && reach == 0.0) continue;
      const auto energy = [&](double d) {
        const ContactLanes<double> s = at_overlap(spec, row, radius, d);
        return spec.law.normal().stored(s, spec.law.coefficients(Stage::NORMAL, row), nullptr);
      };
      const auto force = [&](double d) { return at_overlap(spec, row, radius, d).elastic; };
      const ContactLanes<double> s = at_overlap(spec, row, radius, overlap);
      const double scale = std::fabs(s.elastic) + s.kn * (std::fabs(overlap) + reach);
      ASSERT_NEAR((energy(overlap + h) - energy(overlap - h)) / (2.0 * h), s.elastic, 2e-5 * scale)
          << name;
      const double slope = (force(overlap + h) - force(overlap - h)) / (2.0 * h);
      ASSERT_NEAR(s.tangent_n, slope, 1e-4 * std::fabs(slope) + 1e-4 * s.kn)
          << name << " " << overlap << " " << reach;
    }
}

// Johnson, Kendall and Roberts: the strongest pull is 3 pi gamma R, at reach(), where the bodies separate; at overlap
// zero it is 8/9 of that.
TEST_F(GranularLaws, JkrPullsOffWith3PiGammaR)
{
  for (int n = 0; n < 100; n++) {
    ContactSpec spec;
    spec.law.choose(Stage::NORMAL, find_law(Stage::NORMAL, "jkr"));
    spec.law.choose(Stage::DAMPING, find_law(Stage::DAMPING, "none"));
    spec.given["E_eff"] = random.decade(5.0, 9.0);
    const double gamma = spec.given["gamma"] = random.decade(-2.0, 1.0);
    const ContactCoefficients row = contact_coefficients(spec, spec, FrictionMix::MINIMUM);
    const double radius = random.decade(-4.0, -1.0),
                 reach = pulloff_distance_of(spec.law, row, 2.0 * radius, 2.0 * radius);
    const double pulloff_force = 3.0 * pi * gamma * radius;
    double strongest = 0.0;
    for (int k = 0; k <= 20000; k++)
      strongest =
          std::min(strongest, at_overlap(spec, row, radius, (k / 20000.0 - 1.0) * reach).elastic);
    EXPECT_NEAR(-strongest, pulloff_force, 1e-7 * pulloff_force);
    EXPECT_NEAR(-at_overlap(spec, row, radius, 0.0).elastic, 8.0 / 9.0 * pulloff_force,
                1e-12 * pulloff_force);
    EXPECT_NEAR(-at_overlap(spec, row, radius, -reach).elastic, pulloff_force,
                1e-7 * pulloff_force);
  }
}

}    // namespace
