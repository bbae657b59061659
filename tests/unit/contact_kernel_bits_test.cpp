// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the promise of one trajectory needs of the kernels, to the last bit: no dependence on the
// lane or on the path (kernel, query), none on which body comes first, none on a restart.

#include "random_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace Talus;
using namespace named;
using slow::Contact;
using slow::Vector;

namespace {

constexpr double dt = 2e-5;
constexpr int width = ContactBatch::width;

struct Result {
  Vector force, torque_per_radius, history;
  double sliding;
};

bool same_bits(const Result &a, const Result &b)
{
  return std::memcmp(&a, &b, sizeof a) == 0;
}

Result result_of(const ContactBatch &batch, int lane)
{
  return {slow::lane_of(batch.force, lane), slow::lane_of(batch.torque_per_radius, lane),
          slow::lane_of(batch.history, lane), batch.history[3][lane]};
}

/// One contact in one lane of a batch whose other lanes hold whatever they held before.
Result run_in_lane(ContactBatch &batch, int lane, NamedLaw law, const Contact &c, const Numbers &p,
                   bool uniform, bool advance)
{
  slow::put(batch, lane, c, 0);
  const int begin = lane / lanes * lanes;
  const ContactCoefficients row = row_of(law, p);
  contact_kernel(law, uniform, advance)(batch, begin, begin + lanes, &row, dt);
  return result_of(batch, lane);
}

class KernelBits : public testing::TestWithParam<NamedLaw> {
 protected:
  KernelBits() { batch.clear(); }

  /// A new random contact with coefficients of its own.
  void next()
  {
    p = slow::random_coefficients(random, random.chance(0.5));
    c = slow::random_contact(random, law, p);
  }

  const NamedLaw law = GetParam();
  RandomSource random{42};
  ContactBatch batch;
  Numbers p;
  Contact c;
};

TEST_P(KernelBits, DoNotDependOnTheLane)
{
  for (int n = 0; n < 500; n++) {
    next();
    const bool advance = random.chance(0.5);
    const Result first = run_in_lane(batch, 0, law, c, p, true, advance);
    for (int lane = 1; lane < width; lane++)
      for (bool uniform : {false, true})
        ASSERT_TRUE(same_bits(first, run_in_lane(batch, lane, law, c, p, uniform, advance)))
            << "lane " << lane << " uniform " << uniform << " advance " << advance;
  }
}

TEST_P(KernelBits, KernelsComputeOnlyTheRangeTheyAreGiven)
{
  next();
  for (int lane = 0; lane < width; lane++) slow::put(batch, lane, c, 0);
  const ContactCoefficients row = row_of(law, p);
  contact_kernel(law, true, true)(batch, 16, 40, &row, dt);
  const Result computed = result_of(batch, 16);
  for (int lane = 0; lane < width; lane++) {
    const bool inside = lane >= 16 && lane < 40;
    const Result untouched{{}, {}, c.history, c.sliding ? 1.0 : 0.0};
    EXPECT_TRUE(same_bits(inside ? computed : untouched, result_of(batch, lane))) << lane;
  }
}

TEST_P(KernelBits, QueriesAgreeWithKernels)
{
  for (int n = 0; n < 20000; n++) {
    next();
    const Result kernel = run_in_lane(batch, n % width, law, c, p, true, false);
    const HistoryValues h{{c.history[0], c.history[1], c.history[2], c.sliding ? 1.0 : 0.0}};
    const ContactLanes<double> query =
        single_contact(law, row_of(law, p), slow::state_of(c), dt, h);
    const Result other{
        {query.force.x, query.force.y, query.force.z},
        {query.torque_per_radius.x, query.torque_per_radius.y, query.torque_per_radius.z},
        c.history,
        h[3]};
    ASSERT_TRUE(same_bits(kernel, other)) << n;
  }
}

// A run that stops and starts again computes the force of its last step from the stored history.
TEST_P(KernelBits, ForceIsReproducedFromTheStoredHistory)
{
  int sliding = 0, below = 0;
  for (int n = 0; n < 20000; n++) {
    next();
    const Result before = run_in_lane(batch, n % width, law, c, p, true, true);
    Contact stored = c;
    stored.history = before.history;
    stored.sliding = before.sliding > 0.0;
    (stored.sliding ? sliding : below)++;
    const Result after = run_in_lane(batch, (n + 3) % width, law, stored, p, true, false);
    ASSERT_TRUE(std::memcmp(&before, &after, sizeof before) == 0) << n;
  }
  if (law.has_history()) {
    EXPECT_GT(sliding, 2000);
    EXPECT_GT(below, 2000);
  }
}

// Nor does it change a bit that energies are asked for; and they are the same from one function and
// from single stages.
TEST_P(KernelBits, AccountingLeavesThem)
{
  for (int n = 0; n < 2000; n++) {
    next();
    const int lane = n % width, begin = lane / lanes * lanes;
    const Result plain = run_in_lane(batch, lane, law, c, p, true, true);
    double work[2][ContactBatch::num_causes];
    for (const bool uniform : {false, true}) {
      slow::put(batch, lane, c, 0);
      const ContactCoefficients row = row_of(law, p);
      accounting_kernel(law, uniform, true)(batch, begin, begin + lanes, &row, dt);
      ASSERT_TRUE(same_bits(plain, result_of(batch, lane))) << n;
      for (int k = 0; k < ContactBatch::num_causes; k++) work[uniform][k] = batch.work[k][lane];
    }
    // single stages find the tangential force as what the normal one leaves of the sum
    double force = 0.0, speed = 0.0;
    for (int d = 0; d < 3; d++) {
      force += std::abs(batch.force[d][lane]);
      speed += std::abs(batch.velocity[d][lane]) + std::abs(batch.surface_rotation[d][lane]);
    }
    for (int k = 0; k < ContactBatch::num_causes; k++)
      ASSERT_NEAR(work[0][k], work[1][k], 1e-12 * std::abs(work[0][k]) + 1e-15 * dt * force * speed)
          << n << " cause " << k;
    if (!law.law().has_friction()) {
      ASSERT_EQ(work[0][1], 0.0);
    }
  }
}

TEST_P(KernelBits, QueriesLeaveTheHistory)
{
  for (int n = 0; n < 1000; n++) {
    next();
    const Result out = run_in_lane(batch, 0, law, c, p, false, false);
    ASSERT_EQ(out.history, c.history);
    ASSERT_EQ(out.sliding, c.sliding ? 1.0 : 0.0);
  }
}

// Either body may come first: force and history change sign, the moment stays. (Zeros may differ in
// sign: no sum notices.)
TEST_P(KernelBits, SwappingTheBodiesNegatesTheForceExactly)
{
  const auto negated = [](const Vector &v) { return Vector{-v[0], -v[1], -v[2]}; };
  for (int n = 0; n < 20000; n++) {
    next();
    Contact swapped = c;
    swapped.normal = negated(c.normal);
    swapped.history = negated(c.history);
    std::swap(swapped.radius[0], swapped.radius[1]);
    std::swap(swapped.mass[0], swapped.mass[1]);
    std::swap(swapped.velocity[0], swapped.velocity[1]);
    std::swap(swapped.omega[0], swapped.omega[1]);
    const bool advance = random.chance(0.7);
    const Result a = run_in_lane(batch, n % width, law, c, p, true, advance);
    const Result b = run_in_lane(batch, (n + 11) % width, law, swapped, p, true, advance);
    ASSERT_EQ(a.force, negated(b.force)) << n;
    ASSERT_EQ(a.torque_per_radius, b.torque_per_radius) << n;
    ASSERT_EQ(a.history, negated(b.history)) << n;
    ASSERT_EQ(a.sliding, b.sliding) << n;
  }
}

INSTANTIATE_TEST_SUITE_P(AllLaws, KernelBits, testing::ValuesIn(slow::all_laws()),
                         [](const auto &info) {
                           return std::string(name_of(info.param.normal)) + "_" +
                                  name_of(info.param.tangential);
                         });

}    // namespace
