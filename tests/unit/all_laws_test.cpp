// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Every combination of laws against the slow reference, from the words of the user (two
// ContactSpecs, mixed) to force, torques, history and impact of random contacts. Errors are
// relative to the sum of the magnitudes of the terms of a result: kn overlap + gn |v| for the
// normal force, kt |d| + gt (|v| + r |omega|) and mu times the former for the tangential one, and
// so on (scales in law_reference.h). States in which rounding decides on which side of a threshold
// a contact is are left out, and counted.

#include "law_states.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

using namespace Talus;
using namespace named;
using namespace reference;

namespace {

constexpr Number tolerance = 1e-13L;
/// Of each pair of laws, with and without advancing histories.
const int num_contacts = std::getenv("TALUS_LARGE_TESTS") ? 100000 : 40000;
constexpr int num_rows = 32;

/// A pair of materials as the reference and as the kernels see it.
struct Table {
  std::vector<Composite> composite;
  std::vector<ContactCoefficients> row;

  Table(RandomSource &random, NamedLaw law)
  {
    for (int r = 0; r < num_rows; r++) {
      const bool limited = random.chance(0.3);
      const ContactSpec a = random_spec(random, law, limited);
      const ContactSpec b = random.chance(0.5) ? a : random_spec(random, law, random.chance(0.3));
      const auto rule = static_cast<FrictionMix>(random.below(3));
      composite.push_back(compose(a, b, rule));
      row.push_back(contact_coefficients(a, b, rule));
    }
  }
};

/// What the states of a test covered, to be sure that no case is missing.
struct Coverage {
  int contacts = 0, unclear = 0, slides = 0, sticks = 0, attracts = 0, floored = 0, rolls = 0,
      rotation = 0, delayed = 0, resists_late = 0, begun = 0;
  std::set<int> kernels;

  void count(const Contact &c, const Outcome &o, const Composite &p, NamedLaw law)
  {
    contacts++;
    unclear += !o.clear_case;
    slides += o.slides;
    sticks += o.sticks;
    attracts += o.normal_force < 0;
    floored += p.limited && o.normal_force == 0 && c.overlap > 0;
    rolls += o.rolls;
    rotation += o.rotation;
    delayed += o.delayed;
    resists_late += law.delayed && !o.delayed;
    begun += c.begun;
  }
};

Number error_of(const Vector &found, const Vector &expected, Number scale)
{
  Number worst = 0;
  for (int d = 0; d < 3; d++) {
    if (!std::isfinite(static_cast<double>(found[d]))) return infinity;
    const Number off = std::fabs(found[d] - expected[d]);
    if (off > 0) worst = std::max(worst, scale > 0 ? off / scale : Number(infinity));
  }
  return worst;
}

struct Worst {
  Number force = 0, torque = 0, history = 0, impact = 0;
  std::string where;
  Number largest() const { return std::max({force, torque, history, impact}); }
};

void compare_lane(const ContactBatch &b, int lane, const Contact &c, const Outcome &expected,
                  NamedLaw law, bool advance, Worst &worst)
{
  const Number before = worst.largest();
  const auto keep = [](Number &largest, Number error) { largest = std::max(largest, error); };
  keep(worst.force, error_of(lane_of(b.force, lane), expected.force, expected.force_scale));
  if (law.has_friction())
    for (int body = 0; body < 2; body++) {
      const Vector twisting_torque = law.resists ? lane_of(b.twisting_torque, lane) : Vector{};
      const Vector torque = Number(-1) * c.radius[body] * lane_of(b.torque_per_radius, lane) +
                            Number(body == 0 ? 1 : -1) * twisting_torque;
      keep(worst.torque, error_of(torque, expected.torque[body], expected.torque_scale[body]));
    }
  const Vector history = Number(-1) * lane_of(b.history, lane);
  keep(worst.history, error_of(history, expected.history, expected.history_scale));
  if (expected.clear_case && (b.history[3][lane] > 0.0) != expected.sliding)
    worst.history = infinity;
  if (law.has_impact() && advance) {
    keep(worst.impact,
         error_of({b.history[4][lane], 0, 0}, {expected.impact_speed, 0, 0}, expected.speed_scale));
    keep(worst.impact, error_of({b.history[5][lane], 0, 0}, {expected.age, 0, 0}, expected.age));
    if ((b.history[6][lane] > 0.0) != expected.begun) worst.impact = infinity;
  }
  if (!(worst.largest() > before)) return;
  std::ostringstream text;
  text << std::setprecision(17) << title(law) << " overlap " << c.overlap << " masses " << c.mass[0]
       << " " << c.mass[1] << " radii " << c.radius[0] << " " << c.radius[1] << " normal force "
       << expected.normal_force << "\n";
  for (int d = 0; d < 3; d++)
    text << "force " << b.force[d][lane] << " expected " << expected.force[d] << " moment "
         << b.torque_per_radius[d][lane] << " twisting_torque " << b.twisting_torque[d][lane]
         << " torques expected " << expected.torque[0][d] << " " << expected.torque[1][d] << "\n";
  worst.where = text.str();
}

/// Whether forces jump there; at the limit of friction they do not.
bool has_thresholds(NamedLaw law)
{
  return law.resists || law.tangential == Tangential::TANH;
}

class AllLaws : public testing::TestWithParam<NamedLaw> {};

TEST_P(AllLaws, AgreeWithTheSlowReference)
{
  const std::vector<NamedLaw> laws = variants(GetParam());
  RandomSource random(100 + 8 * static_cast<int>(GetParam().normal) +
                      static_cast<int>(GetParam().tangential));
  ContactBatch batch;
  batch.clear();
  Coverage seen;
  Worst worst;
  int variant = 0;
  Table table(random, laws[variant]);
  for (bool advance : {false, true})
    for (int n = 0; n * ContactBatch::width < num_contacts; n++) {
      if (n % 3 == 0) {
        // those of the stock styles, which most use, more often
        const bool stock = GetParam().normal <= Normal::HERTZ && random.chance(0.3);
        variant = stock ? 0 : random.below(static_cast<int>(laws.size()));
        table = Table(random, laws[variant]);
      }
      const NamedLaw law = laws[variant];
      const bool uniform = random.chance(0.5);
      const double dt = random.decade(-6.0, -3.0);
      std::vector<Contact> contacts;
      for (int lane = 0; lane < ContactBatch::width; lane++) {
        const int row = random.below(num_rows);    // uniform kernels must not look at it
        contacts.push_back(random_contact(random, law, table.composite[uniform ? 0 : row], dt));
        put(batch, lane, contacts[lane], row);
      }
      contact_kernel(law, uniform, advance)(batch, 0, ContactBatch::width, table.row.data(), dt);
      seen.kernels.insert(4 * variant + 2 * uniform + advance);
      for (int lane = 0; lane < ContactBatch::width; lane++) {
        const Composite &p = table.composite[uniform ? 0 : batch.coefficients[lane]];
        const Outcome expected = evaluate(contacts[lane], law, p, dt, advance);
        seen.count(contacts[lane], expected, p, law);
        if (expected.clear_case || !has_thresholds(law))
          compare_lane(batch, lane, contacts[lane], expected, law, advance, worst);
      }
    }

  std::cout << std::left << std::setw(34) << title(GetParam()) << std::setprecision(2) << " force "
            << worst.force << " torque " << worst.torque << " history " << worst.history
            << " impact " << worst.impact << " left out " << seen.unclear << "\n";
  EXPECT_LE(worst.largest(), tolerance) << worst.where;
  EXPECT_GE(seen.contacts, 2 * num_contacts);
  EXPECT_EQ(seen.kernels.size(), 48U);
  EXPECT_LT(seen.unclear, seen.contacts / 100);
  const int many = seen.contacts / 100;
  for (int count :
       {seen.attracts, seen.floored, seen.rolls, seen.rotation, seen.delayed, seen.resists_late})
    EXPECT_GT(count, many);
  EXPECT_GT(seen.contacts - seen.begun, many);
  if (GetParam().tangential == Tangential::NONE) return;
  EXPECT_GT(seen.slides, many);
  EXPECT_GT(seen.sticks, many);
}

INSTANTIATE_TEST_SUITE_P(Grammar, AllLaws, testing::ValuesIn(law_pairs()),
                         [](const auto &info) { return identifier(info.param); });

/// visit(law, material, the same as a composite, a random contact) for each law of the stock styles.
template <class Visit> void for_stock_contacts(int seed, int times, Visit visit)
{
  RandomSource random(seed);
  for (NamedLaw law : stock_laws())
    for (int n = 0; n < times; n++) {
      const ContactSpec spec = random_spec(random, law, random.chance(0.5));
      const Composite p = compose(spec, spec, FrictionMix::MINIMUM);
      visit(law, spec, p, random_contact(random, law, p, 1e-5));
    }
}

// The force at the limit has the length of the limit, however large the terms it is made of.
TEST(StockLaws, ForceAtLimitHasTheLengthOfTheLimit)
{
  std::map<std::string, int> sliding;
  for_stock_contacts(
      7, 20000, [&](NamedLaw law, const ContactSpec &spec, const Composite &p, Contact c) {
        if (!law.has_friction()) return;
        c.sliding = false;
        const auto row = contact_coefficients(spec, spec, FrictionMix::MINIMUM);
        const ContactLanes<double> out = single_contact(law, row, state_of(c), 1e-5, remembered(c));
        const double limit = static_cast<double>(p.mu) * std::fabs(out.normal_force);
        const double size = std::sqrt(dot(out.tangential, out.tangential));
        ASSERT_LE(size, limit * (1.0 + 1e-14)) << title(law);
        sliding[title(law)] += limit > 0.0 && size > limit * (1.0 - 1e-14);
      });
  EXPECT_EQ(sliding.size(), 6U);
  for (const auto &[law, count] : sliding) EXPECT_GE(count, 2000) << law;
}

TEST(StockLaws, CoincidentCentersExertNoForce)
{
  for_stock_contacts(
      8, 1000, [](NamedLaw law, const ContactSpec &spec, const Composite &, Contact c) {
        c.normal = {};
        c.overlap = 0.0;
        const auto row = contact_coefficients(spec, spec, FrictionMix::MINIMUM);
        const ContactLanes<double> out = single_contact(law, row, state_of(c), 1e-5, remembered(c));
        ASSERT_EQ(dot(out.force, out.force), 0.0) << title(law);
        ASSERT_EQ(dot(out.torque_per_radius, out.torque_per_radius), 0.0) << title(law);
      });
}

// All 528 combinations have kernels of both kinds, and queries; where no contact has a history both
// kinds are one.
TEST(AllLawsOfTheGrammar, HaveKernelsThatRun)
{
  RandomSource random(1);
  ContactBatch batch;
  batch.clear();
  int count = 0;
  for (NamedLaw pair : law_pairs())
    for (NamedLaw law : variants(pair)) {
      count++;
      const Table table(random, law);
      EXPECT_EQ(staged_kernel(law, true, true) == staged_kernel(law, true, false),
                !law.has_history());
      for (bool uniform : {false, true})
        for (bool advance : {false, true}) {
          const ContactKernel kernel = contact_kernel(law, uniform, advance);
          for (int lane = 0; lane < ContactBatch::width; lane++)
            put(batch, lane, random_contact(random, law, table.composite[0], 1e-5), 0);
          kernel(batch, 0, ContactBatch::width, table.row.data(), 1e-5);
          for (int lane = 0; lane < ContactBatch::width; lane++)
            for (int d = 0; d < 3; d++)
              ASSERT_TRUE(std::isfinite(batch.force[d][lane]) &&
                          std::isfinite(batch.torque_per_radius[d][lane]) &&
                          std::isfinite(batch.twisting_torque[d][lane]) &&
                          std::isfinite(batch.history[d][lane]))
                  << title(law);
        }
    }
  EXPECT_EQ(count, 528);
}

// The radius of the intersection circle against the textbook formula, where that one is well
// conditioned.
TEST(Resistance, CircleOfIntersection)
{
  RandomSource random(2);
  for (int n = 0; n < 100000; n++) {
    const double a = random.decade(-1.0, 0.0), b = random.decade(-1.0, 0.0);
    const double overlap = 2.0 * std::min(a, b) * random.uniform(0.01, 0.99);
    const Number d = Number(a) + b - overlap, x = (Number(a) * a - Number(b) * b) / (2 * d) + d / 2;
    const Number expected = std::sqrt((a - x) * (a + x));
    const double found = intersection_radius_of(a, b, overlap);
    ASSERT_NEAR(found, static_cast<double>(expected), 1e-13 * std::min(a, b));
    ASSERT_EQ(found, intersection_radius_of(b, a, overlap));    // whichever comes first
  }
  EXPECT_EQ(intersection_radius_of(1.0, 2.0, 0.0), 0.0);
  EXPECT_EQ(intersection_radius_of(1.0, 2.0, -0.5), 0.0);
  EXPECT_EQ(intersection_radius_of(1.0, 3.0, 2.5), 0.0);    // one inside the other
  EXPECT_NEAR(intersection_radius_of(5e-9, 5e-9, 1e-9), std::sqrt(25e-18 - 4.5e-9 * 4.5e-9), 1e-23);
}

}    // namespace
