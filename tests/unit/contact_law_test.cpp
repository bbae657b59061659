// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Every kernel against the slow reference: forces, torques and histories of random contacts,
// ordinary and degenerate. Errors are measured relative to the sum of the magnitudes of the terms
// that make a result (Outcome::force_scale, history_scale): a small difference of large terms
// cannot be better than these.

#include "random_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

using namespace Talus;
using namespace named;
using slow::Contact;
using slow::Outcome;
using slow::Vector;

namespace {

constexpr double tolerance = 1e-13;
constexpr int num_batches = 100000 / ContactBatch::width + 1;
constexpr int num_rows = 16;

/// What the states of a test covered, to be sure that no case is missing.
struct Coverage {
  int contacts = 0, sliding = 0, sticking = 0, attractive = 0, floored = 0;
};

double error_of(const Vector &found, const Vector &expected, double scale)
{
  double worst = 0.0;
  for (int d = 0; d < 3; d++) {
    const double off = std::fabs(found[d] - expected[d]);
    if (!(off <= 0.0)) worst = std::max(worst, scale > 0.0 ? off / scale : slow::infinity);
    if (!std::isfinite(found[d])) return slow::infinity;
  }
  return worst;
}

/// Largest relative error of one lane.
double error_of_lane(const ContactBatch &batch, int lane, const Contact &c, const Outcome &expected,
                     NamedLaw law)
{
  double worst = error_of(slow::lane_of(batch.force, lane), expected.force, expected.force_scale);
  if (law.has_friction()) {
    const Vector torque_per_radius = slow::lane_of(batch.torque_per_radius, lane);
    for (int b = 0; b < 2; b++) {
      const double r = c.radius[b];
      const Vector torque{-r * torque_per_radius[0], -r * torque_per_radius[1],
                          -r * torque_per_radius[2]};
      worst = std::max(worst, error_of(torque, expected.torque[b], r * expected.force_scale));
    }
  }
  const Vector history = slow::lane_of(batch.history, lane);
  worst = std::max(worst, error_of(history, expected.history, expected.history_scale));
  if (expected.clear_case && (batch.history[3][lane] > 0.0) != expected.sliding)
    return slow::infinity;
  return worst;
}

std::string describe(const Contact &c, const Outcome &expected, const ContactBatch &batch, int lane)
{
  std::ostringstream text;
  text << std::setprecision(17) << "overlap " << c.overlap << " masses " << c.mass[0] << " "
       << c.mass[1] << " radii " << c.radius[0] << " " << c.radius[1] << "\n";
  for (int d = 0; d < 3; d++)
    text << "force " << batch.force[d][lane] << " expected " << expected.force[d] << " history "
         << batch.history[d][lane] << " expected " << expected.history[d] << " was " << c.history[d]
         << "\n";
  return text.str();
}

void count(Coverage &seen, const Contact &c, const Outcome &expected, const Numbers &p)
{
  const double f_n = expected.normal_force;
  const Vector f_t = slow::axpy(-f_n, c.normal, expected.force);
  const double limit = p.mu * std::fabs(f_n), size = slow::norm(f_t);
  seen.contacts++;
  if (limit > 0.0) (size > (1.0 - 1e-9) * limit ? seen.sliding : seen.sticking)++;
  if (f_n < 0.0) seen.attractive++;
  if (f_n == 0.0 && c.overlap > 0.0) seen.floored++;
}

/// Runs one kernel over all random contacts and compares.
Coverage compare_kernel(NamedLaw law, bool limit_damping, bool uniform, bool advance)
{
  RandomSource random(20250204 + 8 * static_cast<int>(law.normal) +
                      static_cast<int>(law.tangential));
  const ContactKernel kernel = contact_kernel(law, uniform, advance);
  ContactBatch batch;
  batch.clear();
  Coverage seen;
  double worst = 0.0;
  std::string worst_case;

  for (int n = 0; n < num_batches; n++) {
    std::vector<Numbers> table;
    std::vector<ContactCoefficients> rows;
    for (int r = 0; r < num_rows; r++) {
      table.push_back(slow::random_coefficients(random, limit_damping));
      rows.push_back(row_of(law, table.back()));
    }
    const double dt = random.decade(-6.0, -2.0);
    std::vector<Contact> contacts;
    std::vector<int> row(ContactBatch::width);
    for (int lane = 0; lane < ContactBatch::width; lane++) {
      row[lane] = random.below(num_rows);    // uniform kernels must not look at it
      contacts.push_back(slow::random_contact(random, law, table[uniform ? 0 : row[lane]]));
      slow::put(batch, lane, contacts[lane], row[lane]);
    }
    kernel(batch, 0, ContactBatch::width, rows.data(), dt);

    for (int lane = 0; lane < ContactBatch::width; lane++) {
      const Contact &c = contacts[lane];
      const Numbers &p = table[uniform ? 0 : row[lane]];
      const Outcome expected = slow::evaluate(c, law, p, dt, advance);
      count(seen, c, expected, p);
      const double error = error_of_lane(batch, lane, c, expected, law);
      if (!(error <= worst)) {
        worst = error;
        worst_case = describe(c, expected, batch, lane);
      }
    }
  }
  EXPECT_LE(worst, tolerance) << slow::title(law) << " limit_damping " << limit_damping
                              << " uniform " << uniform << " advance " << advance << "\n"
                              << worst_case;
  return seen;
}

class ContactLawTest : public testing::TestWithParam<NamedLaw> {};

TEST_P(ContactLawTest, AgreesWithSlowReference)
{
  const NamedLaw law = GetParam();
  for (bool limit_damping : {false, true})
    for (bool uniform : {false, true})
      for (bool advance : {false, true}) {
        const Coverage seen = compare_kernel(law, limit_damping, uniform, advance);
        EXPECT_GE(seen.contacts, 100000);
        EXPECT_GT((limit_damping ? seen.floored : seen.attractive), seen.contacts / 50);
        EXPECT_EQ(limit_damping && seen.attractive, false);
        if (!law.has_friction()) continue;
        EXPECT_GT(seen.sliding, seen.contacts / 10);
        EXPECT_GT(seen.sticking, seen.contacts / 10);
      }
}

INSTANTIATE_TEST_SUITE_P(AllLaws, ContactLawTest, testing::ValuesIn(slow::all_laws()),
                         [](const auto &info) {
                           return std::string(name_of(info.param.normal)) + "_" +
                                  name_of(info.param.tangential);
                         });

// The force at the limit has the length of the limit, however large the terms it is made of.
TEST(ContactLaw, ForceAtLimitHasTheLengthOfTheLimit)
{
  RandomSource random(7);
  for (NamedLaw law : slow::all_laws()) {
    int sliding = 0;
    for (int n = 0; n < 20000 && law.has_friction(); n++) {
      const Numbers p = slow::random_coefficients(random, false);
      const Contact c = slow::random_contact(random, law, p);
      const HistoryValues h{{c.history[0], c.history[1], c.history[2]}};
      const ContactLanes<double> out =
          single_contact(law, row_of(law, p), slow::state_of(c), 1e-5, h);
      const double limit = p.mu * std::fabs(out.normal_force);
      const double size = std::sqrt(dot(out.tangential, out.tangential));
      ASSERT_LE(size, limit * (1.0 + 1e-14));
      if (limit > 0.0 && size > limit * (1.0 - 1e-14)) sliding++;
    }
    EXPECT_GE(sliding, law.has_friction() ? 2000 : 0) << slow::title(law);
  }
}

TEST(ContactLaw, CoincidentCentersExertNoForce)
{
  RandomSource random(8);
  for (NamedLaw law : slow::all_laws())
    for (int n = 0; n < 1000; n++) {
      const Numbers p = slow::random_coefficients(random, random.chance(0.5));
      Contact c = slow::random_contact(random, law, p);
      c.normal = {};
      c.overlap = 0.0;
      const HistoryValues h{{c.history[0], c.history[1], c.history[2], c.sliding ? 1.0 : 0.0}};
      const ContactLanes<double> out =
          single_contact(law, row_of(law, p), slow::state_of(c), 1e-5, h);
      ASSERT_EQ(dot(out.force, out.force), 0.0) << slow::title(law);
      ASSERT_EQ(dot(out.torque_per_radius, out.torque_per_radius), 0.0) << slow::title(law);
    }
}

TEST(ContactLaw, NamesAreThoseOfInputScripts)
{
  std::vector<std::string> names;
  for (NamedLaw law : slow::all_laws()) names.push_back(slow::title(law));
  const std::vector<std::string> expected{"hooke none",      "hooke dashpot",  "hooke onestep",
                                          "hooke multistep", "hertz none",     "hertz dashpot",
                                          "hertz onestep",   "hertz multistep"};
  EXPECT_EQ(names, expected);
}

}    // namespace
