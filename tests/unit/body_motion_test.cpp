// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How bodies move: rotations, prescribed motions and their clock, guided motion, free rigid bodies,
// and bodies that hold a force.

#include "base/state_numbers.h"
#include "body/motion/body_state.h"
#include "body/motion/external_motion.h"
#include "body/motion/prescribed_motion.h"
#include "body/motion/rigid_body.h"
#include "body/motion/servo_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace Talus;

namespace {

using V = Vector3<double>;
const double pi = std::acos(-1.0);
const Eigen::Quaterniond one = Eigen::Quaterniond::Identity();

/* As a restart file takes it. */

template <class Part> Part copied_through_numbers(Part &part)
{
  std::vector<double> numbers;
  StateNumbers writing(numbers);
  part.exchange_state(writing);
  Part copy;
  StateNumbers reading(numbers.data(), numbers.data() + numbers.size());
  copy.exchange_state(reading);
  EXPECT_TRUE(reading.fits());
  return copy;
}

TEST(BodyRotation, TurnsAndTurnsBack)
{
  const V axis{0.6, 0.0, 0.8}, v{0.3, -1.0, 2.0};
  BodyFrame r;
  BodyState state;
  state.orientation = rotation_by(axis, 1.1);
  r.set(state);
  // Rodrigues
  const V expected = std::cos(1.1) * v + std::sin(1.1) * cross(axis, v) +
                     (dot(axis, v) * (1.0 - std::cos(1.1))) * axis;
  EXPECT_NEAR(length(r.to_space(v) - expected), 0.0, 1e-15);
  EXPECT_NEAR(length(r.to_body(r.to_space(v)) - v), 0.0, 1e-15);
  for (int k = 0; k < 3; k++) {    // eight vectors at a time: the same bits
    const Vector3<Vec8> eight = r.to_space(in_all_lanes<Vec8>(v)),
                        back = r.to_body(in_all_lanes<Vec8>(v));
    EXPECT_EQ(eight.x[3 * k], r.to_space(v).x);
    EXPECT_EQ(eight.z[3 * k], r.to_space(v).z);
    EXPECT_EQ(back.y[3 * k], r.to_body(v).y);
  }
}

// What contacts of second order see: the rate at which a point moves in the axes of the body.
TEST(BodyKinematics, SeesVelocitiesInTheFrameOfTheBody)
{
  const auto turning = PrescribedMotion::rotate({0.5, 0.0, 1.0}, {0.0, 0.6, 0.8}, 3.0);
  const V v{0.3, -1.0, 0.7}, start{1.0, 2.0, 3.0}, x{0.2, 0.9, -0.4};
  const double h = 1e-5;
  const auto place = [&](double t) {    // of the point, in the frame of the body
    BodyFrame frame;
    frame.moves = true;
    frame.set(turning.at(t, start));
    return frame.point_to_body(x + (t - 0.7) * v);
  };
  BodyKinematics kinematics;
  kinematics.set(turning.at(0.7, start));
  const V seen = 0.5 / h * (place(0.7 + h) - place(0.7 - h));
  EXPECT_NEAR(length(kinematics.velocity_seen(v, x) - seen), 0.0, 1e-8);
  EXPECT_NEAR(length(kinematics.omega_seen(kinematics.omega)), 0.0, 1e-15);
}

TEST(BodyKinematics, HalfWayOfATurn)
{
  const auto turning = PrescribedMotion::rotate({0.5, 0.0, 1.0}, {0.0, 0.6, 0.8}, 3.0);
  const V start{1.0, 2.0, 3.0};
  const double h = 1e-3;
  const BodyState half_way =
      half_way_between(turning.at(0.7 - h, start), turning.at(0.7 + h, start));
  const BodyState exact = turning.at(0.7, start);
  EXPECT_NEAR(length(half_way.position - exact.position), 0.0, 10.0 * h * h);
  EXPECT_NEAR(half_way.orientation.angularDistance(exact.orientation), 0.0, 1e-7);
}

TEST(BodyMotion, PrescribedStatesAndTheirVelocities)
{
  const V start{1.0, 2.0, 3.0}, point{0.5, 0.0, 1.0}, axis{0.0, 0.6, 0.8};
  const double h = 1e-5;
  for (const PrescribedMotion &m :
       {PrescribedMotion::linear({1.0, -2.0, 0.5}), PrescribedMotion::wiggle({0.3, 0.0, 1.0}, 2.5),
        PrescribedMotion::rotate(point, axis, 3.0)}) {
    const BodyState before = m.at(0.7 - h, start), now = m.at(0.7, start),
                    after = m.at(0.7 + h, start);
    EXPECT_NEAR(length(0.5 / h * (after.position - before.position) - now.velocity), 0.0, 1e-8);
    EXPECT_EQ(length(m.at(0.0, start).position - start), 0.0);
    EXPECT_NEAR(after.orientation.angularDistance(before.orientation), 2.0 * h * length(now.omega),
                1e-12);
  }
  const BodyState quarter = PrescribedMotion::rotate({0, 0, 0}, {0, 0, 1}, 4.0).at(1.0, {1, 0, 5});
  EXPECT_NEAR(length(quarter.position - V{0, 1, 5}), 0.0, 1e-15);
  EXPECT_NEAR(length(quarter.velocity - V{-0.5 * pi, 0, 0}), 0.0, 1e-15);
}

TEST(BodyMotion, ClockDoesNotDependOnInterruptions)
{
  MotionClock a, b;
  for (int step = 1; step <= 1000; step++) a.read(step, 1e-3);
  const MotionClock restarted = a;
  MotionClock c = restarted;
  EXPECT_EQ(c.read(1500, 1e-3), b.read(1500, 1e-3));
  // another time step from step 1500 on
  for (int step = 1501; step <= 1600; step++) a.read(step, 2e-3);
  EXPECT_NEAR(a.read(1600, 2e-3), 1.5 + 0.2, 1e-12);
  // a new run is set up with another time step: the time there is still that of the steps so far
  EXPECT_EQ(a.at(1600), a.read(1600, 2e-3));
  EXPECT_NEAR(a.read(1601, 5e-3), 1.7 + 0.005, 1e-12);
}

TEST(BodyMotion, GuidedBodyReachesTheGivenBits)
{
  BodyState state, target;
  target.position = {1.0 / 3.0, 0.1, -0.7};
  target.orientation = rotation_by({0.0, 0.0, 1.0}, 0.9);
  target.velocity = {1.0, 2.0, 3.0};
  target.omega = {0.0, 0.0, 0.5};
  ExternalMotion guide;
  guide.guide(state, target, 4);
  const double way[] = {0.25, 0.5, 0.75};
  for (const double w : way) {
    guide.advance(state, 0.1);
    EXPECT_NEAR(length(state.position - w * target.position), 0.0, 1e-15);
    EXPECT_NEAR(state.orientation.angularDistance(one), 0.9 * w, 1e-14);
    EXPECT_NEAR(length(state.velocity - w * target.velocity), 0.0, 1e-15);
  }
  ExternalMotion restarted = copied_through_numbers(guide);
  restarted.advance(state, 0.1);
  double found[BodyState::size], expected[BodyState::size];
  state.to_array(found);
  target.to_array(expected);
  EXPECT_TRUE(std::equal(found, found + BodyState::size, expected));
  restarted.advance(state, 0.1);    // on its own from here
  EXPECT_NEAR(length(state.position - target.position - 0.1 * target.velocity), 0.0, 1e-15);
}

TEST(BodyMotion, LargestDisplacementBounds)
{
  BodyFrame a, b;
  a.moves = b.moves = true;
  BodyState s;
  s.position = {0.1, 0.0, 0.0};
  s.orientation = rotation_by({0, 1, 0}, 0.05);
  b.set(s);
  double most = 0.0;
  for (int k = 0; k < 64; k++) {
    const V p{3.0 * std::cos(0.1 * k), 0.0, 3.0 * std::sin(0.1 * k)};
    most = std::max(most, length(b.point_to_space(p) - a.point_to_space(p)));
  }
  EXPECT_LE(most, largest_displacement(a, b, 3.0));
  EXPECT_GT(most, 0.9 * largest_displacement(a, b, 3.0));
}

/// Largest relative drift of energy and angular momentum of a free asymmetric top over a time
/// of 20.
struct Drift {
  double energy, momentum;
};

Drift drift(double dt)
{
  RigidBody body;
  body.mass = 2.0;
  body.inertia[0] = 1.0;
  body.inertia[1] = 2.0;
  body.inertia[2] = 2.5;
  BodyState state;
  state.omega = {0.2, 1.5, 0.3};    // near the unstable axis: it tumbles
  const double e0 = body.kinetic_energy(state);
  const V l0 = body.angular_momentum(state);
  Drift worst{0.0, 0.0};
  for (int n = 0; n < static_cast<int>(20.0 / dt + 0.5); n++) {
    body.advance(state, {0, 0, 0}, {0, 0, 0}, dt);
    worst.energy = std::max(worst.energy, std::fabs(body.kinetic_energy(state) / e0 - 1.0));
    worst.momentum =
        std::max(worst.momentum, length(body.angular_momentum(state) - l0) / length(l0));
  }
  return worst;
}

TEST(RigidBodyTest, FreeTopKeepsEnergyAndAngularMomentum)
{
  double last = 0.0;
  for (const double dt : {4e-2, 2e-2, 1e-2, 5e-3}) {
    const Drift d = drift(dt);
    std::printf("dt %.4f: energy drifts by %.2e, angular momentum by %.1e\n", dt, d.energy,
                d.momentum);
    EXPECT_LT(d.momentum, 1e-12);
    if (last > 0.0) {
      EXPECT_GT(last / d.energy, 3.3);    // second order
    }
    last = d.energy;
  }
  EXPECT_LT(last, 1e-5);
}

TEST(RigidBodyTest, EnergyDoesNotDrift)
{
  for (const bool lock : {false, true}) {
    RigidBody body;
    body.mass = 2.0;
    body.inertia[0] = 2.0;
    body.inertia[1] = 1.0;
    body.inertia[2] = 2.5;
    body.locked[4] = lock;
    BodyState state;
    state.orientation = rotation_by({1.0, 0.3, 0.5}, 0.4);
    state.omega = {1.5, lock ? 0.0 : 0.2, 0.3};
    const double e0 = body.kinetic_energy(state);
    const V l0 = body.angular_momentum(state);
    double early = 0.0, late = 0.0;
    constexpr int steps = 200000;
    for (int n = 0; n < steps; n++) {
      body.advance(state, {0, 0, 0}, {0, 0, 0}, 0.02);
      double &worst = n < steps / 10 ? early : late;
      worst = std::max(worst, std::fabs(body.kinetic_energy(state) / e0 - 1.0));
    }
    std::printf("lock %d: energy %.2e in the first tenth, %.2e after\n", lock, early, late);
    EXPECT_LT(late, 1.05 * early);
    EXPECT_LT(late, 1e-3);
    EXPECT_GT(early, 1e-7);
    EXPECT_LT(length(body.angular_momentum(state) - l0) / length(l0), 1e-9);
  }
}

TEST(RigidBodyTest, BallTurnsAsAParticleDoes)
{
  RigidBody body;
  body.mass = 3.0;
  body.inertia[0] = body.inertia[1] = body.inertia[2] = 0.4;
  BodyState state;
  state.velocity = {1, 0, 0};
  state.omega = {0, 0.5, 0};
  V v = state.velocity, w = state.omega, x = state.position;
  for (int n = 0; n < 500; n++) {
    const V a{0.1, std::sin(0.01 * n), -1.0}, torque{0.3, -0.2, std::cos(0.02 * n)};
    body.advance(state, a, torque, 1e-3);
    v = v + 1e-3 * a;
    x = x + 1e-3 * v;
    w = w + (1e-3 / 0.4) * torque;
  }
  EXPECT_NEAR(length(state.position - x), 0.0, 1e-14);
  EXPECT_NEAR(length(state.omega - w), 0.0, 1e-13);
}

TEST(RigidBodyTest, LockedFreedomsStay)
{
  RigidBody body;
  body.mass = 1.0;
  body.inertia[0] = 1.0;
  body.inertia[1] = 2.0;
  body.inertia[2] = 2.5;
  body.locked[0] = body.locked[2] = body.locked[3] = body.locked[5] = true;
  BodyState state;
  state.orientation = rotation_by({1, 0, 0}, 0.3);
  const RigidBody free_body = body;
  for (int n = 0; n < 100; n++) body.advance(state, {1, 1, 1}, {1, 1, 1}, 1e-2);
  EXPECT_EQ(state.position.x, 0.0);
  EXPECT_NEAR(state.position.y, 0.5 * (1.0 + 0.01), 1e-12);
  EXPECT_EQ(state.omega.x, 0.0);
  EXPECT_EQ(state.omega.z, 0.0);
  EXPECT_TRUE(free_body.translates());
  // about the fixed y axis: its moment in space stays that of the turned body
  const double c = std::cos(0.3), s = std::sin(0.3);
  EXPECT_NEAR(state.omega.y, 1.0 / (2.0 * c * c + 2.5 * s * s), 1e-12);
}

TEST(ServoTest, HoldsAForceAgainstASpring)
{
  Servo servo;
  servo.axis = {0, 0, -1};
  servo.target = 50.0;
  servo.vmax = 0.2;
  BodyState state;
  double fastest = 0.0;
  const double stiffness = 1000.0;
  for (int n = 0; n < 4000; n++) {
    const double pressed = std::max(0.0, -0.1 - state.position.z) * stiffness;
    servo.advance(state, servo.wanted(pressed), 1e-3);
    fastest = std::max(fastest, std::fabs(state.velocity.z));
  }
  EXPECT_NEAR(state.position.z, -0.15, 1e-6);
  EXPECT_EQ(fastest, 0.2);
  EXPECT_NEAR(state.velocity.z, 0.0, 1e-5);

  servo.turns = true;
  state = BodyState{};
  servo.advance(state, servo.wanted(servo.pressed({9, 9, 9}, {0, 0, 0})), 1e-3);
  EXPECT_NEAR(length(state.omega - V{0, 0, -0.2}), 0.0, 1e-15);
  EXPECT_EQ(length(state.position), 0.0);
}

// A spring and a dashpot, from one that is hardly felt to one against which the speed would flip.
TEST(ServoTest, HoldsAForceAgainstAnyDamping)
{
  for (const double damping : {1.0, 200.0, 1.0e3, 1.0e4, 1.0e6})
    for (const double stiffness : {1.0e2, 1.0e4, 1.0e5}) {
      if (damping > 1.0e3 * stiffness) continue;    // takes hours to be at rest
      Servo servo;
      servo.axis = {0, 0, 1};
      servo.target = 10.0;
      servo.vmax = 0.2;
      ServoResponse response;
      BodyState state;
      const double dt = 5.0e-4;
      double rate = 0.0, at_rest = 0.0, worst = 0.0;
      const int steps = 40000 + static_cast<int>(damping / stiffness / dt * 20.0);
      for (int n = 0; n < steps; n++) {
        const double depth = state.position.z - 0.01;
        const double pressed =
            depth > 0.0 ? std::max(0.0, stiffness * depth + damping * rate) : 0.0;
        response.observe(rate, pressed);
        rate = servo.wanted(pressed);
        if (response.product(servo.slope()) > 0.7) rate = response.next_rate(rate, servo.slope());
        servo.advance(state, rate, dt);
        rate = servo.rate_of(state);
        if (n < steps - 2000) continue;
        at_rest += pressed / 2000.0;
        worst = std::max(worst, std::fabs(pressed - servo.target));
      }
      EXPECT_NEAR(at_rest, 10.0, 0.01) << damping << " " << stiffness;
      EXPECT_LT(worst, 0.5) << damping << " " << stiffness;
    }
}

TEST(ServoTest, DampingIsFoundAndForgotten)
{
  ServoResponse response;
  double rate = 0.1;
  const auto flip = [&](double damping) {
    rate = -rate;
    response.observe(rate, 3.0 + damping * rate);
  };
  for (int n = 0; n < 10; n++) flip(500.0);
  EXPECT_NEAR(response.damping(), 500.0, 1e-9);
  EXPECT_NEAR(response.product(1.0e-3), 0.5, 1e-12);
  EXPECT_NEAR(response.next_rate(1.0, 0.1), rate + (1.0 - rate) / 51.0, 1e-12);
  const ServoResponse copy = copied_through_numbers(response);
  EXPECT_EQ(copy.next_rate(1.0, 0.1), response.next_rate(1.0, 0.1));
  for (int n = 0; n < 100; n++) flip(0.0);    // nothing is touched
  EXPECT_LT(response.damping(), 1e-6);
  for (int n = 0; n < 100; n++) response.observe(0.1 * n, 3.0 - 50.0 * n);    // follows the force
  EXPECT_EQ(response.damping(), 0.0);
}

}    // namespace
