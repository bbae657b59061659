// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Friction laws that `order 2` of the integrator refuses because of what they are: the solution to
// which they converge with the time step is not the one that is seen at usual time steps, or it has
// no friction. A slow reference of one contact: a sphere of mass 1 and radius 1 that meets a plane,
// the leapfrog, forces and rules as in doc/contact_laws.md.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

enum class Rule { STOCK, SLIDER, ONESTEP, TANH };
enum class Side { OF_ROTATION, OF_TORQUE };

struct Impact {
  Rule rule;
  double sliding_speed;       ///< at the beginning
  double dashpot;             ///< tangential damping coefficient over the normal one
  double damping_exponent;    ///< of the overlap
};

/// Spring of a contact that slides: `f` is the force at its limit.
double sliding_spring(Rule rule, double before, double f, double velocity, double kt, double gt,
                      double dt)
{
  if (rule == Rule::STOCK) return -(f + gt * velocity) / kt;
  const double tau = gt / kt;    // (gt/kt) d' + d = -f/kt, implicit Euler
  return (tau * before - dt * f / kt) / (tau + dt);
}

/// Twisting spring and dashpot of `sds`, or `marshall`, of a body that spins while its normal force
/// goes up and down between 0.4 and 1.6: what it has turned in the end. At its limit the torque has
/// the side of the rotation, that is the rule, or its own.
double turned_by_then(double first_spin, int steps, Side side, bool marshall)
{
  const double inertia = 0.1, dt = 3.0 / steps;
  double w = first_spin, spring = 0.0, angle = 0.0;
  for (int n = 1; n <= steps; n++) {
    const double normal_force = 1.0 + 0.6 * std::sin(8.0 * n * dt);
    const double radius = marshall ? std::cbrt(normal_force) : 1.0;
    const double k = 200.0 * radius * radius, damping = 0.0025 * k;
    const double limit = 0.2 * radius * normal_force;
    angle += w * dt;
    spring += w * dt;
    double torque = k * spring + damping * w;
    if (std::fabs(torque) > limit) {
      torque = std::copysign(limit, side == Side::OF_ROTATION ? w : torque);
      spring = (torque - damping * w) / k;
    }
    w -= dt * torque / inertia;
  }
  return angle;
}

/// Largest difference between runs with numbers of steps that are nearly the same, of some spins.
double spread_of_turns(int steps, Side side, bool marshall)
{
  double largest = 0.0;
  for (const double first_spin : {2.0, 2.5, 3.0, 3.5, 4.0}) {
    double least = 1e9, most = -1e9;
    for (int more = 0; more < 120; more += 17) {
      const double angle = turned_by_then(first_spin, steps + more, side, marshall);
      least = std::min(least, angle);
      most = std::max(most, angle);
    }
    largest = std::max(largest, most - least);
  }
  return largest;
}

/// Angular velocity after the impact.
double spin_after(const Impact &impact, double steps)
{
  const double contact_time = 0.08, dt = contact_time / steps;
  const double stiffness = 1.0e4, damping = 30.0, mu = 0.3, inertia = 0.4;
  double overlap = 0.0, approach = 1.0, v = impact.sliding_speed, spin = 0.0, spring = 0.0;
  while (true) {
    overlap += approach * dt;
    if (overlap <= 0.0) return spin;
    const double k = stiffness * std::sqrt(overlap), kt = 0.8 * k;
    const double g = damping * std::pow(overlap, impact.damping_exponent), gt = impact.dashpot * g;
    const double normal_force = std::max(k * overlap + g * approach, 0.0);
    const double limit = mu * normal_force, velocity = v + spin, before = spring;
    spring = impact.rule == Rule::ONESTEP ? velocity * dt : spring + velocity * dt;
    double f = -(kt * spring + gt * velocity);
    if (impact.rule == Rule::TANH)
      f = -limit * std::tanh(5.0 * velocity);
    else if (std::fabs(f) > limit) {
      f = std::copysign(limit, f);
      spring = sliding_spring(impact.rule, before, f, velocity, kt, gt, dt);
    }
    approach -= normal_force * dt;
    v += f * dt;
    spin += f / inertia * dt;
  }
}

}    // namespace

/* Where a Hertzian contact with a dashpot that falls more slowly than the stiffness begins to
   slide, the rule resets the spring to a length that grows without bound as dt goes to 0: between
   1e3 and 1e4 steps per contact the spin is settled to .4 %, and 1 % from where it goes. */
TEST(LawsWithoutLimit, StockRuleSettlesWhereItDoesNotStay)
{
  const Impact stock{Rule::STOCK, 1.0, 0.5, 0.25};
  const double usual = spin_after(stock, 1.0e4), limit = spin_after(stock, 1.0e6);
  EXPECT_LT(std::fabs(spin_after(stock, 1.0e3) / usual - 1.0), 4.0e-3);
  EXPECT_GT(std::fabs(usual / limit - 1.0), 1.0e-2);
  EXPECT_LT(std::fabs(spin_after(stock, 1.0e5) / limit - 1.0), 1.0e-4);
}

TEST(LawsWithoutLimit, SliderRuleConverges)
{
  const Impact slider{Rule::SLIDER, 1.0, 0.5, 0.25};
  const double limit = spin_after(slider, 1.0e6);
  EXPECT_LT(std::fabs(spin_after(slider, 1.0e3) / limit - 1.0), 1.0e-4);
  EXPECT_LT(std::fabs(spin_after(slider, 1.0e4) / limit - 1.0), 1.0e-5);
}

/* With a dashpot that goes to zero as fast as the stiffness the stock rule has no such trouble. */
TEST(LawsWithoutLimit, StockRuleConvergesWithViscoelasticDamping)
{
  const Impact stock{Rule::STOCK, 1.0, 0.5, 0.5};
  const double limit = spin_after(stock, 1.0e6);
  EXPECT_LT(std::fabs(spin_after(stock, 1.0e3) / limit - 1.0), 1.0e-4);
  EXPECT_LT(std::fabs(spin_after(stock, 1.0e4) / limit - 1.0), 1.0e-5);
}

/* A spring with the displacement of one time step is a dashpot in proportion to the time step:
   without another dashpot its friction vanishes with it. */
TEST(LawsWithoutLimit, OnestepHasNoFrictionInTheLimit)
{
  const Impact onestep{Rule::ONESTEP, 1.0, 0.0, 0.25};
  const double some = spin_after(onestep, 1.0e3), less = spin_after(onestep, 1.0e4);
  EXPECT_LT(some, -1.0e-3);
  EXPECT_NEAR(10.0 * less / some, 1.0, 0.05);
}

/* A twist that slides is brought to rest while the normal force, and so the limit, falls: the spring
   turns it back, which is beyond the limit again, and by the rule the torque now jumps to the other
   side. So it goes back and forth in every step until the limit rises: on which side the spring
   then is held depends on the number of steps, how small they may be. */
TEST(LawsWithoutLimit, TwistingSpringsEndOnASideThatTheTimeStepDecides)
{
  for (const bool marshall : {false, true}) {
    const double coarse = spread_of_turns(1 << 15, Side::OF_ROTATION, marshall);
    const double fine = spread_of_turns(1 << 18, Side::OF_ROTATION, marshall);
    EXPECT_GT(coarse, 5.0e-4) << marshall;
    EXPECT_GT(fine, 0.9 * coarse) << marshall;
  }
}

TEST(LawsWithoutLimit, TwistingSpringsConvergeWithTheSideOfTheirTorque)
{
  for (const bool marshall : {false, true}) {
    const double coarse = spread_of_turns(1 << 12, Side::OF_TORQUE, marshall);
    const double fine = spread_of_turns(1 << 16, Side::OF_TORQUE, marshall);
    EXPECT_LT(coarse, 1.0e-4) << marshall;
    EXPECT_LT(fine, coarse / 100.0) << marshall;
  }
}

/* Friction of plaincoulomb depends on the velocity alone, and smoothly: it has a limit, which a
   leapfrog reaches at first order. */
TEST(LawsWithoutLimit, PlainCoulombConverges)
{
  const Impact smooth{Rule::TANH, 1.0, 0.0, 0.5};
  const double limit = spin_after(smooth, 1.0e6);
  const double some = std::fabs(spin_after(smooth, 1.0e3) / limit - 1.0);
  const double less = std::fabs(spin_after(smooth, 1.0e5) / limit - 1.0);
  EXPECT_LT(some, 1.0e-2);
  EXPECT_LT(less, some / 30.0);
}
