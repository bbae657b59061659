// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The kernels drive two spheres along the trajectories that Project Chrono printed (tests/ref/chrono-golden.txt):
// all laws, tangential modes and kinds of coefficients. Where Talus differs on purpose the test follows Chrono:
// rolling and spinning resistance are delayed, material and effective moduli are in single precision, coefficients of
// hertz and flores take sqrt(R) from Chrono's factor R sqrt(overlap) (ours: sqrt(R overlap)), the friction of mode None
// vanishes above the Coulomb limit, and the age of a PlainCoulomb contact counts in mode MultiStep.

#include "material/contact_spec.h"
#include "two_spheres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

using namespace Talus;
using namespace named;
using namespace reference;

namespace {

constexpr double tolerance = 1e-9;    // the file has 12 digits

/// One line of the file: x, v, omega, force of both bodies.
struct Snapshot {
  int step;
  Triple state[2][4];
};

struct Case {
  std::string law, mode, kind, adhesion;
  std::vector<Snapshot> snapshots;
};

std::vector<Case> read_cases()
{
  std::vector<Case> cases;
  const char *source = std::getenv("TALUS_SOURCE_DIR");
  std::ifstream file(std::string(source ? source : ".") + "/tests/ref/chrono-golden.txt");
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    if (first.empty() || first == "#") continue;
    if (first == "CASE") {
      Case c;
      words >> c.law >> c.mode >> c.kind >> c.adhesion;
      cases.push_back(c);
      continue;
    }
    Snapshot s;
    s.step = std::stoi(first);
    for (auto &body : s.state)
      for (Triple &vector : body)
        for (double &number : vector) words >> number;
    EXPECT_TRUE(words) << line;
    cases.back().snapshots.push_back(s);
  }
  return cases;
}

NamedLaw law_of(const Case &c)
{
  NamedLaw law;
  const char *const names[] = {"Hooke", "Hertz", "Flores", "PlainCoulomb"};
  const auto n = std::find(std::begin(names), std::end(names), c.law) - std::begin(names);
  law.normal = static_cast<Normal>(n + (c.kind == "props" ? 4 : 0));
  law.tangential = c.law == "PlainCoulomb" ? Tangential::TANH
                   : c.mode == "None"      ? Tangential::DASHPOT
                   : c.mode == "OneStep"   ? Tangential::ONESTEP
                                           : Tangential::MULTISTEP;
  law.resists = law.delayed = true;
  law.adhesion = c.adhesion == "Constant" ? Adhesion::CONSTANT : Adhesion::DMT;
  return law;
}

/// Material 0 or 1 of the scene, in single precision.
ContactSpec material(const Case &c, int which)
{
  const auto pick = [=](float a, float b) { return static_cast<double>(which == 0 ? a : b); };
  ContactSpec s;
  s.law = law_of(c);
  GivenNumbers &given = s.given;
  given["mu"] = pick(0.3F, 0.4F);
  given["mu_r"] = pick(0.04F, 0.05F);
  given["mu_s"] = pick(0.06F, 0.03F);
  if (c.adhesion == "Constant") given["adhesive force"] = pick(2.0F, 3.0F);
  if (c.adhesion == "DMT") given["adhesion W"] = pick(8.0F, 7.0F);
  given["slip_min"] = given["roll_min"] = given["twist_min"] = 1e-4;
  if (c.kind == "props") {
    given["E"] = pick(2e4F, 3e4F);
    given["nu"] = pick(0.3F, 0.25F);
    given["e"] = pick(0.6F, 0.5F);
    given["vchar"] = 0.4;
    return s;
  }
  given["kn"] = pick(2e3F, 3e3F);
  given["kt"] = pick(1e3F, 2e3F);
  given["gn"] = pick(4.0F, 8.0F);
  given["gt"] = pick(5.0F, 3.0F);
  return s;
}

/// Effective moduli in single precision.
float single_young()
{
  const float y1 = 2e4F, y2 = 3e4F, nu1 = 0.3F, nu2 = 0.25F;
  return 1 / ((1 - nu1 * nu1) / y1 + (1 - nu2 * nu2) / y2);
}
float single_shear()
{
  const float y1 = 2e4F, y2 = 3e4F, nu1 = 0.3F, nu2 = 0.25F;
  return 1 / (2 * (2 - nu1) * (1 + nu1) / y1 + 2 * (2 - nu2) * (1 + nu2) / y2);
}

class Scene : public TwoSpheres {
 public:
  explicit Scene(const Case &c) :
      TwoSpheres({0.3, 1.2, {0.1, -0.2, 0.05}, {0.3, 0.5, 0.1}, {1.0, -2.0, 0.5}},
                 {0.5, 2.5, {}, {-0.2, -0.3, -0.4}, {-0.7, 0.3, 1.5}}),
      frictionless_above_limit(c.mode == "None" && c.law != "PlainCoulomb"),
      ages(c.mode == "MultiStep" && c.law == "PlainCoulomb")
  {
    body[1].x = body[0].x + 0.801 * Triple{0.48, 0.6, 0.64};
    gravity = {0.0, 0.0, -1.0};
    dt = 1e-4;
    law = law_of(c);
    coefficients =
        numbers_of(law, contact_coefficients(material(c, 0), material(c, 1), FrictionMix::MINIMUM));
    if (c.kind == "props") {
      EXPECT_NEAR(coefficients.kn, single_young(), 3e-7 * coefficients.kn);
      coefficients.kn = single_young();
      if (law.normal == Normal::HERTZ_MATERIAL || law.normal == Normal::FLORES_MATERIAL) {
        EXPECT_NEAR(coefficients.kt, single_shear(), 3e-7 * coefficients.kt);
        coefficients.kt = single_shear();
      }
    }
    if (law.normal != Normal::HERTZ && law.normal != Normal::FLORES) return;
    for (double *k : {&coefficients.kn, &coefficients.gn, &coefficients.kt, &coefficients.gt})
      *k *= std::sqrt(effective_radius());
  }

  void step()
  {
    compute();
    if (ages && is_old()) resist();
    if (frictionless_above_limit && exceeds_limit()) {
      steps_above_limit++;
      const double mu = coefficients.mu;
      coefficients.mu = 0.0;
      compute();
      coefficients.mu = mu;
    }
    resisted = resisted || norm(Triple{batch.twisting_torque[0][0], batch.twisting_torque[1][0],
                                       batch.twisting_torque[2][0]}) > 0.0;
    move();
  }

  int steps_above_limit = 0;
  bool resisted = false;

 private:
  Triple contact_normal() const { return (1.0 / norm(separation())) * separation(); }
  Triple contact_force() const { return {batch.force[0][0], batch.force[1][0], batch.force[2][0]}; }

  /// F_n of the last compute(), without adhesion.
  double normal_force() const
  {
    const double per_root = law.adhesion == Adhesion::DMT ? std::sqrt(effective_radius()) : 1.0;
    return inner(contact_force(), contact_normal()) + coefficients.adhesion * per_root;
  }

  /// The friction of mode None reaches the limit.
  bool exceeds_limit() const
  {
    const Triple f = contact_force(), n = contact_normal();
    return overlap() > 0.0 &&
           norm(f - inner(f, n) * n) > coefficients.mu * std::fabs(normal_force()) * (1.0 - 1e-12);
  }

  /// Resistance of a contact that is old enough; our law without memory waits for ever.
  void resist()
  {
    const auto vector = [](const Triple &t) { return Vector3<double>{t[0], t[1], t[2]}; };
    ContactLanes<double> s;
    s.normal = vector(contact_normal());
    s.surface_rotation = vector(body[0].radius * body[0].omega + body[1].radius * body[1].omega);
    s.relative_omega = vector(body[0].omega - body[1].omega);
    s.intersection_radius = batch.intersection_radius[0];
    s.delayed_force = normal_force();
    const ContactLaw first_order = law;
    const ContactCoefficients row = row_of(first_order, coefficients);
    for (Stage stage : {Stage::ROLLING, Stage::TWISTING})
      first_order[stage].one(s, first_order.coefficients(stage, row), nullptr, dt);
    const double torque_per_radius[3] = {s.torque_per_radius.x, s.torque_per_radius.y,
                                         s.torque_per_radius.z},
                 twisting_torque[3] = {s.twisting_torque.x, s.twisting_torque.y,
                                       s.twisting_torque.z};
    for (int d = 0; d < 3; d++) {
      batch.torque_per_radius[d][0] += torque_per_radius[d];
      batch.twisting_torque[d][0] += twisting_torque[d];
    }
  }

  /// A PlainCoulomb contact with coefficients has lasted one collision time.
  bool is_old()
  {
    if (overlap() <= 0.0) begun = false;
    if (overlap() <= 0.0) return false;
    age = begun ? age + dt : 0.0;
    begun = true;
    const double m = effective_mass(), k = coefficients.kn,
                 g = coefficients.gn * std::pow(overlap(), 0.25);
    const double d = g / (2.0 * m * std::sqrt(k / m));
    return d >= 1.0 || age > std::acos(-1.0) * std::sqrt(m / (k * (1.0 - d * d)));
  }

  const bool frictionless_above_limit, ages;
  bool begun = false;
  double age = 0.0;
};

TEST(ChronoGolden, TrajectoriesAgree)
{
  const std::vector<Case> cases = read_cases();
  ASSERT_EQ(cases.size(), 20U) << "TALUS_SOURCE_DIR must name the source tree";
  std::cout
      << "largest deviation relative to the length of each vector\n"
      << "case                                   x        v        omega    force    remarks\n";
  for (const Case &c : cases) {
    ASSERT_EQ(c.snapshots.back().step, 1200);
    Scene scene(c);
    double worst[4] = {};
    int step = 0, in_contact = 0;
    for (const Snapshot &s : c.snapshots) {
      for (; step < s.step; step++) scene.step();
      in_contact += norm(s.state[0][3]) > 0.0;
      for (int b = 0; b < 2; b++) {
        const Sphere &body = scene.body[b];
        const Triple found[4] = {body.x, body.v, body.omega, body.force};
        for (int q = 0; q < 4; q++) {
          const double size = norm(s.state[b][q]), off = norm(found[q] - s.state[b][q]);
          worst[q] = std::max(worst[q], off > 0.0 ? off / size : 0.0);
        }
      }
    }
    const std::string name = c.law + " " + c.mode + " " + c.kind + " " + c.adhesion;
    std::cout << std::left << std::setw(38) << name << std::scientific << std::setprecision(1);
    for (double w : worst) std::cout << " " << w << " ";
    std::cout << (scene.resisted ? " resists" : "");
    if (scene.steps_above_limit)
      std::cout << " " << scene.steps_above_limit << " steps above the limit";
    std::cout << "\n";
    EXPECT_GE(in_contact, 12) << name;
    for (double w : worst) EXPECT_LE(w, tolerance) << name;
  }
}

}    // namespace
