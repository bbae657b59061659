// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the promise of one trajectory needs of every combination of laws, to the last bit: no dependence on the lane,
// on the kind of kernel or on the path (kernel, query), none on which body comes first, none on a restart.

#include "law_states.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

using namespace Talus;
using namespace named;
using namespace reference;

namespace {

constexpr double dt = 2e-5;
constexpr int width = ContactBatch::width;
/// Random contacts of each pair of laws.
const int num_contacts = std::getenv("TALUS_LARGE_TESTS") ? 10000 : 3000;
using Values = reference::Triple<double>;

Values negated(const Values &v)
{
  return {-v[0], -v[1], -v[2]};
}

class LawBits : public testing::TestWithParam<NamedLaw> {
 protected:
  LawBits() { batch.clear(); }

  /// A new random contact with coefficients and a variant of the law of its own.
  void next()
  {
    const std::vector<NamedLaw> laws = variants(GetParam());
    law = laws[random.chance(0.3) ? 0 : random.below(static_cast<int>(laws.size()))];
    const ContactSpec spec = random_spec(random, law, random.chance(0.3));
    p = contact_coefficients(spec, spec, FrictionMix::MINIMUM);
    c = random_contact(random, law, compose(spec, spec, FrictionMix::MINIMUM), dt);
  }

  KernelResult run(int lane, const Contact &contact, bool uniform, bool advance)
  {
    return run(contact_kernel(law, uniform, advance), lane, contact);
  }
  KernelResult run(ContactKernel kernel, int lane, const Contact &contact)
  {
    put(batch, lane, contact, 0);
    return reference::run(batch, kernel, lane, p, dt);
  }

  RandomSource random{4711};
  ContactBatch batch;
  NamedLaw law;
  ContactCoefficients p;
  Contact c;
};

TEST_P(LawBits, DoNotDependOnTheLaneOrTheKindOfKernel)
{
  for (int n = 0; n < 300; n++) {
    next();
    const bool advance = random.chance(0.5);
    const KernelResult first = run(0, c, true, advance);
    for (int lane = 1; lane < width; lane++)
      ASSERT_TRUE(same_bits(first, run(lane, c, lane % 2 == 0, advance)))
          << title(law) << " lane " << lane;
  }
}

TEST_P(LawBits, QueriesAgreeWithKernels)
{
  for (int n = 0; n < num_contacts; n++) {
    next();
    const int lane = n % width;
    const KernelResult kernel = run(lane, c, n % 2 == 0, false);
    const ContactLanes<double> query = single_contact(law, p, state_of(c), dt, remembered(c));
    ASSERT_TRUE(same_bits(kernel, {plain(query.force), plain(query.torque_per_radius),
                                   plain(query.twisting_torque), remembered(c)}))
        << title(law);    // and leave the history as it is
  }
}

TEST_P(LawBits, KernelsComputeOnlyTheRangeTheyAreGiven)
{
  next();
  for (int lane = 0; lane < width; lane++) put(batch, lane, c, 0);
  const KernelResult untouched = result_in(batch, 0);
  contact_kernel(law, true, true)(batch, 16, 40, &p, dt);
  for (int lane = 0; lane < width; lane++)
    EXPECT_TRUE(same_bits(lane >= 16 && lane < 40 ? result_in(batch, 16) : untouched,
                          result_in(batch, lane)))
        << title(law) << " lane " << lane;
  EXPECT_EQ(untouched.force, Values{});
  EXPECT_EQ(untouched.torque_per_radius, Values{});
}

// Nor does it change a bit that energies are asked for; and they are the same from one function and
// from single stages.
TEST_P(LawBits, AccountingLeavesThem)
{
  for (int n = 0; n < num_contacts / 3; n++) {
    next();
    const int lane = n % width;
    const KernelResult plain = run(lane, c, true, true);
    double work[2][ContactBatch::num_causes];
    for (const bool uniform : {false, true}) {
      ASSERT_TRUE(same_bits(plain, run(accounting_kernel(law, uniform, true), lane, c)))
          << title(law) << " " << n;
      for (int k = 0; k < ContactBatch::num_causes; k++) work[uniform][k] = batch.work[k][lane];
    }
    // single stages find the tangential force as what the normal one leaves of the sum; where contacts slide it may be what
    // is left of a much larger one
    double force = 0.0, speed = 0.0;
    for (int d = 0; d < 3; d++) {
      force += std::abs(batch.force[d][lane]) + batch.between.kt[lane] * std::abs(remembered(c)[d]);
      speed += std::abs(batch.velocity[d][lane]) + std::abs(batch.surface_rotation[d][lane]);
    }
    force += batch.between.gt[lane] * speed;
    for (int k = 0; k < ContactBatch::num_causes; k++)
      ASSERT_NEAR(work[0][k], work[1][k], 1e-12 * std::abs(work[0][k]) + 1e-15 * dt * force * speed)
          << title(law) << " " << n << " cause " << k;
    if (!law.has_friction()) {
      ASSERT_EQ(work[0][1], 0.0);
    }
  }
}

// A run that stops and starts again computes the force of its last step from what is stored.
TEST_P(LawBits, ForceIsReproducedFromTheStoredHistory)
{
  int sliding = 0, below = 0, fresh = 0;
  for (int n = 0; n < num_contacts; n++) {
    next();
    const KernelResult before = run(n % width, c, true, true);
    fresh += !c.begun;
    const bool slides = before.history[3] > 0.0, begun = before.history[6] > 0.0;
    (slides ? sliding : below)++;
    Contact stored = c;
    for (int d = 0; d < 3; d++) stored.history[d] = -before.history[d];
    stored.sliding = slides;
    stored.impact_speed = before.history[4];
    stored.age = before.history[5];
    stored.begun = begun;
    const KernelResult after = run((n + 3) % width, stored, false, false);
    ASSERT_TRUE(same_bits(before, after)) << title(law) << " " << n;
    ASSERT_EQ(begun, law.has_impact() || c.begun) << title(law);
  }
  EXPECT_GT(fresh, num_contacts / 10);
  if (!GetParam().has_history()) return;
  EXPECT_GT(sliding, num_contacts / 10);
  EXPECT_GT(below, num_contacts / 10);
}

// Either body may come first: force, twisting torque and displacement change sign, moment and impact stay. (Zeros may differ
// in sign: no sum notices.)
TEST_P(LawBits, SwappingTheBodiesNegatesTheForceExactly)
{
  for (int n = 0; n < num_contacts; n++) {
    next();
    Contact swapped = c;
    for (int d = 0; d < 3; d++) {
      swapped.normal[d] = -c.normal[d];
      swapped.history[d] = -c.history[d];
    }
    std::swap(swapped.radius[0], swapped.radius[1]);
    std::swap(swapped.mass[0], swapped.mass[1]);
    std::swap(swapped.velocity[0], swapped.velocity[1]);
    std::swap(swapped.omega[0], swapped.omega[1]);
    const bool advance = random.chance(0.7);
    const KernelResult a = run(n % width, c, true, advance);
    const KernelResult b = run((n + 11) % width, swapped, true, advance);
    ASSERT_EQ(a.force, negated(b.force)) << title(law);
    ASSERT_EQ(a.torque_per_radius, b.torque_per_radius) << title(law);
    ASSERT_EQ(a.twisting_torque, negated(b.twisting_torque)) << title(law);
    for (int k = 0; k < ContactBatch::history_size; k++)
      ASSERT_EQ(a.history[k], k < 3 ? -b.history[k] : b.history[k]) << title(law);
  }
}

INSTANTIATE_TEST_SUITE_P(Grammar, LawBits, testing::ValuesIn(law_pairs()),
                         [](const auto &info) { return identifier(info.param); });

}    // namespace
