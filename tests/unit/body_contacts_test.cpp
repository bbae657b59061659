// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of particles with a large body: forces against the slow reference, balance of forces and
// torques, life and death of the history.

#include "body/contact/body_contacts.h"
#include "body/shape/plane.h"
#include "body/shape/rectangle.h"
#include "histories_of.h"
#include "packing.h"

#include <cmath>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

using namespace Talus;
using namespace slow;

namespace {

constexpr double dt = 1e-3, skin = 0.2;

/// Particles on both sides of a tilted wall, some near its edges, some far away.
class BodyContactsTest : public testing::TestWithParam<int> {
 protected:
  BodyContactsTest() : p(random_packing(1500, random))
  {
    const Vector3<double> point{0.5, -0.3, 0.2}, normal{0.6, 0.0, 0.8}, edge{0.8, 0.0, -0.6};
    if (GetParam() % 2)
      shape = std::make_unique<Rectangle>(point, normal, edge, 16.0, 14.0, true);
    else
      shape = std::make_unique<Plane>(point, normal, false);
    laws = GetParam() < 2
               ? mixed_laws()
               : single_law({named::Normal::HERTZ, named::Tangential::MULTISTEP}, GetParam() == 2);
    contacts.set_laws(laws);
    frame.origin = shape->reference_point();
    mask.assign(p.size(), 1);
  }

  BodyLoad compute(bool advance)
  {
    force.assign(p.size(), Vector{});
    torque.assign(p.size(), Vector{});
    return contacts.compute(*shape, frame, view(), step_of(advance));
  }

  static BodyStep step_of(bool advance)
  {
    BodyStep step;
    step.dt = dt;
    step.advance = advance;
    step.threads = threads();
    return step;
  }
  static int threads() { return GetParam() == 2 ? 3 : 1; }

  void find() { contacts.find_candidates(*shape, frame, view(), mask.data(), 1, skin, threads()); }

  ParticleState view()
  {
    return {p.size(),
            {p.x[0].data(), p.v[0].data(), p.omega[0].data(), p.radius.data(), p.mass.data(),
             p.mass_override.data(), force.empty() ? nullptr : force[0].data(),
             torque.empty() ? nullptr : torque[0].data()},
            p.type.data()};
  }

  /// The contact of particle i as the reference takes it: with a resting, infinitely large and
  /// heavy body.
  reference::Contact contact_of(int i, const SurfaceContact &surface) const
  {
    reference::Contact c;
    c.overlap = surface.overlap;
    c.radius = {p.radius[i], infinity};
    c.mass = {p.mass_override[i] > 0.0 ? p.mass_override[i] : p.mass[i], infinity};
    c.velocity[0] = reference::widen(p.v[i]);
    c.omega[0] = reference::widen(p.omega[i]);
    return c;
  }

  bool touches(int i, SurfaceContact &surface) const
  {
    return shape->touches(talus(p.x[i]), p.radius[i], surface);
  }

  RandomSource random{21};
  Packing p;
  std::unique_ptr<LargeBodyShape> shape;
  LawTable laws;
  BodyFrame frame;
  BodyContacts contacts;
  std::vector<int> mask;
  std::vector<Vector> force, torque;
};

TEST_P(BodyContactsTest, AgreesWithTheSlowReferenceAndBalances)
{
  std::vector<Vector> displacement(p.size());
  std::vector<char> sliding(p.size(), 0);
  find();
  int touching = 0;
  for (int step = 0; step < 15; step++) {
    const bool advance = step != 0 && step != 7;
    if (step % 5 == 4) find();
    const BodyLoad load = compute(advance);
    Vector sum_force{}, sum_torque{};
    double scale = 0.0;
    touching = 0;
    for (int i = 0; i < p.size(); i++) {
      SurfaceContact surface;
      const bool in_contact = touches(i, surface);
      Outcome expected;
      if (in_contact) {
        reference::Contact c = contact_of(i, surface);
        c.sliding = sliding[i];
        const int row = laws.row(p.type[i], p.type[i]);
        expected = evaluate(c, plain(surface.normal), displacement[i], laws.law(row),
                            laws.coefficients(row), dt, advance);
        touching++;
      }
      const double error = 1e-12 * expected.force_scale;
      ASSERT_LE(norm(axpy(-1.0, expected.force, force[i])), error) << i << " step " << step;
      ASSERT_LE(norm(axpy(-1.0, expected.torque[0], torque[i])), error * p.radius[i]) << i;
      displacement[i] = expected.history;
      sliding[i] = expected.sliding;
      if (contacts.keeps_history()) {
        const HistoryValues h = history_of(contacts.history, i);
        const Vector found{h[0], h[1], h[2]};
        ASSERT_LE(norm(axpy(-1.0, displacement[i], found)), 1e-12 * norm(displacement[i]) + 1e-15);
      }

      const Vector3<double> about = shape->reference_point();
      const Vector arm = axpy(-1.0, {about.x, about.y, about.z}, p.x[i]);
      sum_force = axpy(1.0, force[i], sum_force);
      sum_torque = axpy(1.0, torque[i], axpy(1.0, outer(arm, force[i]), sum_torque));
      scale += norm(force[i]) * (1.0 + norm(arm)) + norm(torque[i]);
    }
    // Newton's third law, for forces and for torques about the reference point
    ASSERT_GT(scale, 0.0);
    const Vector reaction{load.force.x, load.force.y, load.force.z};
    const Vector net_torque{load.torque.x, load.torque.y, load.torque.z};
    ASSERT_LE(norm(axpy(1.0, reaction, sum_force)), 1e-14 * scale);
    ASSERT_LE(norm(axpy(1.0, net_torque, sum_torque)), 1e-14 * scale);
    ASSERT_EQ(load.contacts, touching);
    p.move(5.0 * dt, 0.1, random);
  }
  EXPECT_GT(touching, ContactBatch::width);    // more than one batch
}

TEST_P(BodyContactsTest, TheWorstContactAndTheFastestParticle)
{
  // two that are equal: the first counts
  const int fast = 400, as_fast = 900;
  const double speed = 50.0;
  for (int i : {fast, as_fast}) {
    p.x[i] = {0.5, -0.3, 0.2};
    p.v[i] = {0.0, speed, 0.0};
    p.radius[i] = 0.5;
  }
  find();
  double overlap = 0.0;
  int deepest = 0;
  for (int i = 0; i < p.size(); i++) {
    SurfaceContact surface;
    if (!touches(i, surface) || surface.overlap / p.radius[i] <= overlap) continue;
    overlap = surface.overlap / p.radius[i];
    deepest = i;
  }
  for (int threads : {1, 2, 7}) {
    const BodyFindings worst = contacts.find_worst(*shape, frame, view(), threads);
    EXPECT_EQ(worst.overlap.value, overlap);
    EXPECT_EQ(worst.overlap.particle, deepest);
    EXPECT_EQ(worst.speed.value, speed / 0.5);
    EXPECT_EQ(worst.speed.particle, fast);
  }
}

TEST_P(BodyContactsTest, ForcesAreAdded)
{
  find();
  compute(false);
  const std::vector<Vector> once = force;
  contacts.compute(*shape, frame, view(), step_of(false));
  for (int i = 0; i < p.size(); i++)
    for (int d = 0; d < 3; d++) EXPECT_EQ(force[i][d], 2.0 * once[i][d]);
}

// A force computed again from the stored history has the same bits, and the history stays.
TEST_P(BodyContactsTest, WithoutAdvanceTheHistoryStays)
{
  find();
  for (int step = 0; step < 3; step++) compute(true);
  std::vector<HistoryValues> history;
  for (int i = 0; i < p.size() && contacts.keeps_history(); i++)
    history.push_back(history_of(contacts.history, i));
  const std::vector<Vector> before = force;
  for (int repeat = 0; repeat < 2; repeat++) {
    compute(false);
    EXPECT_EQ(force, before);
    for (int i = 0; i < p.size() && contacts.keeps_history(); i++) {
      ASSERT_EQ(history_of(contacts.history, i), history[i]);
    }
  }
}

// Rows for outputs hold the forces that were added, at the positions that were used, whatever moves
// afterwards; and that they are kept changes no bit of forces and histories.
TEST_P(BodyContactsTest, WhatIsToldIsWhatActed)
{
  find();
  for (int step = 0; step < 2; step++) compute(true);
  compute(false);
  const std::vector<Vector> unasked = force;
  ComputedContacts told;
  told.begin(true);
  BodyStep step = step_of(false);
  step.for_outputs = &told;
  force.assign(p.size(), Vector{});
  torque.assign(p.size(), Vector{});
  contacts.compute(*shape, frame, view(), step);
  EXPECT_EQ(force, unasked);
  double kept = 0.0;
  told.for_each([&](const ContactReport &one) { kept += kept_energy(one); });
  EXPECT_NEAR(told.stored_energy(), kept, 1e-13 * kept);
  const std::vector<Vector> place = p.x;
  for (Vector &x : p.x) x = {2.0 * x[0], x[1] - 1.0, 0.0};
  contacts.set_laws(single_law({named::Normal::HOOKE, named::Tangential::NONE}, true));
  for (int repeat = 0; repeat < 2; repeat++) {
    std::vector<Vector> sum(p.size(), Vector{});
    int count = 0;
    told.for_each([&](const ContactReport &one) {
      count++;
      const double f[3] = {one.force.x, one.force.y, one.force.z};
      for (int d = 0; d < 3; d++) sum[one.i][d] += f[d];
      EXPECT_EQ(one.center[0].x, place[one.i][0]);
      EXPECT_EQ(one.center[0].z, place[one.i][2]);
      EXPECT_GT(one.overlap, 0.0);
      EXPECT_GT(one.stored.normal, 0.0);
      EXPECT_NEAR(length(one.arm[0]), std::abs(p.radius[one.i] - one.overlap), 1e-12);
    });
    EXPECT_GT(count, 20);
    EXPECT_EQ(sum, force);
  }
}

// Rows that nobody lists are not kept: in a bed they are a fifth of all memory.
TEST_P(BodyContactsTest, WhereNobodyListsContactsTheirEnergyIsKept)
{
  find();
  compute(true);
  ComputedContacts listed, unlisted;
  listed.begin(true);
  BodyStep step = step_of(false);
  for (ComputedContacts *to : {&listed, &unlisted}) {
    step.for_outputs = to;
    contacts.compute(*shape, frame, view(), step);
  }
  EXPECT_GT(unlisted.stored_energy(), 0.0);
  EXPECT_EQ(unlisted.stored_energy(), listed.stored_energy());
  EXPECT_EQ(unlisted.memory_usage(), 0.0);
  unlisted.for_each([](const ContactReport &one) { ADD_FAILURE() << one.i; });
}

TEST_P(BodyContactsTest, HistoryIsKeptWhileTouchingAndForgottenAfter)
{
  ASSERT_TRUE(contacts.keeps_history());
  find();
  compute(true);
  const auto has_history = [this](int i) { return history_of(contacts.history, i)[0] != 0.0; };
  std::vector<int> touching;
  for (int i = 0; i < p.size(); i++)
    if (has_history(i)) touching.push_back(i);
  ASSERT_GT(touching.size(), 20U);

  find();    // a rebuild changes nothing
  for (int i : touching) EXPECT_TRUE(has_history(i));

  const std::vector<Vector> home = p.x;
  for (std::size_t n = 0; n < touching.size(); n++) {
    const int i = touching[n];
    if (n % 3 == 0) p.x[i] = {40.0, 3.0, 30.0};    // far off, until the next rebuild a candidate
    if (n % 3 == 1) mask[i] = 2;                   // no longer in the group, noticed at the rebuild
  }
  compute(true);
  for (std::size_t n = 0; n < touching.size(); n++) EXPECT_EQ(has_history(touching[n]), n % 3 != 0);
  find();
  for (std::size_t n = 0; n < touching.size(); n++) EXPECT_EQ(has_history(touching[n]), n % 3 == 2);

  p.x = home;
  find();
  compute(false);    // back in contact, but without history
  for (std::size_t n = 0; n < touching.size(); n++) EXPECT_EQ(has_history(touching[n]), n % 3 == 2);
}

/// A surface that moves by itself and is curved.
class Described : public LargeBodyShape {
 public:
  Described(const LargeBodyShape &of, const Vector3<double> &velocity, double curvature) :
      of(of), velocity(velocity), curvature(curvature)
  {
  }
  bool touches(const Vector3<double> &x, double radius, SurfaceContact &contact) const override
  {
    contact.velocity = velocity;
    contact.curvature = curvature;
    contact.part = 3;
    const bool any = of.touches(x, radius, contact);
    contact.part = 3;
    return any;
  }
  double distance_bound(const Vector3<double> &x) const override { return of.distance_bound(x); }
  Vector3<double> reference_point() const override { return of.reference_point(); }
  bool describes_surface() const override { return true; }

 private:
  const LargeBodyShape &of;
  Vector3<double> velocity;
  double curvature;
};

// As the same surface at rest sees particles that move the other way.
TEST_P(BodyContactsTest, ASurfaceThatMovesByItself)
{
  const Described moving(*shape, {0.5, -2.0, 0.25}, 0.0);
  find();
  ComputedContacts told;
  told.begin(true);
  BodyStep step = step_of(true);
  step.for_outputs = &told;
  force.assign(p.size(), Vector{});
  torque.assign(p.size(), Vector{});
  contacts.compute(moving, frame, view(), step);
  int count = 0;
  told.for_each([&](const ContactReport &one) { count += one.part == 3; });
  EXPECT_GT(count, 20);
  const std::vector<Vector> seen = force;

  for (Vector &v : p.v) v = {v[0] - 0.5, v[1] + 2.0, v[2] - 0.25};
  BodyContacts others;
  others.set_laws(laws);
  others.history.keep(false);
  others.find_candidates(*shape, frame, view(), mask.data(), 1, skin, threads());
  force.assign(p.size(), Vector{});
  torque.assign(p.size(), Vector{});
  others.compute(*shape, frame, view(), step_of(true));
  EXPECT_EQ(force, seen);
}

// R_eff of Hertz is that of both surfaces.
TEST_P(BodyContactsTest, ACurvedSurface)
{
  contacts.set_laws(single_law({named::Normal::HERTZ, named::Tangential::MULTISTEP}, true));
  std::fill(p.v.begin(), p.v.end(), Vector{});
  std::fill(p.omega.begin(), p.omega.end(), Vector{});
  find();
  compute(false);
  const std::vector<Vector> of_flat = force;
  const double curvature = -0.3;
  force.assign(p.size(), Vector{});
  contacts.compute(Described(*shape, {0.0, 0.0, 0.0}, curvature), frame, view(), step_of(false));
  int touching = 0;
  for (int i = 0; i < p.size(); i++) {
    const double factor = 1.0 / std::sqrt(1.0 + curvature * p.radius[i]);
    touching += norm(force[i]) > 0.0;
    ASSERT_LE(norm(axpy(-factor, of_flat[i], force[i])), 1e-13 * norm(force[i])) << i;
  }
  EXPECT_GT(touching, 20);
}

TEST_P(BodyContactsTest, OtherMasses)
{
  std::vector<double> masses;
  for (int i = 0; i < p.size(); i++) masses.push_back((1.0 + i % 3) * p.mass[i]);
  find();
  BodyStep step = step_of(false);
  step.masses = masses.data();
  force.assign(p.size(), Vector{});
  torque.assign(p.size(), Vector{});
  contacts.compute(*shape, frame, view(), step);
  const std::vector<Vector> of_step = force;
  std::copy(masses.begin(), masses.end(), p.mass.begin());
  std::fill(p.mass_override.begin(), p.mass_override.end(), 0.0);
  compute(false);
  EXPECT_EQ(force, of_step);
}

TEST_P(BodyContactsTest, OnlyMembersOfTheGroupAreTouched)
{
  for (int i = 0; i < p.size(); i++) mask[i] = i % 2 ? 1 | 8 : 2 | 8;
  find();
  compute(true);
  int pushed = 0;
  for (int i = 0; i < p.size(); i++) {
    SurfaceContact surface;
    const bool feels = force[i] != Vector{};
    ASSERT_LE(feels, i % 2 == 1 && touches(i, surface)) << i;
    pushed += feels;
  }
  EXPECT_GT(pushed, 10);
}

TEST_P(BodyContactsTest, NoParticlesNoLoad)
{
  p = random_packing(0, random);
  const ParticleState nothing;
  contacts.find_candidates(*shape, frame, nothing, nullptr, 1, skin);
  const BodyLoad load = contacts.compute(*shape, frame, nothing, step_of(true));
  EXPECT_EQ(load.contacts, 0.0);
  EXPECT_EQ(dot(load.force, load.force) + dot(load.torque, load.torque), 0.0);
}

INSTANTIATE_TEST_SUITE_P(ShapesAndLaws, BodyContactsTest, testing::Values(0, 1, 2, 3));

}    // namespace
