// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Narrow phase of convex particles: time per pair that touches, that nearly does, and that is apart, with the direction
// known from the step before. Arguments: vertices of each body, 1 if rounded.

#include "shape/convex/collide.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

using namespace Talus;

namespace {

std::vector<Vector3<double>> corners(int count)
{
  std::vector<Vector3<double>> points;
  if (count == 20) {
    const double phi = 0.5 * (1.0 + std::sqrt(5.0)), s = 0.5 / std::sqrt(3.0);
    for (const double a : {-s, s})
      for (const double b : {-s, s}) {
        for (const double c : {-s, s}) points.push_back({a, b, c});
        points.push_back({0.0, a / phi, b * phi});
        points.push_back({a / phi, b * phi, 0.0});
        points.push_back({a * phi, 0.0, b / phi});
      }
    return points;
  }
  const double golden = 2.39996322972865332;    // a spiral on the sphere
  for (int k = 0; k < count; k++) {
    const double z = 1.0 - (2.0 * k + 1.0) / count, across = std::sqrt(1.0 - z * z);
    points.push_back(
        {0.5 * across * std::cos(golden * k), 0.5 * across * std::sin(golden * k), 0.5 * z});
  }
  return points;
}

ConvexShape body(int count, double radius)
{
  if (count == 8) return ConvexShape::box({0.8, 0.8, 0.8}, radius);
  return ConvexShape::polyhedron(corners(count), radius);
}

struct Couple {
  Pose a, b;
  SeparatingDirection direction;
};

/* Random orientations; b is moved from far away until it touches, and then by `deeper`. */

std::vector<Couple> couples(const ConvexShape &shape, double deeper)
{
  std::mt19937 random(1);
  const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
  const auto orientation = [&] {
    return Eigen::Quaterniond(number(), number(), number(), number()).normalized();
  };
  std::vector<Couple> all;
  ShapeContacts contacts;
  for (int k = 0; k < 256; k++) {
    Couple couple{Pose({0.0, 0.0, 0.0}, orientation()), Pose({0.0, 0.0, 0.0}, orientation()), {}};
    const Vector3<double> d =
        from_eigen(Eigen::Vector3d(number(), number(), number()).normalized());
    double near = 0.0, far = 1.001 * 2.0 * shape.bounding_radius();
    for (int step = 0; step < 40; step++) {
      couple.b.position = 0.5 * (near + far) * d;
      const bool touch = collide(shape, couple.a, shape, couple.b, couple.direction, contacts);
      (touch ? near : far) = 0.5 * (near + far);
    }
    couple.b.position = (near - deeper) * d;
    collide(shape, couple.a, shape, couple.b, couple.direction, contacts);
    all.push_back(couple);
  }
  return all;
}

void run(benchmark::State &state, double deeper, NarrowPhase method)
{
  const ConvexShape shape = body(static_cast<int>(state.range(0)), state.range(1) ? 0.05 : 0.0);
  std::vector<Couple> all = couples(shape, deeper);
  ShapeContacts contacts;
  std::size_t found = 0, pairs = 0;
  for (auto _ : state)
    for (Couple &couple : all) {
      collide(shape, couple.a, shape, couple.b, couple.direction, contacts, method);
      found += contacts.points.size();
      pairs++;
    }
  state.SetItemsProcessed(static_cast<std::int64_t>(pairs));
  state.counters["contacts"] = static_cast<double>(found) / static_cast<double>(pairs);
  state.counters["ns"] =
      benchmark::Counter(1.0e-9 * static_cast<double>(pairs),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void touching(benchmark::State &state)
{
  run(state, 1.0e-3, NarrowPhase::FEATURES);
}
void apart(benchmark::State &state)
{
  run(state, -5.0e-2, NarrowPhase::FEATURES);
}
void mpr(benchmark::State &state)
{
  run(state, 1.0e-3, NarrowPhase::MPR);
}
const std::vector<std::vector<std::int64_t>> kinds{{8, 20, 100, 500}, {0, 1}};
BENCHMARK(touching)->ArgsProduct(kinds);
BENCHMARK(apart)->ArgsProduct(kinds);
BENCHMARK(mpr)->ArgsProduct(kinds);

}    // namespace

BENCHMARK_MAIN();
