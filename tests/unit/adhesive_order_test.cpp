// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Normal laws with adhesion of their own with `order 2` of the integrator: the order of the slow
// reference with and without what makes it two, and the laws of the engine against it, over impacts
// after which the bodies separate, some of them by pull-off.

#include "adhesive_reference.h"
#include "second_order_engine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <iterator>
#include <string>
#include <vector>

using namespace Reference;

namespace {

Particle sphere(Vec x, Vec v, Vec w, double radius)
{
  Particle p;
  p.x = x;
  p.v = v;
  p.w = w;
  p.radius = radius;
  p.mass = 4.0 / 3.0 * M_PI * radius * radius * radius;
  return p;
}

struct Scene {
  System start;
  double time;
};

Scene head_on()
{
  Scene scene{{}, 0.06};
  scene.start.particles = {sphere({-0.507, 0, 0}, {0.5, 0, 0}, {}, 0.5),
                           sphere({0.507, 0, 0}, {-0.5, 0, 0}, {}, 0.5)};
  return scene;
}

Scene oblique()
{
  Scene scene{{}, 0.07};
  scene.start.particles = {sphere({-0.505, -0.1, 0.05}, {0.5, 0.4, 0.1}, {1, 2, -3}, 0.5),
                           sphere({0.405, 0.1, -0.02}, {-0.5, -0.4, 0.2}, {-2, 0.5, 1.5}, 0.4)};
  return scene;
}

Scene on_plane()
{
  Scene scene{{}, 0.12};
  scene.start.gravity = {0, 0, -9.81};
  scene.start.planes = {{{0, 0, 0}, {0, 0, 1}}};
  scene.start.particles = {sphere({0, 0, 0.51}, {0.3, 0.1, -0.5}, {0, 3, 1}, 0.5)};
  return scene;
}

AdhesiveLaw law_of(bool detaches, double gamma, double damping, double xt, double mu)
{
  const double young = 1.5e5 / (2.0 * (1.0 - 0.3 * 0.3));
  return {detaches, young, gamma, damping, xt, mu};
}

const AdhesiveLaw laws[] = {
    law_of(true, 1.0, 0.0, 0.0, 0.0),    law_of(true, 2.0, 200.0, 0.0, 0.0),
    law_of(true, 1.0, 200.0, 0.7, 0.02), law_of(true, 1.0, 200.0, 0.7, 0.5),
    law_of(false, 0.5, 400.0, 0.0, 0.0), law_of(false, 0.5, 200.0, 0.7, 0.5)};
/// Whose dashpot meets its limit at once.
const AdhesiveLaw slippery = law_of(false, 0.5, 200.0, 0.7, 0.1);

std::string words_of(const AdhesiveLaw &law)
{
  const auto number = [](double x) { return std::to_string(x); };
  std::string words = std::string(law.detaches ? "jkr" : "dmt") + " 1.5e5 " + number(law.damping) +
                      " 0.3 " + number(law.gamma);
  if (law.mu > 0.0)
    words += " tangential linear_nohistory " + number(law.xt) + " " + number(law.mu);
  return words;
}

using State = std::vector<Particle>;

double squared(Vec v)
{
  return dot(v, v);
}

double squared_error(const State &a, const State &b)
{
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); n++)
    sum += squared(a[n].x - b[n].x) + squared(a[n].v - b[n].v) +
           squared(a[n].radius * (a[n].w - b[n].w));
  return sum / static_cast<double>(a.size());
}

State result(const AdhesiveImpact &method, const Scene &scene, int steps)
{
  AdhesiveImpact impact = method;
  System system = scene.start;
  impact.run(system, scene.time, steps);
  EXPECT_TRUE(impact.detached);
  return system.particles;
}

/// Between 128 and 2048 steps; errors are root mean squares over moments at which contacts begin.
double order(const AdhesiveImpact &method, const Scene &scene)
{
  constexpr int samples = 10;
  AdhesiveImpact best = method;
  best.ends = best.damping = true;
  const State exact = result(best, scene, 16384);
  const auto error = [&](int fewest) {
    double sum = 0.0;
    for (int m = 0; m < samples; m++) {
      const int steps = static_cast<int>(fewest * std::pow(2.0, (m + 0.5) / samples));
      sum += squared_error(result(method, scene, steps), exact);
    }
    return std::sqrt(sum / samples);
  };
  return std::log2(error(128) / error(2048)) / 4.0;
}

}    // namespace

TEST(AdhesiveOrder, OfTheReferenceIsTwo)
{
  for (const AdhesiveLaw &law : laws)
    for (const Scene &scene : {head_on(), oblique(), on_plane()}) {
      AdhesiveImpact method;
      method.law = law;
      const double all = order(method, scene);
      std::printf("%.2f  %s\n", all, words_of(law).c_str());
      EXPECT_GT(all, 1.8) << words_of(law);
    }
}

/// Jumps that are not made up for, and damping of velocities that are half a step old.
TEST(AdhesiveOrder, IsOneWithoutWhatMakesItTwo)
{
  for (const AdhesiveLaw &law : {laws[0], laws[1], laws[4]})
    for (const Scene &scene : {head_on(), oblique(), on_plane()}) {
      AdhesiveImpact method;
      method.law = law;
      method.ends = false;
      EXPECT_LT(order(method, scene), 1.5) << words_of(law);
      if (law.damping == 0.0) continue;
      method.ends = true;
      method.damping = false;
      EXPECT_LT(order(method, scene), 1.5) << words_of(law);
    }
}

TEST(AdhesiveOrder, TheEngineHasTheLawsOfTheReference)
{
  std::vector<AdhesiveLaw> all(std::begin(laws), std::end(laws));
  all.push_back(slippery);
  for (const AdhesiveLaw &law : all) {
    const std::string words = words_of(law);
    ASSERT_EQ(Engine::reason_against(words), "") << words;
    const Engine::Kernels kernels(words);
    AdhesiveImpact reference;
    reference.law = law;
    for (const Scene &scene : {head_on(), oblique(), on_plane()})
      for (int steps : {60, 61, 157, 400}) {
        const Engine::Motion engine(kernels, scene.start, scene.time, steps, true);
        EXPECT_LT(squared_error(engine.result(), result(reference, scene, steps)), 1.0e-16)
            << words << ", " << steps;
        EXPECT_TRUE(engine.sets_up_alike()) << words << ", " << steps;
      }
  }
}
