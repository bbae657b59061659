// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The order in the time step of contacts that dissipate, with the five measures of
// second_order_reference.h and without them. Errors of position, velocity and spin (as speed of the
// surface) at the end, root mean square over particles and over five nearby numbers of steps:
// where in a step a contact begins must not matter.

#include "crystal_of_spheres.h"
#include "second_order_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace Reference;

namespace {

const double pi = 3.14159265358979323846;

Particle sphere(Vec x, Vec v, Vec w = {})
{
  Particle p;
  p.x = x;
  p.v = v;
  p.w = w;
  p.mass = pi / 6.0;
  return p;
}

Law hooke(double mu)
{
  Law law;
  law.kn = 2.0e4;
  law.gn = 80.0;
  law.kt = 2.0 / 7.0 * law.kn;
  law.gt = 0.5 * law.gn;
  law.mu = mu;
  return law;
}

Law hertz(double gn, double mu, Damping damping = Damping::RADIUS)
{
  Law law;
  law.hertz = true;
  law.damping = damping;
  law.kn = 1.75e5;
  law.gn = gn;
  law.kt = 2.0 / 7.0 * law.kn;
  law.gt = 0.5 * gn;
  law.mu = mu;
  return law;
}

struct Scene {
  System start;
  double time;
};

Scene with_law(Scene scene, const Law &law)
{
  scene.start.law = law;
  return scene;
}

Scene head_on(const Law &law)
{
  Scene scene{{}, 0.06};
  scene.start.particles = {sphere({-0.507, 0, 0}, {0.5, 0, 0}),
                           sphere({0.507, 0, 0}, {-0.5, 0, 0})};
  return with_law(scene, law);
}

Scene oblique(const Law &law)
{
  Scene scene{{}, 0.06};
  scene.start.particles = {sphere({-0.505, -0.1, 0.05}, {0.5, 0.4, 0.1}, {1, 2, -3}),
                           sphere({0.505, 0.1, -0.02}, {-0.5, -0.4, 0.2}, {-2, 0.5, 1.5})};
  return with_law(scene, law);
}

Scene on_floor(const std::vector<Particle> &particles, double time, const Law &law)
{
  Scene scene{{}, time};
  scene.start.gravity = {0, 0, -9.81};
  scene.start.planes = {{{0, 0, 0}, {0, 0, 1}}};
  scene.start.particles = particles;
  return with_law(scene, law);
}

Scene stack(const Law &law)
{
  return on_floor({sphere({0, 0, 0.502}, {}), sphere({0.03, 0.02, 1.507}, {})}, 0.3, law);
}

Scene put_down(const Law &law)
{
  return on_floor({sphere({0, 0, 0.5}, {0.3, 0.1, 0}, {0, 0, 1})}, 0.4, law);
}

/// 27 spheres that fly at each other, with spins.
Scene cluster(const Law &law)
{
  Scene scene{{}, 0.15};
  unsigned seed = 12345;
  const auto random = [&seed] {
    seed = seed * 1103515245U + 12345U;
    return ((seed >> 16) & 0x7fffU) / 32768.0 - 0.5;
  };
  const auto some = [&random](double most) {
    const double x = most * random(), y = most * random();
    return Vec{x, y, most * random()};
  };
  for (int n = 0; n < 27; n++) {
    const Vec site{n / 9 - 1.0, n / 3 % 3 - 1.0, n % 3 - 1.0};
    const Vec x = 1.03 * site + some(0.02);
    const Vec v = -0.5 * x + some(0.1);
    scene.start.particles.push_back(sphere(x, v, some(2.0)));
  }
  return with_law(scene, law);
}

System result(const Scene &scene, const Measures &measures, int steps)
{
  System system = scene.start;
  system.with = measures;
  system.run(scene.time, steps);
  return system;
}

double square(Vec v)
{
  return dot(v, v);
}

double squared_error(const System &a, const System &b)
{
  double sum = 0.0;
  for (std::size_t n = 0; n < a.particles.size(); n++) {
    const Particle &p = a.particles[n], &q = b.particles[n];
    sum += square(p.x - q.x) + square(p.v - q.v) + square(p.radius * (p.w - q.w));
  }
  return sum / static_cast<double>(a.particles.size());
}

double error(const Scene &scene, const Measures &measures, int steps, const System &exact)
{
  double sum = 0.0;
  for (int k = -2; k <= 2; k++)
    sum += squared_error(result(scene, measures, steps + k * steps / 60), exact) / 5.0;
  return std::sqrt(sum);
}

struct Order {
  double value, error;    // from 128 to 2048 steps; error at 2048
};

Order order(const Scene &scene, const Measures &measures)
{
  const System exact = result(scene, Measures{}, 1 << 15);
  const double coarse = error(scene, measures, 128, exact);
  const double fine = error(scene, measures, 2048, exact);
  return {std::log(coarse / fine) / std::log(16.0), fine};
}

void expect_second_order(const Scene &scene)
{
  EXPECT_GT(order(scene, Measures{}).value, 1.8);
}

/// By what factor the error at 2048 steps grows if measures are left out.
double worth(const Scene &scene, const Measures &without)
{
  return order(scene, without).error / order(scene, Measures{}).error;
}

}    // namespace

TEST(SecondOrder, ZetaIsThePolynomialOfWholeExponents)
{
  for (double t : {0.01, 0.3, 0.7, 1.0, 1.6}) {
    EXPECT_NEAR(zeta(0.0, t), 0.5 - t, 1e-13);
    EXPECT_NEAR(zeta(1.0, t), -0.5 * (t * t - t + 1.0 / 6.0), 1e-12);
  }
  EXPECT_NEAR(zeta(0.5, 1.0), -0.20788622497735457, 1e-10);
  EXPECT_NEAR(zeta(1.5, 1.0), -0.02548520188983303, 1e-10);
}

TEST(SecondOrder, OfImpactsHeadOn)
{
  expect_second_order(head_on(hooke(0.0)));
  expect_second_order(head_on(hertz(400.0, 0.0)));
  expect_second_order(head_on(hertz(0.5, 0.0, Damping::ROOT)));
  expect_second_order(head_on(hertz(0.0, 0.0)));
}

TEST(SecondOrder, OfImpactsWithFriction)
{
  expect_second_order(oblique(hooke(0.3)));
  expect_second_order(oblique(hooke(0.1)));
  expect_second_order(oblique(hertz(400.0, 0.3)));
  expect_second_order(oblique(hertz(0.5, 0.3, Damping::ROOT)));
}

TEST(SecondOrder, OfAnyRatioOfTangentialDashpotAndSpring)
{
  for (double gt : {0.0, 0.4, 4.0, 400.0}) {
    Law law = hooke(0.3);
    law.gt = gt;
    expect_second_order(oblique(law));
    law = hertz(400.0, 0.3);
    law.gt = gt;
    expect_second_order(oblique(law));
  }
}

TEST(SecondOrder, OnAFloor)
{
  expect_second_order(stack(hertz(400.0, 0.0)));
  expect_second_order(put_down(hertz(1500.0, 0.3)));
}

TEST(SecondOrder, OfManySpheres)
{
  expect_second_order(cluster(hertz(400.0, 0.3)));
  expect_second_order(cluster(hertz(0.0, 0.3)));
}

TEST(SecondOrder, WithResistanceToRollingAndSpinning)
{
  for (Law law : {hooke(0.3), hertz(400.0, 0.3)}) {
    law.resistance.mu_r = law.resistance.mu_s = 0.1;
    expect_second_order(oblique(law));
  }
  Law law = hertz(1500.0, 0.3);
  law.resistance.mu_r = law.resistance.mu_s = 0.1;
  expect_second_order(put_down(law));
  law = hertz(400.0, 0.3);
  law.resistance.mu_r = law.resistance.mu_s = 0.02;
  expect_second_order(cluster(law));
}

TEST(SecondOrder, WithSpringsOfRolling)
{
  for (double damping : {0.0, 0.3, 5.0})
    for (Law law : {hooke(0.3), hertz(400.0, 0.3)}) {
      law.resistance.k_roll = 2000.0;
      law.resistance.gamma_roll = damping;
      law.resistance.mu_roll = 0.1;
      expect_second_order(oblique(law));
      expect_second_order(put_down(law));
    }
}

// It begins with a jump once a contact has lasted some time, and pushes what rests back and forth.
TEST(SecondOrder, IsOneWithDelayedResistance)
{
  for (Law law : {hooke(0.3), hertz(1500.0, 0.3)}) {
    law.resistance.mu_r = 0.1;
    law.resistance.delayed = true;
    law.resistance.delay = 0.01;
    EXPECT_LT(order(put_down(law), Measures{}).value, 1.5);
  }
}

// Many contacts hold each other's bodies: what is left of a rotation must die away, not be pushed
// on. A crystal, 12 neighbors each, held together by adhesion.
TEST(SecondOrder, HeldRotationsOfACrystalComeToRest)
{
  System crystal;
  crystal.law = hooke(0.0);
  crystal.law.adhesion = 10.0;
  crystal.law.resistance.mu_r = 0.1;
  crystal.particles = crystal_of_spheres();
  crystal.run(0.08, 200);
  EXPECT_LT(spin_of(crystal.particles), 1e-4);
}

TEST(SecondOrder, WithAdhesion)
{
  Law law = hertz(400.0, 0.3);
  law.adhesion = 3.0;
  expect_second_order(head_on(law));
  expect_second_order(oblique(law));
}

// Without a limit of damping a contact ends with a jump of its force. Head-on it can be had; where
// it slides, the limit mu |F_n| has a kink where F_n changes its sign.
TEST(SecondOrder, WithoutLimitOfDampingHeadOnOnly)
{
  Law law = hooke(0.0);
  law.limit_damping = false;
  expect_second_order(head_on(law));
  law = hooke(0.3);
  law.limit_damping = false;
  EXPECT_LT(order(oblique(law), Measures{}).value, 1.5);
}

TEST(SecondOrder, IsLostWithoutTheMeasures)
{
  EXPECT_LT(order(head_on(hooke(0.0)), Measures::none()).value, 1.5);
  EXPECT_LT(order(oblique(hooke(0.3)), Measures::none()).value, 1.6);
  EXPECT_LT(order(cluster(hertz(400.0, 0.3)), Measures::none()).value, 1.3);
  Measures without;
  without.ends = false;
  EXPECT_GT(worth(head_on(hooke(0.0)), without), 30.0);
  without = Measures{};
  without.midpoint = false;
  EXPECT_GT(worth(oblique(hooke(0.3)), without), 4.0);
  without = Measures{};
  without.slip = false;
  Law law = hertz(400.0, 0.3);
  law.resistance.mu_r = law.resistance.mu_s = 0.1;
  EXPECT_GT(worth(oblique(law), without), 5.0);
  without = Measures{};
  without.rolling = false;
  EXPECT_GT(worth(oblique(law), without), 50.0);
  without = Measures{};
  without.damping = without.implicit = false;
  EXPECT_GT(worth(head_on(hooke(0.0)), without), 30.0);
}

// Extrapolated velocities without the contact's own force are of second order as well, but not as
// good.
TEST(SecondOrder, ImplicitDampingHasTheSmallerError)
{
  Measures extrapolated;
  extrapolated.implicit = false;
  EXPECT_GT(order(head_on(hooke(0.0)), extrapolated).value, 1.8);
  EXPECT_GT(worth(head_on(hooke(0.0)), extrapolated), 3.0);
}
