// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Bodies that have been moved and turned, and that move: the contacts of a body with several
// contacts per particle are those of the same scene at rest, seen from elsewhere; histories follow
// their contacts; the load is that of Newton's third law, with and without rounding.

#include "body/contact/body_contacts.h"
#include "body/shape/box.h"
#include "histories_of.h"
#include "packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace Talus;
using slow::Packing, slow::plain, slow::talus;

namespace {

using V = Vector3<double>;
constexpr double dt = 1e-3, skin = 0.3;

LawTable resisting_law()
{
  LawTable table;
  table.reset(slow::num_types);
  named::Numbers c;
  c.kn = 800.0;
  c.gn = 3.0;
  c.kt = 300.0;
  c.gt = 2.0;
  c.mu = 0.3;
  c.mu_roll = 0.1;
  c.mu_twist = 0.1;
  c.force_floor = -1.0e300;
  named::NamedLaw law{named::Normal::HERTZ, named::Tangential::MULTISTEP};
  law.resists = true;
  for (int i = 1; i <= slow::num_types; i++)
    for (int j = i; j <= slow::num_types; j++) named::set(table, i, j, law, c);
  table.finish();
  return table;
}

/// A box full of particles, its walls touched at faces, edges and corners.
class Scene {
 public:
  Scene(const BodyFrame &body_frame, int threads) :
      random(3), p(slow::random_packing(500, random)), frame(body_frame), threads(threads)
  {
    frame.origin = box.reference_point();
    contacts.set_laws(resisting_law());
    contacts.history.keep(true);
    mask.assign(p.size(), 1);
    for (int i = 0; i < p.size(); i++) {    // to where the body is, moving with it
      const V x = frame.point_to_space(talus(p.x[i]));
      V v = frame.to_space(talus(p.v[i])), w = frame.to_space(talus(p.omega[i]));
      if (frame.moves) {
        v = v + frame.velocity_at(x);
        w = w + frame.state.omega;
      }
      p.x[i] = plain(x);
      p.v[i] = plain(v);
      p.omega[i] = plain(w);
    }
  }

  ParticleState view()
  {
    return {p.size(),
            {p.x[0].data(), p.v[0].data(), p.omega[0].data(), p.radius.data(), p.mass.data(),
             nullptr, force[0].data(), torque[0].data()},
            p.type.data()};
  }

  void step(bool list)
  {
    force.assign(p.size(), slow::Vector{});
    torque.assign(p.size(), slow::Vector{});
    if (list) contacts.find_candidates(box, frame, view(), mask.data(), 1, skin, 3);
    BodyStep how;
    how.dt = dt;
    how.threads = threads;
    how.exact = &exact;
    load = contacts.compute(box, frame, view(), how);
  }

  RandomSource random;
  Packing p;
  BodyFrame frame;
  int threads;
  Box box{{0.2, -0.1, 0.3}, {9.0, 8.0, 7.0}, true};
  BodyContacts contacts;
  std::vector<int> mask;
  std::vector<slow::Vector> force, torque;
  BodyLoad load;
  ExactLoad exact;
};

BodyFrame moved_frame()
{
  BodyState state;
  state.position = {3.0, -7.0, 5.0};
  state.orientation = Eigen::AngleAxisd(0.8, Eigen::Vector3d(0.6, 0.0, 0.8));
  state.velocity = {1.0, 0.5, -2.0};
  state.omega = {0.3, -0.4, 0.2};
  BodyFrame frame;
  frame.moves = true;
  frame.set(state);
  return frame;
}

TEST(BodyFrameTest, ForcesAreThoseOfTheSceneAtRest)
{
  Scene rest({}, 1), moved(moved_frame(), 2);
  for (int step = 0; step < 10; step++) {
    rest.step(step == 0);
    moved.step(step % 4 == 0);
    ASSERT_EQ(rest.load.contacts, moved.load.contacts);
    double worst = 0.0, scale = 0.0;
    for (int i = 0; i < rest.p.size(); i++) {
      const V f = moved.frame.to_space(talus(rest.force[i])),
              t = moved.frame.to_space(talus(rest.torque[i]));
      worst =
          std::max({worst, length(f - talus(moved.force[i])), length(t - talus(moved.torque[i]))});
      scale = std::max(scale, length(f));
    }
    ASSERT_LT(worst, 1e-11 * scale) << step;
    const V torque = moved.frame.to_space(rest.load.torque);
    ASSERT_LT(length(torque - moved.load.torque), 1e-9 * scale);
  }
  int several = 0, touching = 0;
  for (int i = 0; i < rest.p.size(); i++) {
    const std::size_t count = histories_of(rest.contacts.history, i).size();
    ASSERT_EQ(histories_of(moved.contacts.history, i).size(), count);
    several += count > 1;
    touching += count > 0;
  }
  EXPECT_GT(touching, 100);
  EXPECT_GT(several, 20);
}

TEST(BodyFrameTest, LoadBalancesAndIsTheSameFromAnyNumberOfThreads)
{
  Scene one(moved_frame(), 1), three(moved_frame(), 3);
  for (int step = 0; step < 5; step++) {
    one.step(step == 0);
    three.step(step == 0);
  }
  V force{0, 0, 0}, torque{0, 0, 0};
  double scale = 0.0;
  for (int i = 0; i < one.p.size(); i++) {
    ASSERT_EQ(one.force[i], three.force[i]);
    ASSERT_EQ(one.torque[i], three.torque[i]);
    const V f = talus(one.force[i]), arm = talus(one.p.x[i]) - one.frame.state.position;
    force = force + f;
    torque = torque + cross(arm, f) + talus(one.torque[i]);
    scale += length(f) * (1.0 + length(arm));
  }
  EXPECT_LT(length(force + one.load.force), 1e-14 * scale);
  EXPECT_LT(length(torque + one.load.torque), 1e-14 * scale);
  for (int k = 0; k < 6; k++)
    EXPECT_EQ(one.exact.component[k].value(), three.exact.component[k].value());
  EXPECT_NEAR(one.exact.component[0].value(), one.load.force.x, 1e-12 * scale);
  EXPECT_NEAR(one.exact.component[5].value(), one.load.torque.z, 1e-12 * scale);
}

}    // namespace
