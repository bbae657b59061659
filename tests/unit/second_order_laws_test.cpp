// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of second order against the twin that shares no code with them, over whole impacts of
// two spheres and of a sphere and a plane: every step makes the same forces.

#include "second_order_twin.h"

#include "base/words.h"
#include "laws/circle_of_intersection.h"
#include "laws/contact_words.h"
#include "laws/second_order_laws.h"
#include "laws/tangential/end_of_contact.h"
#include "material/contact_spec.h"
#include "material/law_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Talus::ContactBatch;

Talus::ContactSpec spec_of(const std::string &words)
{
  std::vector<std::string> list;
  std::istringstream stream(words);
  for (std::string word; stream >> word;) list.push_back(word);
  std::vector<const char *> arg;
  for (const std::string &word : list) arg.push_back(word.c_str());
  Talus::Words reader("law", static_cast<int>(arg.size()), arg.data(), 0,
                      [](int, const std::string &text) { throw std::runtime_error(text); });
  return Talus::parse_contact(reader, 1.0);
}

struct Kernels {
  Talus::ContactLaw law;
  Talus::ContactCoefficients row;
  Talus::ContactKernel advancing, reading;

  explicit Kernels(const std::string &words)
  {
    Talus::ContactSpec spec = spec_of(words);
    const auto mixed = [&spec] {
      return Talus::contact_coefficients(spec, spec, Talus::FrictionMix::MINIMUM);
    };
    EXPECT_EQ(Talus::reason_against_second_order(spec.law, mixed()), "");
    spec.law = Talus::second_order_law(spec.law);
    law = spec.law;
    row = mixed();
    advancing = Talus::contact_kernel(law, true, true);
    reading = Talus::contact_kernel(law, true, false);
  }
};

/// The leapfrog of the integrator, with the laws of the engine; the second body may be a plane.
class Impact {
 public:
  Impact(const Kernels &its, const Twin::System &start, double time, int steps) :
      kernels(its), gravity(start.gravity), particles(start.particles), planes(start.planes),
      dt(time / steps)
  {
    batch.clear();
    compute(false);
    for (int n = 0; n < steps; n++) {
      step();
      compute(true);
      repeat();
    }
    finish();
  }

  const std::vector<Twin::Particle> &result() const { return particles; }

 private:
  void step()
  {
    const double kick = lag + 0.5 * dt;
    lag = 0.5 * dt;
    for (Twin::Particle &p : particles) {
      p.v = p.v + kick * p.a;
      p.w = p.w + kick * p.alpha;
      p.x = p.x + dt * p.v;
    }
  }

  void finish()
  {
    for (Twin::Particle &p : particles) {
      p.v = p.v + lag * p.a;
      p.w = p.w + lag * p.alpha;
    }
  }

  static void set(double (&lanes)[3][ContactBatch::width], Twin::Vec v)
  {
    lanes[0][0] = v.x;
    lanes[1][0] = v.y;
    lanes[2][0] = v.z;
  }
  static Twin::Vec get(const double (&lanes)[3][ContactBatch::width])
  {
    return {lanes[0][0], lanes[1][0], lanes[2][0]};
  }

  void compute(bool advance)
  {
    const Twin::Particle &i = particles[0];
    const Twin::Particle none{};
    const Twin::Particle &j = planes.empty() ? particles[1] : none;
    const double rj = planes.empty() ? j.radius : 0.0;
    const Twin::Vec r = planes.empty()
                            ? i.x - j.x
                            : dot(i.x - planes[0].point, planes[0].normal) * planes[0].normal;
    const double distance = length(r), overlap = i.radius + rj - distance;
    Twin::Vec force{}, moment{}, twist{};
    const bool lasts = overlap > 0.0 || Talus::has_just_ended(batch.history[3][0], advance);
    if (lasts) {
      set(batch.normal, (1.0 / distance) * r);
      set(batch.velocity, i.v - j.v);
      set(batch.surface_rotation, i.radius * i.w + rj * j.w);
      set(batch.velocity_change, lag * (i.a - j.a));
      set(batch.rotation_change, lag * (i.radius * i.alpha + rj * j.alpha));
      set(batch.relative_omega, i.w - j.w);
      set(batch.omega_change, lag * (i.alpha - j.alpha));
      const double sum = i.radius + rj, in_plane = 2.0 * i.radius * overlap - overlap * overlap;
      batch.arm_loss[0] = planes.empty() ? overlap / sum : 0.0;
      batch.arm_difference[0] = 0.5 * batch.arm_loss[0] * (rj - i.radius);
      batch.circle[0] = planes.empty() ? Talus::circle_of_intersection(i.radius, rj, overlap)
                                       : std::sqrt(std::max(in_plane, 0.0));
      batch.lag = lag;
      batch.overlap[0] = its_overlap = overlap;
      batch.inverse_mass[0] = 1.0 / i.mass + (planes.empty() ? 1.0 / j.mass : 0.0);
      batch.inverse_radius[0] = 1.0 / i.radius + (planes.empty() ? 1.0 / j.radius : 0.0);
      batch.inverse_distance[0] = planes.empty() ? 1.0 / distance : 0.0;
      (advance ? kernels.advancing : kernels.reading)(batch, 0, Talus::lanes, &kernels.row, dt);
      force = get(batch.force);
      moment = get(batch.moment);
      if (kernels.law.twists()) twist = get(batch.twisting_torque);
    } else
      for (auto &value : batch.history) value[0] = 0.0;
    touched = lasts;
    for (std::size_t n = 0; n < particles.size(); n++) {
      Twin::Particle &p = particles[n];
      p.a = gravity + (n == 0 ? 1.0 : -1.0) / p.mass * force;
      p.alpha = 1.0 / p.inertia() * ((n == 0 ? 1.0 : -1.0) * twist - p.radius * moment);
    }
  }

  /// A set-up at this point finds the same force, bit for bit, and leaves the history alone.
  void repeat()
  {
    if (!touched) return;
    const ContactBatch before = batch;
    batch.overlap[0] = its_overlap;
    kernels.reading(batch, 0, Talus::lanes, &kernels.row, dt);
    for (int d = 0; d < 3; d++) {
      EXPECT_EQ(batch.force[d][0], before.force[d][0]);
      EXPECT_EQ(batch.moment[d][0], before.moment[d][0]);
      EXPECT_EQ(batch.twisting_torque[d][0], before.twisting_torque[d][0]);
    }
    for (int n = 0; n < ContactBatch::history_size; n++)
      EXPECT_EQ(batch.history[n][0], before.history[n][0]);
  }

  const Kernels &kernels;
  Twin::Vec gravity;
  std::vector<Twin::Particle> particles;
  std::vector<Twin::Plane> planes;
  ContactBatch batch;
  double dt, lag = 0.0, its_overlap = 0.0;
  bool touched = false;
};

Twin::Particle sphere(Twin::Vec x, Twin::Vec v, Twin::Vec w, double radius)
{
  Twin::Particle p;
  p.x = x;
  p.v = v;
  p.w = w;
  p.radius = radius;
  p.mass = 4.0 / 3.0 * 3.14159265358979323846 * radius * radius * radius;
  return p;
}

Twin::System pair()
{
  Twin::System start;
  start.particles = {sphere({-0.505, -0.1, 0.05}, {0.5, 0.4, 0.1}, {1, 2, -3}, 0.5),
                     sphere({0.405, 0.1, -0.02}, {-0.5, -0.4, 0.2}, {-2, 0.5, 1.5}, 0.4)};
  return start;
}

Twin::System on_plane()
{
  Twin::System start;
  start.gravity = {0, 0, -9.81};
  start.planes = {{{0, 0, 0}, {0, 0, 1}}};
  start.particles = {sphere({0, 0, 0.51}, {0.3, 0.1, -0.5}, {0, 3, 1}, 0.5)};
  return start;
}

void expect_same(Twin::System start, const Twin::Law &law, const std::string &words)
{
  SCOPED_TRACE(words);
  constexpr double time = 0.12;
  const Kernels kernels(words);
  for (int steps : {60, 61, 157, 400}) {
    const Impact engine(kernels, start, time, steps);
    Twin::System twin = start;
    twin.law = law;
    twin.run(time, steps);
    for (std::size_t n = 0; n < start.particles.size(); n++) {
      const Twin::Particle &a = engine.result()[n], &b = twin.particles[n];
      // zeta is a polynomial here, to 4e-8 of the force of one step
      EXPECT_LT(length(a.x - b.x), 1e-9) << steps;
      EXPECT_LT(length(a.v - b.v), 1e-8) << steps;
      EXPECT_LT(length(a.w - b.w), 1e-7) << steps;
    }
  }
}

void expect_same(const Twin::Law &law, const std::string &words)
{
  expect_same(pair(), law, words);
  expect_same(on_plane(), law, words);
}

Twin::Law numbers(bool hertz, double kn, double gn, double mu)
{
  Twin::Law law;
  law.hertz = hertz;
  law.damping = hertz ? Twin::Damping::RADIUS : Twin::Damping::MASS;
  law.kn = kn;
  law.gn = gn;
  law.kt = 2.0 / 7.0 * kn;
  law.gt = 0.5 * gn;
  law.mu = mu;
  return law;
}

}    // namespace

TEST(SecondOrderLaws, AreThoseOfTheTwin)
{
  expect_same(numbers(false, 2e4, 80, 0.3),
              "hooke 2e4 80 tangential multistep NULL NULL 0.3 slider midpoint limit_damping");
  expect_same(numbers(true, 1.75e5, 400, 0.3),
              "hertz 1.75e5 400 tangential multistep NULL NULL 0.3 slider midpoint limit_damping");
  expect_same(numbers(true, 1.75e5, 400, 5.0),
              "hertz 1.75e5 400 tangential multistep NULL NULL 5 slider midpoint limit_damping");
  Twin::Law stiff = numbers(true, 1.75e5, 80, 0.3);
  stiff.damping = Twin::Damping::MASS;
  expect_same(stiff, "hertz 1.75e5 80 damping mass_velocity tangential multistep NULL NULL 0.3 "
                     "slider midpoint limit_damping");
  expect_same(numbers(true, 1.75e5, 0, 0.2),
              "hertz 1.75e5 0 tangential multistep NULL 0 0.2 slider midpoint");
  expect_same(numbers(false, 2e4, 80, 0.0), "hooke 2e4 80 limit_damping");
  expect_same(numbers(true, 1.75e5, 400, 0.0), "hertz 1.75e5 400 limit_damping");
}

TEST(SecondOrderLaws, WithAdhesion)
{
  for (double mu : {0.0, 0.3}) {
    Twin::Law law = numbers(true, 1.75e5, 400, mu);
    law.adhesion = 3.0;
    const std::string friction =
        mu > 0.0 ? " tangential multistep NULL NULL 0.3 slider midpoint" : "";
    expect_same(law, "hertz 1.75e5 400" + friction + " adhesion constant 3 limit_damping");
    law = numbers(false, 2e4, 0, mu);
    law.adhesion = 3.0;
    expect_same(law, "hooke 2e4 0" + friction + " adhesion constant 3");
  }
}

TEST(SecondOrderLaws, WithResistanceToRollingAndSpinning)
{
  for (double mu : {0.02, 0.1, 0.3}) {
    const std::string resistance =
        " rolling " + std::to_string(mu) + " spinning " + std::to_string(mu) + " limit_damping";
    Twin::Law law = numbers(true, 1.75e5, 400, 0.3);
    law.resistance.mu_r = law.resistance.mu_s = mu;
    expect_same(law,
                "hertz 1.75e5 400 tangential multistep NULL NULL 0.3 slider midpoint" + resistance);
    law = numbers(false, 2e4, 80, 0.0);
    law.resistance.mu_r = law.resistance.mu_s = mu;
    expect_same(law, "hooke 2e4 80" + resistance);
  }
}

TEST(SecondOrderLaws, WithDampingOfTheStiffness)
{
  Twin::Law law = numbers(true, 0, 0, 0.4);
  const double young = 1e5, nu = 0.3;
  law.damping = Twin::Damping::ROOT;
  law.kn = 4.0 / 3.0 * young / (2.0 * (1.0 - nu * nu));
  law.kt = 8.0 * young / (4.0 * (2.0 - nu) * (1.0 + nu));
  const Kernels kernels("hertz/material 1e5 0.6 0.3 tangential multistep NULL NULL 0.4 slider "
                        "midpoint limit_damping");
  law.gn = law.gt = kernels.law.coefficients(Talus::Stage::DAMPING, kernels.row)[0];
  expect_same(law, "hertz/material 1e5 0.6 0.3 tangential multistep NULL NULL 0.4 slider midpoint "
                   "limit_damping");
}

TEST(SecondOrderLaws, OthersAreRefusedWithTheCure)
{
  const auto reason = [](const std::string &words) {
    const Talus::ContactSpec spec = spec_of(words);
    return Talus::reason_against_second_order(
        spec.law, Talus::contact_coefficients(spec, spec, Talus::FrictionMix::MINIMUM));
  };
  const auto expect_cure = [&](const std::string &words, const std::string &part) {
    EXPECT_NE(reason(words).find(part), std::string::npos) << words << ": " << reason(words);
  };
  expect_cure("hooke 2e4 80", "limit_damping");
  EXPECT_EQ(reason("hooke 2e4 0"), "");
  EXPECT_EQ(reason("hooke 2e4 0 damping none"), "");
  EXPECT_EQ(reason("hertz/material 1e5 1 0.3"), "");
  const std::string limit = " limit_damping";
  expect_cure("hooke 2e4 80 tangential multistep NULL NULL 0.3" + limit, "slider midpoint");
  expect_cure("hertz/material 2e4 0.8 0.3 tangential multistep NULL NULL 0.3 stock" + limit,
              "gt = 0");
  expect_cure("hooke 2e4 0.6 damping tsuji tangential multistep NULL NULL 0.3 midpoint" + limit,
              "slider midpoint");
  EXPECT_EQ(reason("hooke 2e4 80 tangential multistep NULL 0 0.3 midpoint" + limit), "");
  EXPECT_EQ(reason("hooke 2e4 80 tangential multistep NULL NULL 0.3 slider" + limit), "");
  EXPECT_EQ(reason("hooke 2e4 80 tangential dashpot NULL 0.3" + limit), "");
  EXPECT_EQ(reason("plaincoulomb 2e4 80 0.3" + limit), "");
  expect_cure("hooke 2e4 80 tangential linear_history 1e3 1 0.3" + limit, "xt = 0");
  EXPECT_EQ(reason("hooke 2e4 80 tangential linear_history 1e3 0 0.3" + limit), "");
  EXPECT_EQ(reason("hooke 2e4 0 tangential linear_history 1e3 1 0.3"), "");
  expect_cure("hooke 2e4 0 tangential mindlin/force 1e3 0 0.3", "mindlin/force");
  expect_cure("hooke 2e4 0 tangential onestep 1e3 0 0.3", "slider midpoint");
  EXPECT_EQ(reason("hertz 2e4 0 rolling 0.1 spinning 0.1"), "");
  expect_cure("hertz 2e4 0 rolling 0.1 delayed", "delayed");
  expect_cure("hertz 2e4 0 rolling 0.1 vmin 0 1e-4 0", "vmin");
  EXPECT_EQ(reason("hertz 2e4 0 adhesion constant 1"), "");
  EXPECT_EQ(reason("dmt 1e5 0 0.3 1"), "");
  EXPECT_EQ(reason("dmt 1e5 1 0.3 1 damping none"), "");
  expect_cure("dmt 1e5 1 0.3 1", "adhesion perko");
  expect_cure("jkr 1e5 0 0.3 1", "adhesion constant");
  expect_cure("flores 1e5 1 tangential multistep NULL 1 0.3 slider midpoint", "limit_damping");
  EXPECT_EQ(reason("hertz 2e4 0 heat radius 1"), "");
  const std::string friction = " tangential multistep NULL NULL 0.3 slider midpoint limit_damping";
  EXPECT_EQ(reason("hertz 2e4 1 damping mass_velocity" + friction), "");
  EXPECT_EQ(reason("hooke 2e4 1 damping velocity" + friction), "");
}
