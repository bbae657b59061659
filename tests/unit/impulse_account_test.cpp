// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The account of impulses of a large body: which part of a load counts when, the point about which angular impulses are, and
// a million steps without rounding.

#include "body/contact/impulse_account.h"

#include <gtest/gtest.h>

#include <cmath>

namespace Talus {
namespace {

constexpr Vector3<double> none{0.0, 0.0, 0.0};

BodyLoad push(double fx)
{
  BodyLoad load;
  load.force = {fx, 0.0, 0.0};
  return load;
}

BodyFrame turned_by(double angle)
{
  BodyFrame frame;
  frame.moves = true;
  BodyState state;
  state.orientation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ());
  frame.set(state);
  return frame;
}

double impulse_of(ImpulseAccount &account)
{
  double sums[ImpulseAccount::size];
  account.take(sums);
  return sums[0];
}

TEST(ImpulseAccount, OneKickIsCountedWhenTheNextStepBegins)
{
  ImpulseAccount account(none);
  account.see({}, none, none);
  account.settle(push(3.0));
  EXPECT_EQ(impulse_of(account), 0.0);
  account.begin_step(push(3.0), 0.5, 0.0, 0.5);
  account.see({}, none, none);
  account.settle(push(7.0));
  EXPECT_EQ(impulse_of(account), 1.5);
}

TEST(ImpulseAccount, OfTwoKicksOneIsCountedAtTheEndOfTheStep)
{
  ImpulseAccount account(none);
  account.see({}, none, none);
  account.begin_step(push(3.0), 0.25, 0.25, 0.5);
  account.see({}, none, none);
  account.settle(push(7.0));
  account.settle(push(7.0));    // nothing happened in between
  EXPECT_EQ(impulse_of(account), 0.25 * (3.0 + 7.0));
  account.begin_step(push(7.0), 0.25, 0.25, 0.5);
  account.see({}, none, none);
  account.begin_step(push(8.0), 0.25, 0.25, 0.5);
  account.see({}, none, none);
  account.settle(push(9.0));
  EXPECT_EQ(impulse_of(account), 0.25 * (7.0 + 8.0 + 8.0 + 9.0));
}

/* The load of the set-up is not the one of the step before: commands may have changed it. */

TEST(ImpulseAccount, SetUpReplacesOnlyWhatIsToCome)
{
  ImpulseAccount account(none);
  account.see({}, none, none);
  account.begin_step(push(1.0), 0.25, 0.25, 0.5);
  account.see({}, none, none);
  account.settle(push(10.0));
  account.see({}, none, none);    // set-up
  account.begin_step(push(100.0), 0.25, 0.25, 0.5);
  account.see({}, none, none);
  account.settle(push(1000.0));
  EXPECT_EQ(impulse_of(account), 0.25 * 1111.0);
}

TEST(ImpulseAccount, WithoutALoadOnlyTimePasses)
{
  ImpulseAccount account(none);
  account.begin_step(push(1.0), 0.5, 0.0, 0.5);
  double sums[ImpulseAccount::size];
  account.take(sums);
  EXPECT_EQ(sums[0], 0.0);
  EXPECT_EQ(sums[7], 0.5);
}

TEST(ImpulseAccount, AngularImpulseIsAboutThePointOfTheBodyAsItIs)
{
  ImpulseAccount account({2.0, 0.0, 0.0});
  const BodyFrame frame = turned_by(0.5 * M_PI);    // the point is at (0, 2, 0)
  account.see(frame, none, none);
  BodyLoad load = push(3.0);
  load.torque = {0.0, 0.0, 1.0};    // about the reference point
  account.begin_step(load, 0.5, 0.0, 0.5);
  double sums[ImpulseAccount::size];
  account.take(sums);
  EXPECT_NEAR(sums[5], 0.5 * (1.0 - (0.0 * 0.0 - 2.0 * 3.0)), 1e-15);
}

TEST(ImpulseAccount, WorkIsThatOfForceAndTorque)
{
  ImpulseAccount account({2.0, 1.0, 0.0});    // does not matter
  account.see(turned_by(0.1), {0.5, 7.0, 0.0}, {0.0, 0.0, 4.0});
  BodyLoad load = push(3.0);
  load.torque = {0.0, 5.0, 0.25};
  account.begin_step(load, 0.5, 0.0, 0.5);
  double sums[ImpulseAccount::size];
  account.take(sums);
  EXPECT_EQ(sums[6], 0.5 * (1.5 + 1.0));
}

TEST(ImpulseAccount, AMillionStepsLoseNothing)
{
  constexpr int steps = 1000000;
  constexpr double dt = 1e-5;
  ImpulseAccount account(none);
  ExactSum expected;
  for (int step = 0; step < steps; step++) {
    const double force = 1e3 * std::sin(0.37 * step) + 1e-3;    // what is left is small
    account.see({}, none, none);
    account.begin_step(push(force), dt, 0.0, dt);
    expected.add(dt * force);
  }
  double sums[ImpulseAccount::size];
  account.take(sums);
  EXPECT_EQ(sums[0], expected.value());
  EXPECT_NEAR(sums[7], steps * dt, 1e-15 * steps * dt);
  account.take(sums);
  for (const double sum : sums) EXPECT_EQ(sum, 0.0);
}

}    // namespace
}    // namespace Talus
