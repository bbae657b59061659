// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The order in the time step of every law, with `order 2` of the integrator: impacts of two spheres
// head-on, oblique and with spin, a drop onto a plane that slides and rolls, a stack, many spheres.
// Laws that `order 2` takes have errors of an order of 1.8 or so in all of them.

#include "second_order_engine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

using namespace second_order;

namespace {

struct Scene {
  const char *name;
  System start;
  double time;
};

Scene head_on()
{
  Scene scene{"head-on", {}, 0.06};
  scene.start.particles = {sphere({-0.507, 0, 0}, {0.5, 0, 0}),
                           sphere({0.507, 0, 0}, {-0.5, 0, 0})};
  return scene;
}

Scene oblique()
{
  Scene scene{"oblique", {}, 0.07};
  scene.start.particles = {sphere({-0.505, -0.1, 0.05}, {0.5, 0.4, 0.1}, {1, 2, -3}),
                           sphere({0.405, 0.1, -0.02}, {-0.5, -0.4, 0.2}, {-2, 0.5, 1.5}, 0.4)};
  return scene;
}

Scene on_plane()
{
  Scene scene{"on a plane", {}, 0.12};
  scene.start.gravity = {0, 0, -9.81};
  scene.start.planes = {{{0, 0, 0}, {0, 0, 1}}};
  scene.start.particles = {sphere({0, 0, 0.51}, {0.3, 0.1, -0.5}, {0, 3, 1})};
  return scene;
}

Scene stack()
{
  Scene scene{"stack", {}, 0.2};
  scene.start.gravity = {0, 0, -9.81};
  scene.start.planes = {{{0, 0, 0}, {0, 0, 1}}};
  scene.start.particles = {sphere({0, 0, 0.502}, {}), sphere({0.03, 0.02, 1.507}, {})};
  return scene;
}

/// 8 spheres that fly at each other, with spins.
Scene cluster()
{
  Scene scene{"cluster", {}, 0.12};
  unsigned seed = 12345;
  const auto random = [&seed] {
    seed = seed * 1103515245U + 12345U;
    return ((seed >> 16) & 0x7fffU) / 32768.0 - 0.5;
  };
  const auto some = [&random](double most) {
    const double x = most * random(), y = most * random();
    return Vec{x, y, most * random()};
  };
  for (int n = 0; n < 8; n++) {
    const Vec site{n / 4 - 0.5, n / 2 % 2 - 0.5, n % 2 - 0.5};
    const Vec x = 1.03 * site + some(0.02);
    const Vec v = -1.0 * x + some(0.1);
    scene.start.particles.push_back(sphere(x, v, some(2.0)));
  }
  return scene;
}

using State = std::vector<Particle>;

State result(const Engine::Kernels &law, const Scene &scene, int steps)
{
  return Engine::Motion(law, scene.start, scene.time, steps).result();
}

double squared_error(const State &a, const State &b)
{
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); n++)
    for (const Vec &off : {a[n].x - b[n].x, a[n].v - b[n].v, a[n].radius * (a[n].w - b[n].w)})
      sum += inner(off, off);
  return sum / static_cast<double>(a.size());
}

/// Root mean square error of numbers of steps between `fewest` and twice that: where in a step
/// contacts begin, end, and friction begins to slide scatters the errors.
double error(const Engine::Kernels &law, const Scene &scene, int fewest, const State &exact,
             int samples = 18)
{
  double sum = 0.0;
  for (int m = 0; m < samples; m++) {
    const int steps = static_cast<int>(fewest * std::pow(2.0, (m + 0.5) / samples));
    sum += squared_error(result(law, scene, steps), exact);
  }
  return std::sqrt(sum / samples);
}

/// Slope of log error over log time step, from 128 to 8192 steps; the last octaves, which take most
/// of the time, with fewer samples. Contacts last for a tenth of the time of a scene to a half of it.
double order(const Engine::Kernels &law, const Scene &scene)
{
  constexpr int octaves = 6;
  const State exact = result(law, scene, 1 << 15);
  double sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0;
  for (int k = 0; k < octaves; k++) {
    const double x = -k, y = std::log2(error(law, scene, 128 << k, exact, k < 3 ? 18 : 8));
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  return (octaves * sum_xy - sum_x * sum_y) / (octaves * sum_xx - sum_x * sum_x);
}

const char *const normal_laws[] = {
    "hooke 2e4 0",
    "hertz 1.75e5 0",
    "hertz/material 1.5e5 1 0.3",
    "hooke 2e4 80 limit_damping",
    "hertz 1.75e5 400 limit_damping",
    "hertz/material 1.5e5 0.6 0.3 limit_damping",
    "hooke 2e4 0.6 damping tsuji limit_damping",
    "hooke 2e4 20 damping velocity limit_damping",
    "hertz 1.75e5 80 damping mass_velocity limit_damping",
    "hertz 1.75e5 20 damping velocity limit_damping",
    "hertz/material 1.5e5 0.6 0.3 damping coeff_restitution limit_damping",
};

/// The words of friction stand before limit_damping. An elastic hooke has kt of its own: with 2/7
/// kn a contact that sticks ends with friction and normal force zero at the same time, see below.
std::string words_of(const std::string &normal, const char *mu, const std::string &adhesion = "")
{
  const std::string limit = "limit_damping", kt = normal == "hooke 2e4 0" ? "8e3" : "NULL";
  std::string more = adhesion;
  if (mu) more += " tangential multistep " + kt + " NULL " + mu + " slider midpoint";
  const std::size_t at = normal.find(limit);
  if (at == std::string::npos) return normal + " " + more;
  return normal.substr(0, at) + more + " " + limit;
}

void expect_second_order(const std::string &words, const Scene &scene)
{
  ASSERT_EQ(Engine::reason_against(words), "") << words;
  const double found = order(Engine::Kernels(words), scene);
  std::printf("%-12s %5.2f  %s\n", scene.name, found, words.c_str());
  EXPECT_GT(found, 1.8) << scene.name << ": " << words;
}

}    // namespace

TEST(OrderOfLaws, IsTwo)
{
  for (const char *normal : normal_laws)
    for (const char *mu : {static_cast<const char *>(nullptr), "0.3", "2"})
      for (const Scene &scene : {head_on(), oblique(), on_plane(), stack(), cluster()})
        expect_second_order(words_of(normal, mu), scene);
}

/// Every other combination, so that each two of normal law, adhesion and friction meet; all with TALUS_LARGE_TESTS.
TEST(OrderOfLaws, IsTwoWithAdhesion)
{
  int place = 0;
  for (const char *normal : normal_laws)
    for (const char *adhesion : {"adhesion constant 3", "adhesion dmt 3", "adhesion perko 3"}) {
      for (const char *mu : {static_cast<const char *>(nullptr), "0.3"})
        if (place++ % 2 == 0 || std::getenv("TALUS_LARGE_TESTS"))
          for (const Scene &scene : {head_on(), oblique(), on_plane(), cluster()})
            expect_second_order(words_of(normal, mu, adhesion), scene);
      place++;
    }
}

/// Impact speeds that are kept, dampings whose dashpots do not soften as the damping does, friction
/// of the velocity alone, and the laws of LAMMPS where their springs are not wound up.
const char *const other_laws[] = {
    "hooke/material 1.5e5 0.6 0.3 0.01 tangential multistep NULL NULL 0.3 slider midpoint "
    "limit_damping",
    "flores 1.75e5 2e5 tangential multistep NULL 1000 0.3 slider midpoint limit_damping",
    "flores/material 1.5e5 0.6 0.3 0.01 tangential multistep NULL NULL 0.3 slider midpoint "
    "limit_damping",
    "plaincoulomb 1e5 300 0.3 limit_damping",
    "plaincoulomb/material 1.5e5 0.6 0.3 0.3 limit_damping",
    "hooke 2e4 80 tangential dashpot NULL 0.3 limit_damping",
    "hertz 1.75e5 400 tangential dashpot NULL 2 limit_damping",
    "hooke 2e4 80 tangential multistep NULL 0 0.3 limit_damping",
    "hertz 1.75e5 400 tangential multistep NULL NULL 0.3 slider limit_damping",
    "hertz/material 1.5e5 0.6 0.3 damping tsuji tangential linear_nohistory 0.7 0.5 limit_damping",
    "hooke 2e4 80 tangential linear_history 8e3 0 0.3 limit_damping",
    "hertz/material 1.5e5 0.6 0.3 damping tsuji tangential linear_history 5e3 0 2 limit_damping",
    "hertz/material 1.5e5 0.6 0.3 damping tsuji tangential mindlin NULL 0 0.3 limit_damping",
    "hooke 2e4 80 tangential linear_history_classic 8e3 0 0.3 limit_damping",
    "hertz/material 1.5e5 0.6 0.3 damping tsuji tangential mindlin_classic NULL 0 0.3 "
    "limit_damping",
    "hertz/material 1.5e5 0.6 0.3 damping tsuji tangential mindlin/force NULL 0 0.3 limit_damping",
    "hertz/material 1.5e5 0.6 0.3 damping tsuji tangential mindlin_rescale NULL 0 0.3 "
    "limit_damping",
    "hertz/material 1.5e5 0.6 0.3 tangential mindlin_rescale/force NULL 0 2 limit_damping",
    "hooke 2e4 80 tangential mindlin/force 5e4 0 2 limit_damping",
    "hooke 2e4 80 tangential mindlin_rescale 5e4 0 0.3 limit_damping",
};

TEST(OrderOfLaws, IsTwoOfOtherLaws)
{
  for (const char *words : other_laws)
    for (const Scene &scene : {head_on(), oblique(), on_plane(), stack(), cluster()})
      expect_second_order(words, scene);
}

/// Friction is limited by mu (F_e + 2 F_p): it begins and ends with a limit above zero. Forces of
/// jkr begin and end with jumps, damping of both ends as it is.
const char *const adhesive_laws[] = {
    "dmt 1.5e5 0 0.3 0.3",
    "dmt 1.5e5 0 0.3 0.3 tangential mindlin NULL 0 0.3",
    "dmt 1.5e5 0 0.3 3 tangential mindlin NULL 0 0.3",
    "dmt 1.5e5 0 0.3 3 tangential linear_history 5e3 0 0.3",
    "dmt 1.5e5 1 0.3 3 damping none tangential mindlin NULL 1 0.05",
    "dmt 1.5e5 0 0.3 3 tangential dashpot 100 0.3",
    "dmt 1.5e5 0 0.3 3 tangential multistep NULL 100 0.3 slider midpoint",
    "dmt 1.5e5 400 0.3 1 tangential mindlin NULL 0 0.3",
    "dmt 1.5e5 200 0.3 0.5 tangential linear_nohistory 0.7 0.5",
    "dmt 1.5e5 80 0.3 1 damping mass_velocity tangential mindlin NULL 0 0.3",
    "jkr 1.5e5 0 0.3 3 tangential mindlin NULL 0 0.3",
    "jkr 1.5e5 400 0.3 3 tangential mindlin NULL 0 0.3",
    "jkr 1.5e5 400 0.3 3 tangential linear_history 5e3 0 0.3",
    "jkr 1.5e5 20 0.3 3 damping velocity tangential linear_nohistory 0.7 0.3",
    "jkr 1.5e5 0 0.3 1 tangential multistep NULL 100 0.3 slider midpoint",
    "jkr 1.5e5 400 0.3 0 tangential mindlin NULL 0 0.3",
    "dmt 1.5e5 0 0.3 3 tangential mindlin/force NULL 0 0.3",
    "dmt 1.5e5 400 0.3 1 tangential mindlin_rescale NULL 0 0.3",
    "dmt 1.5e5 400 0.3 1 tangential mindlin_rescale/force NULL 0 0.3",
    "jkr 1.5e5 400 0.3 3 tangential mindlin/force NULL 0 0.3",
    "jkr 1.5e5 400 0.3 3 tangential mindlin_rescale NULL 0 0.3",
    "jkr 1.5e5 400 0.3 3 tangential mindlin_rescale/force NULL 0 0.3",
};

/// What the laws of order 1 converge to, at first order, is the same.
TEST(OrderOfLaws, OfOneHaveTheSameLimit)
{
  for (const char *words : other_laws) {
    const Scene scene = oblique();
    const State limit = result(Engine::Kernels(words), scene, 1 << 13);
    const Engine::Kernels first(words, false);
    const double some = squared_error(result(first, scene, 1 << 12), limit);
    const double less = squared_error(result(first, scene, 1 << 15), limit);
    EXPECT_LT(std::sqrt(less), 2.0e-4) << words;
    EXPECT_LT(less, some / 25.0) << words;
  }
}

/// Their error is that of the jumps, which depends on where in a step contacts begin.
TEST(OrderOfLaws, OfOneHaveTheSameLimitWithAdhesion)
{
  for (const char *words : adhesive_laws) {
    const State limit = result(Engine::Kernels(words), oblique(), 1 << 15);
    const Engine::Kernels first(words, false);
    const double error = std::sqrt(squared_error(result(first, oblique(), 1 << 15), limit));
    std::printf("%.1e  %s\n", error, words);
    EXPECT_LT(error, 5.0e-5) << words;
  }
}

TEST(OrderOfLaws, IsTwoOfAdhesiveLaws)
{
  for (const char *words : adhesive_laws)
    for (const Scene &scene : {oblique(), on_plane(), cluster()}) expect_second_order(words, scene);
  for (const char *normal : {"dmt 1.5e5 0 0.3 0.3", "dmt 1.5e5 400 0.3 0.3", "jkr 1.5e5 400 0.3 3"})
    for (const Scene &scene : {oblique(), on_plane()})
      expect_second_order(
          std::string(normal) + " tangential mindlin NULL 0 0.3 rolling 0.02 spinning 0.02", scene);
}

TEST(OrderOfLaws, DmtIsPerkoWithoutFriction)
{
  const Engine::Kernels dmt("dmt 1.5e5 0 0.3 0.25"),
      perko("hertz/material 1.5e5 1 0.3 adhesion perko 3.14159265358979323846");
  for (const Scene &scene : {head_on(), oblique(), on_plane(), cluster()})
    for (int steps : {60, 157, 1000})
      EXPECT_LT(squared_error(result(dmt, scene, steps), result(perko, scene, steps)), 1.0e-22)
          << scene.name;
}

/// Where a body is held by one contact.
TEST(OrderOfLaws, IsTwoWithResistanceToRollingAndSpinning)
{
  for (const char *normal : normal_laws)
    for (const Scene &scene : {oblique(), on_plane()}) {
      expect_second_order(words_of(normal, nullptr, "rolling 0.02 spinning 0.02"), scene);
      expect_second_order(words_of(normal, "0.3", "rolling 0.1 spinning 0.1"), scene);
    }
}

const char *const rolling_springs[] = {
    "hooke 2e4 80 tangential multistep NULL NULL 0.3 slider midpoint rolling sds 2e3 5 0.1 "
    "limit_damping",
    "hertz/material 1.5e5 0.6 0.3 rolling sds 2e3 0 0.1 limit_damping",
    "hertz/material 1.5e5 0.6 0.3 tangential multistep NULL NULL 0.3 slider midpoint rolling sds "
    "2e3 5 0.1 limit_damping",
    "dmt 1.5e5 0 0.3 3 tangential mindlin NULL 0 0.3 rolling sds 2e3 4 0.1",
    "dmt 1.5e5 400 0.3 1 rolling sds 2e3 4 0.1",
    "jkr 1.5e5 400 0.3 3 tangential mindlin NULL 0 0.3 rolling sds 2e3 4 0.1",
};

TEST(OrderOfLaws, IsTwoWithSpringsOfRolling)
{
  for (const char *words : rolling_springs)
    for (const Scene &scene : {oblique(), on_plane(), stack(), cluster()})
      expect_second_order(words, scene);
}

/* What they converge to is the same with order 1. Where the limit of the force goes to zero with
   the overlap as dt^(1/4) does, the springs of order 1 begin with an error of that order. */
TEST(OrderOfLaws, OfOneHaveTheSameLimitOfSpringsOfRolling)
{
  for (const char *words : rolling_springs) {
    const bool slow = words == rolling_springs[2];
    const Scene scene = slow ? cluster() : oblique();
    const State limit = result(Engine::Kernels(words), scene, 1 << 14);
    const Engine::Kernels first(words, false);
    const double some = std::sqrt(squared_error(result(first, scene, 1 << 9), limit));
    const double less = std::sqrt(squared_error(result(first, scene, 1 << 15), limit));
    std::printf("%.1e %.1e  %s\n", some, less, words);
    EXPECT_LT(less, slow ? 0.4 * some : 1.0e-4) << words;
  }
}

/* Where other contacts act on a body as well their torques are known a step late: where they jump,
   the error is of first order. At usual steps it is small beside those of second order. */
TEST(OrderOfLaws, OfHeldRotationsOfManyContactsIsTwoAtUsualSteps)
{
  for (const char *normal : {"hooke 2e4 80 limit_damping", "hertz 1.75e5 400 limit_damping"})
    for (const Scene &scene : {stack(), cluster()}) {
      const std::string words = words_of(normal, "0.3", "rolling 0.02 spinning 0.02");
      const Engine::Kernels law(words), first(words, false);
      const State exact = result(law, scene, 1 << 16);
      const double coarse = error(law, scene, 128, exact), fine = error(law, scene, 1024, exact);
      const double of_first = error(first, scene, 1024, exact);
      std::printf("%-12s %.2e %.2e order 1: %.2e  %s\n", scene.name, coarse, fine, of_first,
                  words.c_str());
      EXPECT_LT(fine, coarse / 20.0) << scene.name << ": " << words;
      EXPECT_LT(fine, of_first / 10.0) << scene.name << ": " << words;
    }
}

/* Without damping and with kt = 2/7 kn a contact that sticks turns its spring back to zero just as
   it ends: it slides for a time far below a step, which few steps see. Those have an error of
   second order as well, but 100 times that of the others. */
TEST(OrderOfLaws, IsTwoWhereASpringEndsWithItsContact)
{
  const Engine::Kernels law("hooke 2e4 0 tangential multistep NULL NULL 2 slider midpoint");
  for (const Scene &scene : {oblique(), on_plane()}) {
    const State exact = result(law, scene, 1 << 16);
    for (int steps = 256; steps < 8192; steps += 1 + steps / 64) {
      const double scaled = steps / 1024.0;
      EXPECT_LT(squared_error(result(law, scene, steps), exact) * std::pow(scaled, 4.0), 4.0e-8)
          << scene.name << ", " << steps;
    }
  }
}
