// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The volume of a ball in the kernel of coarse-grained fields, beside the sum over many small parts of it.

#include "system/loads/coarse_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace Talus;

namespace {

constexpr double pi = 3.14159265358979323846;

double phi(double r, double width)
{
  const double one = 1.0 - r * r / (width * width);
  return one > 0.0 ? one * one : 0.0;
}

/// Integral of phi over a ball, by cubes of a small edge; the distance is along an axis.
double by_parts(double distance, double radius, double width)
{
  constexpr int parts = 100;    // of the diameter
  const double h = 2.0 * radius / parts;
  double sum = 0.0;
  for (int i = 0; i < parts; i++)
    for (int j = 0; j < parts; j++)
      for (int k = 0; k < parts; k++) {
        const double x = (i + 0.5) * h - radius, y = (j + 0.5) * h - radius,
                     z = (k + 0.5) * h - radius;
        if (x * x + y * y + z * z > radius * radius) continue;
        sum += phi(std::sqrt((x - distance) * (x - distance) + y * y + z * z), width);
      }
  return sum * (h * h * h);
}

/// The same of the mean along one direction, and along two.
double by_parts_seen(double distance, double radius, double width, int dimensions)
{
  constexpr int parts = 100;    // of the diameter
  const double h = 2.0 * radius / parts;
  double sum = 0.0;
  for (int i = 0; i < parts; i++)
    for (int j = 0; j < parts; j++) {
      const double x = (i + 0.5) * h - radius, y = (j + 0.5) * h - radius,
                   rest = radius * radius - x * x - y * y;
      if (rest <= 0.0) continue;
      const double off = x - distance, across = dimensions == 2 ? y : 0.0;
      sum += 2.0 * std::sqrt(rest) * phi(std::sqrt(off * off + across * across), width);
    }
  return sum * h * h;
}

}    // namespace

TEST(CoarseKernel, volumeOfABallAlongOneAndTwoCoordinates)
{
  const Vector3<double> none{0.0, 0.0, 0.0}, edge{0.1, 0.1, 0.1};
  for (const double width : {0.3, 1.0, 2.5}) {
    const CoarseKernel kernel(none, edge, width);
    for (const double radius : {0.2, 0.6, 1.7})
      for (const double distance : {0.0, 0.1, 0.3, 0.9, 1.1, 1.9, 2.6, 5.0}) {
        const double ball = 4.0 / 3.0 * pi * radius * radius * radius;
        EXPECT_NEAR(pi * kernel.within_discs(distance, radius),
                    by_parts_seen(distance, radius, width, 1), 1e-3 * ball)
            << width << " " << radius << " " << distance;
        if (width < radius) continue;
        EXPECT_NEAR(pi * kernel.within_chords(distance, radius),
                    by_parts_seen(distance, radius, width, 2), 2e-3 * ball)
            << width << " " << radius << " " << distance;
      }
  }
}

TEST(CoarseKernel, nothingIsLostWhereTheMeanIsTaken)
{
  const Vector3<double> origin{-1.0, 0.3, 0.0}, edge{2.0, 0.1, 3.0}, x{0.01, 0.02, 0.03},
      y{0.4, 0.2, 0.0};
  for (const std::array<bool, 3> mean_of :
       {std::array<bool, 3>{true, false, true}, {true, false, false}, {true, true, true}}) {
    const Vector3<double> edges{edge.x, mean_of[1] ? 2.0 : edge.y, mean_of[2] ? edge.z : 0.2};
    CoarseKernel kernel(origin, edges, 0.4, CoarseKernel::no_ends, mean_of);
    const auto sum = [&](const std::vector<CoarseKernel::Share> &shares) {
      double all = 0.0;
      for (const CoarseKernel::Share &one : shares) {
        for (int d = 0; d < 3; d++)
          if (mean_of[d]) {
            EXPECT_EQ(one.cell[d], 0);
          }
        all += one.weight * edges.x * edges.y * edges.z;
      }
      return all;
    };
    EXPECT_NEAR(sum(kernel.of_point(x)), 1.0, 1e-12);
    EXPECT_NEAR(sum(kernel.of_line(x, y)), 1.0, 1e-12);
    EXPECT_NEAR(sum(kernel.of_ball(x, 0.5)), 1.0, 1e-12);
  }
}

TEST(CoarseKernel, volumeOfABallIsWhereItIs)
{
  const Vector3<double> none{0.0, 0.0, 0.0}, edge{0.1, 0.1, 0.1};
  for (const double width : {0.3, 1.0, 2.5}) {
    CoarseKernel kernel(none, edge, width);
    const double all = 32.0 / 105.0 * pi * width * width * width;    // integral of phi
    for (const double radius : {0.2, 1.0, 1.7})
      for (const double distance : {0.0, 1e-9, 0.1, 0.3, 0.9, 1.1, 1.9, 2.6, 5.0}) {
        const double expected = by_parts(distance, radius, width),
                     ball = 4.0 / 3.0 * pi * radius * radius * radius;
        EXPECT_NEAR(pi * kernel.within_ball(distance, radius), expected, 5e-3 * std::min(all, ball))
            << width << " " << radius << " " << distance;
      }
    // a point deep inside sees nothing else
    EXPECT_NEAR(pi * kernel.within_ball(0.2, width + 0.2), all, 1e-14 * all);
    EXPECT_EQ(kernel.within_ball(width + 0.7, 0.7), 0.0);
  }
}

TEST(CoarseKernel, nothingOfABallIsLost)
{
  const Vector3<double> origin{-1.0, 0.3, 0.0}, edge{0.11, 0.1, 0.13};
  for (const double width : {0.13, 0.4})
    for (const double radius : {1e-6, 0.05, 0.7, 1.5}) {
      CoarseKernel kernel(origin, edge, width);
      const double cell = edge.x * edge.y * edge.z,
                   ball = 4.0 / 3.0 * pi * radius * radius * radius;
      const Vector3<double> x{0.01, 0.02, 0.03};
      double sum = 0.0, largest = 0.0, moment = 0.0;
      for (const CoarseKernel::Share &one : kernel.of_ball(x, radius)) {
        sum += cell * one.weight;
        largest = std::max(largest, ball * one.weight);
        moment += cell * one.weight * (origin.x + (one.cell[0] + 0.5) * edge.x - x.x);
      }
      EXPECT_NEAR(sum, 1.0, 1e-12);
      EXPECT_LT(largest, 1.01) << width << " " << radius;
      EXPECT_NEAR(moment, 0.0, 0.1 * edge.x);
      if (radius > width + 0.2) {
        EXPECT_GT(largest, 0.99);
      }
    }
}
