// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How a rigid particle turns: what is kept, to which order, and where it is exact.

#include "body/motion/body_state.h"
#include "body/motion/free_rotation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace Talus;

namespace {

using V = Vector3<double>;
const V none{0.0, 0.0, 0.0};

struct Body {
  FreeRotation free;
  Eigen::Quaterniond q = Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.6, 0.0, 0.8)));
  V omega{0.1, 2.0, 0.2};    // close to the axis in the middle: it tumbles

  Body(double a, double b, double c, const Eigen::Quaterniond &axes) : free({a, b, c}, axes) {}
  void turn(int steps, double dt, const V &torque = none)
  {
    for (int n = 0; n < steps; n++) free.advance(q, omega, torque, dt);
  }
  double energy() const { return free.energy(q, omega); }
  V momentum() const { return free.angular_momentum(q, omega); }
};

const Eigen::Quaterniond oblique(Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.0, 0.6, 0.8)));

TEST(FreeRotation, KeepsMomentumAndDoesNotDriftInEnergy)
{
  double error[2] = {0.0, 0.0};
  for (int k = 0; k < 2; k++) {
    const double dt = k ? 0.01 : 0.02;
    Body body(1.0, 2.0, 3.0, oblique);
    const V before = body.momentum();
    const double e = body.energy();
    double early = 0.0, late = 0.0;
    const int block = static_cast<int>(1.0 / dt);
    for (int n = 0; n < 2000; n++) {    // some 500 times over
      body.turn(block, dt);
      double &worst = n < 200 ? early : late;
      worst = std::max(worst, std::fabs(body.energy() / e - 1.0));
    }
    EXPECT_LT(length(body.momentum() - before) / length(before), 1e-10);
    EXPECT_LT(late, 1.1 * early);
    error[k] = late;
  }
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.4);
  EXPECT_LT(error[1], 1e-4);
}

TEST(FreeRotation, IsOfSecondOrder)
{
  const auto end = [](int steps) {
    Body body(1.0, 2.0, 3.0, oblique);
    body.turn(steps, 4.0 / steps);
    return body.q;
  };
  const Eigen::Quaterniond exact = end(25600);
  const double coarse = end(100).angularDistance(exact), fine = end(200).angularDistance(exact);
  EXPECT_GT(coarse, 1e-6);
  EXPECT_NEAR(coarse / fine, 4.0, 0.2);
}

/* A top precesses about L with |L|/A and turns about its axis. */

TEST(FreeRotation, SymmetricBodiesTurnExactly)
{
  for (const double c : {2.0, 3.5}) {
    Body once(2.0, 2.0, c, oblique), often(2.0, 2.0, c, oblique);
    once.turn(1, 3.0);
    often.turn(300, 0.01);
    EXPECT_LT(once.q.angularDistance(often.q), 1e-12);
    EXPECT_LT(length(once.omega - often.omega), 1e-12);
  }
  Body cube(2.0, 2.0, 2.0, oblique);
  const V omega = cube.omega;
  const Eigen::Quaterniond expected = rotation_by(omega, 1.5) * cube.q;
  cube.turn(15, 0.1);
  EXPECT_LT(length(cube.omega - omega), 1e-13);
  EXPECT_LT(cube.q.angularDistance(expected), 1e-13);
}

TEST(FreeRotation, IsReversible)
{
  Body body(1.0, 2.0, 3.0, oblique);
  const Eigen::Quaterniond q = body.q;
  body.turn(500, 0.02);
  EXPECT_GT(body.q.angularDistance(q), 1e-3);
  body.turn(500, -0.02);
  EXPECT_LT(body.q.angularDistance(q), 1e-10);
}

TEST(FreeRotation, TorqueKicksTheMomentum)
{
  Body body(1.0, 2.0, 3.0, oblique);
  const V before = body.momentum();
  body.turn(10, 0.05, {1.0, -2.0, 3.0});
  EXPECT_LT(length(body.momentum() - before - V{0.5, -1.0, 1.5}), 1e-13);
  Body rest(1.0, 2.0, 3.0, oblique);
  rest.omega = none;
  const Eigen::Quaterniond q = rest.q;
  rest.turn(10, 0.05);
  EXPECT_EQ(rest.q.coeffs(), q.coeffs());
}

}    // namespace
