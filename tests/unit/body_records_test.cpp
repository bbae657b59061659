// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts with bodies of particles that live in the records, against the same in the host's
// arrays: every bit, the histories, and the load.

#include "base/in_parallel.h"
#include "body/contact/body_contacts.h"
#include "body/shape/ball.h"
#include "body/shape/plane.h"
#include "histories_of.h"
#include "packing.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

using namespace Talus;
using namespace slow;

namespace {

constexpr double dt = 1e-3, skin = 0.2;

struct Scene {
  std::string name;
  LawTable laws;
};

LawTable resisting(bool delayed)
{
  LawTable table;
  table.reset(num_types);
  named::NamedLaw law{named::Normal::HERTZ, named::Tangential::MULTISTEP, true};
  law.delayed = delayed;
  named::Numbers c{800.0, 3.0, 300.0, 5.0, 0.3, -infinity};
  c.mu_roll = 0.1;
  c.mu_twist = 0.2;
  for (int i = 1; i <= num_types; i++)
    for (int j = i; j <= num_types; j++) named::set(table, i, j, law, c);
  table.finish();
  return table;
}

std::vector<Scene> scenes()
{
  const named::NamedLaw smooth{named::Normal::HERTZ, named::Tangential::NONE},
      rough{named::Normal::HERTZ, named::Tangential::MULTISTEP};
  return {{"mixed", mixed_laws()},
          {"smooth", single_law(smooth, true)},
          {"rough", single_law(rough, false)},
          {"spread", single_law(rough, true)},
          {"resisting", resisting(false)},
          {"delayed", resisting(true)}};
}

/// Two planes in a corner and a ball: particles touch several of them.
class BodyRecordsTest : public testing::TestWithParam<int> {
 protected:
  static constexpr int num_bodies = 3;
  struct Body {
    std::unique_ptr<LargeBodyShape> shape;
    BodyFrame frame;
    BodyContacts in_arrays, in_records;
  };

  BodyRecordsTest() : laws(scenes()[GetParam()].laws), p(random_packing(1500, random))
  {
    bodies[0].shape = std::make_unique<Plane>(V{0.5, -0.3, 0.2}, V{0.6, 0.0, 0.8}, false);
    bodies[1].shape = std::make_unique<Plane>(V{0.5, -0.3, 0.2}, V{0.0, 1.0, 0.0}, true);
    bodies[2].shape = std::make_unique<Ball>(V{0.0, 0.0, 0.0}, 3.0, false);
    for (Body &body : bodies) {
      body.frame.origin = body.shape->reference_point();
      for (BodyContacts *contacts : {&body.in_arrays, &body.in_records}) {
        contacts->set_laws(laws);
        contacts->history.keep(false);
      }
    }
    mask.assign(p.size(), 1);
    force.resize(p.size());
    torque.resize(p.size());
  }

  using V = Vector3<double>;

  ParticleView host()
  {
    return {p.x[0].data(), p.v[0].data(),          p.omega[0].data(), p.radius.data(),
            p.mass.data(), p.mass_override.data(), force[0].data(),   torque[0].data()};
  }

  ParticleState view(bool of_records)
  {
    if (!of_records) return {p.size(), host(), p.type.data()};
    return {p.size(), host(), p.type.data(), &records, order.slot_of_atom.data()};
  }

  /// New lists, as after a rebuild: slots change.
  void find()
  {
    random.shuffle(p.tag);
    p.refresh_keys(random.uniform(0.3, 1.0));
    order.arrange(p.size(), p.key, p.tag);
    records.resize(p.size(), laws.has_friction(), laws.has_resistance());
    for (Body &body : bodies)
      for (BodyContacts *contacts : {&body.in_arrays, &body.in_records})
        contacts->find_candidates(*body.shape, body.frame, view(false), mask.data(), 1, skin);
  }

  /// Forces that particles have from each other, the same in records and arrays.
  void load_particles()
  {
    records.read(order, host(), {0, p.size()});
    for (int i = 0; i < p.size(); i++) {
      const int slot = order.slot_of_atom[i];
      Record *const load = &records.load[records.stride * slot];
      force[i] = random.in_cube(10.0);
      torque[i] = {};
      for (int d = 0; d < 3; d++) load->c[d] = force[i][d];
      if (records.stride == 1) continue;
      for (int d = 0; d < 3; d++) {
        load[1].c[d] = random.uniform(-5.0, 5.0);
        if (laws.has_resistance()) records.twisting_torque[slot].c[d] = random.uniform(-5.0, 5.0);
      }
      for (int d = 0; d < 3; d++) torque[i][d] = records.torque(slot)[d];
    }
  }

  void expect_same_forces()
  {
    for (int i = 0; i < p.size(); i++) {
      const int slot = order.slot_of_atom[i];
      for (int d = 0; d < 3; d++) {
        ASSERT_EQ(records.load[records.stride * slot].c[d], force[i][d]) << i;
        const double expected_torque = records.stride == 2 ? records.torque(slot)[d] : torque[i][d];
        ASSERT_EQ(expected_torque, torque[i][d]) << i;
      }
    }
  }

  void expect_same_histories(Body &body)
  {
    for (int i = 0; i < p.size() && laws.has_history(); i++)
      ASSERT_EQ(histories_of(body.in_arrays.history, i), histories_of(body.in_records.history, i))
          << i;
  }

  /// As threads do it that deal with three ranges of the slots, at the same time.
  BodyLoad add_in_ranges(Body &body, BodyStep step)
  {
    step.threads = 3;
    const ParticleState of_records = view(true);
    EXPECT_TRUE(body.in_records.begin_static(*body.shape, body.frame, of_records, step));
    const int a = random.below(p.size()), b = random.below(p.size());
    const int ends[] = {0, std::min(a, b), std::max(a, b), p.size()};
    in_parallel(3, 3, [&](int t) { body.in_records.add_to_slots(t, ends[t], ends[t + 1]); });
    return body.in_records.static_load();
  }

  static void expect_near(const V &a, const V &b, double scale)
  {
    const V d = a - b;
    EXPECT_LE(std::sqrt(dot(d, d)), 1e-14 * scale);
  }

  RandomSource random{77};
  LawTable laws;
  Packing p;
  Body bodies[num_bodies];
  ParticleOrder order;
  ParticleRecords records;
  std::vector<int> mask;
  std::vector<Vector> force, torque;
};

TEST_P(BodyRecordsTest, SameBitsAsInArrays)
{
  double contacts = 0.0;
  for (int n = 0; n < 12; n++) {
    if (n % 4 == 0) find();
    load_particles();
    BodyStep step;
    step.dt = dt;
    step.advance = n != 0 && n != 6;
    for (Body &body : bodies) {
      const BodyLoad expected = body.in_arrays.compute(*body.shape, body.frame, view(false), step);
      BodyStep threaded = step;
      threaded.threads = n % 3 == 1 ? 3 : 1;
      // now and then a step is made in the arrays, by the same contacts
      const bool stays = n % 5 != 4;
      const std::vector<Vector> expected_force = force, expected_torque = torque;
      const BodyLoad found = stays && n % 3 == 2 ? add_in_ranges(body, step)
                                                 : body.in_records.compute(*body.shape, body.frame,
                                                                           view(stays), threaded);
      force = expected_force;
      torque = expected_torque;
      ASSERT_EQ(found.contacts, expected.contacts);
      expect_near(found.force, expected.force, 1e4 * found.contacts);
      expect_near(found.torque, expected.torque, 1e5 * found.contacts);
      expect_same_histories(body);
      contacts += found.contacts;
    }
    if (n % 5 != 4) expect_same_forces();
    p.move(5.0 * dt, 0.1, random);
  }
  EXPECT_GT(contacts, 12.0 * num_bodies * ContactBatch::width / 2);
}

TEST_P(BodyRecordsTest, WhatIsNoStaticWallIsNotBegun)
{
  find();
  load_particles();
  BodyStep step;
  step.dt = dt;
  Body &body = bodies[0];
  const ParticleState in_records = view(true), in_arrays = view(false);
  BodyContacts &contacts = body.in_records;
  EXPECT_TRUE(contacts.begin_static(*body.shape, body.frame, in_records, step));
  EXPECT_FALSE(contacts.begin_static(*body.shape, body.frame, in_arrays, step));
  ExactLoad exact;
  BodyStep with_exact_load = step;
  with_exact_load.exact = &exact;
  EXPECT_FALSE(contacts.begin_static(*body.shape, body.frame, in_records, with_exact_load));
  body.frame.moves = true;
  EXPECT_FALSE(contacts.begin_static(*body.shape, body.frame, in_records, step));
}

INSTANTIATE_TEST_SUITE_P(Laws, BodyRecordsTest,
                         testing::Range(0, static_cast<int>(scenes().size())),
                         [](const testing::TestParamInfo<int> &info) {
                           return scenes()[info.param].name;
                         });

}    // namespace
