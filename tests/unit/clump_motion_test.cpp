// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Clumps one by one and eight at a time, free rotation, and the reference in RigidBody.

#include "base/lanes.h"
#include "body/motion/clump_motion.h"
#include "body/motion/free_rotation.h"
#include "body/motion/rigid_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Talus {
namespace {

ClumpState<double> top(double spin)
{
  ClumpState<double> s{};
  s.mass = 2.0;
  s.inverse_inertia = {1.0 / 0.1, 1.0 / 0.25, 1.0 / 0.3};
  s.position = {0.3, -2.0, 7.0};
  s.velocity = {1.0, 0.2, -0.7};
  s.momentum = {-0.13 * spin, 0.02 * spin, -0.2475 * spin};
  s.quat = Quaternion<double>{0.3, 0.1, 0.7, -0.2}.normalized();
  s.axes = s.quat.axes();
  s.omega = s.omega_now();
  return s;
}

double energy(const ClumpState<double> &s)
{
  return 0.5 * dot(s.momentum, s.omega_now());
}

ClumpState<Vec8> eight(const ClumpState<double> *of)
{
  const auto lane = [&](auto which) {
    alignas(64) double values[lanes];
    for (int k = 0; k < lanes; k++) values[k] = which(of[k]);
    return load8(values);
  };
  const auto vector = [&](auto which) {
    return Vector3<Vec8>{lane([&](const auto &s) { return which(s).x; }),
                         lane([&](const auto &s) { return which(s).y; }),
                         lane([&](const auto &s) { return which(s).z; })};
  };
  using One = ClumpState<double>;
  ClumpState<Vec8> s{};
  s.mass = lane([](const One &o) { return o.mass; });
  s.inverse_inertia = vector([](const One &o) { return o.inverse_inertia; });
  s.position = vector([](const One &o) { return o.position; });
  s.velocity = vector([](const One &o) { return o.velocity; });
  s.momentum = vector([](const One &o) { return o.momentum; });
  s.quat = {
      lane([](const One &o) { return o.quat.w; }), lane([](const One &o) { return o.quat.x; }),
      lane([](const One &o) { return o.quat.y; }), lane([](const One &o) { return o.quat.z; })};
  s.axes = s.quat.axes();
  s.omega = s.omega_now();
  return s;
}

void expect_lane(const Vec8 &all, int k, double one)
{
  alignas(64) double values[lanes];
  store(values, all);
  EXPECT_EQ(values[k], one) << "lane " << k;
}

TEST(ClumpMotion, EightAtATimeHaveTheBitsOfOneByOne)
{
  ClumpState<double> one[lanes];
  for (int k = 0; k < lanes; k++) one[k] = top(k == 3 ? 900.0 : 0.3 * k);    // one turns far
  ClumpState<Vec8> all = eight(one);
  const auto motion = [](auto &s) {
    using Real = decltype(s.mass);
    s.kick(0.01, in_all_lanes<Real>({1.0, -2.0, 3.0}), in_all_lanes<Real>({0.1, 0.3, -0.2}));
    s.drift_freely(0.01);
    s.drift_extrapolated(0.01);
  };
  for (int step = 0; step < 20; step++) {
    motion(all);
    for (ClumpState<double> &clump : one) motion(clump);
  }
  for (int k = 0; k < lanes; k++) {
    expect_lane(all.position.x, k, one[k].position.x);
    expect_lane(all.velocity.y, k, one[k].velocity.y);
    expect_lane(all.momentum.z, k, one[k].momentum.z);
    expect_lane(all.omega.x, k, one[k].omega.x);
    expect_lane(all.quat.w, k, one[k].quat.w);
    expect_lane(all.quat.z, k, one[k].quat.z);
  }
}

TEST(ClumpMotion, FreeRotationIsOfSecondOrderAndKeepsItsMomentum)
{
  double last = 0.0;
  for (const double dt : {0.02, 0.01, 0.005}) {
    ClumpState<double> s = top(1.0);
    const double at_first = energy(s);
    double worst = 0.0;
    for (int n = 0; n < std::lround(40.0 / dt); n++) {
      s.drift_freely(dt);
      worst = std::fmax(worst, std::fabs(energy(s) / at_first - 1.0));
    }
    EXPECT_LT(length(s.omega - s.omega_now()), 1e-13);    // of the momentum that has turned with it
    EXPECT_LT(worst, 1e-4);
    if (last > 0.0) {
      EXPECT_GT(last / worst, 3.5);
    }
    last = worst;
  }
}

/* The error of the energy goes round with the body; it does not grow. */

TEST(ClumpMotion, EnergyDoesNotDrift)
{
  ClumpState<double> s = top(1.0);
  const double at_first = energy(s);
  double early = 0.0, late = 0.0;
  constexpr int steps = 1000000;
  for (int n = 0; n < steps; n++) {
    s.drift_freely(0.02);
    double &worst = n < steps / 10 ? early : late;
    worst = std::fmax(worst, std::fabs(energy(s) / at_first - 1.0));
  }
  std::printf("energy: %.3e in the first tenth, %.3e after\n", early, late);
  EXPECT_LT(late, 1.01 * early);
  EXPECT_GT(early, 1e-7);
}

/* Bodies, particles with axes of their own and clumps. */

TEST(ClumpMotion, AllBodiesTurnInOneWay)
{
  ClumpState<double> s = top(1.0);
  RigidBody body;
  body.mass = s.mass;
  const double moments[3] = {0.1, 0.25, 0.3};
  std::copy(moments, moments + 3, body.inertia);
  BodyState state;
  state.orientation = {s.quat.w, s.quat.x, s.quat.y, s.quat.z};
  state.omega = s.omega;
  state.velocity = s.velocity;
  state.position = s.position;
  // the same body in axes of its own, with the moments in another order
  const Eigen::Quaterniond oblique =
      Eigen::Quaterniond(Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.0, 0.6, 0.8)));
  const Eigen::Quaterniond swapped(Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitZ()));
  const FreeRotation other({0.25, 0.1, 0.3}, oblique * swapped);
  Eigen::Quaterniond q = state.orientation * oblique.conjugate();
  Vector3<double> omega = s.omega;
  for (int n = 0; n < 1000; n++) {
    s.drift_freely(0.01);
    body.advance(state, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.01);
    other.advance(q, omega, {0.0, 0.0, 0.0}, 0.01);
  }
  EXPECT_NEAR(s.quat.w, state.orientation.w(), 1e-11);
  EXPECT_NEAR(s.quat.y, state.orientation.y(), 1e-11);
  EXPECT_NEAR(s.omega.x, state.omega.x, 1e-11);
  EXPECT_NEAR(s.position.z, state.position.z, 1e-11);
  EXPECT_LT(length(omega - s.omega), 1e-11);
  EXPECT_LT(state.orientation.angularDistance(q * oblique), 1e-11);
}

TEST(ClumpMotion, SmallAndLargeAnglesMeet)
{
  for (const double speed : {6.3, 6.33}) {    // on both sides of the end of the series
    const Quaternion<double> t = rotation_in(Vector3<double>{0.0, speed, 0.0}, 0.01);
    EXPECT_NEAR(t.w, std::cos(0.005 * speed), 1e-16);
    EXPECT_NEAR(t.y, std::sin(0.005 * speed), 1e-16);
  }
}

}    // namespace
}    // namespace Talus
