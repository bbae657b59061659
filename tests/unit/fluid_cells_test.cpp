// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Shares of grains in the cells of a fluid: they add up to 1 and are those of volumes found by counting points; at ends and
// across periods; the same for points in any order; grains outside.

#include "fluid/grid_cells.h"
#include "fluid/point_cells.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

using namespace Talus;

namespace {

using Shares = std::vector<FluidCells::Share>;

constexpr FluidKernel own_ball{FluidKernel::Shape::TOP_HAT, 0.0};
constexpr FluidCells::Periods none{{0, 0, 0}, {0, 0, 0}};
constexpr FluidCells::Periods round_x{{-1, 0, 0}, {4, 0, 0}};

FluidKernel gaussian(double width)
{
  return {FluidKernel::Shape::GAUSSIAN, width};
}

/// 4 x 3 x 2 cells with edges 1, 2 and 3, from -1 -2 -3 on.
GridCells grid(const FluidKernel &kernel, const FluidCells::Periods &periods = none)
{
  const double lo[3] = {-1, -2, -3}, hi[3] = {3, 4, 3};
  const int cells[3] = {4, 3, 2};
  return GridCells(kernel, lo, hi, cells, periods);
}

/// A cubic lattice of points, n^3 in a box of this length from 0 on.
std::vector<PointCells::Cell> lattice(int n, double length)
{
  std::vector<PointCells::Cell> cells;
  const double edge = length / n;
  for (int k = 0; k < n; k++)
    for (int j = 0; j < n; j++)
      for (int i = 0; i < n; i++)
        cells.push_back(
            {{(i + 0.5) * edge, (j + 0.5) * edge, (k + 0.5) * edge}, edge * edge * edge});
  std::sort(cells.begin(), cells.end(), PointCells::comes_before);
  return cells;
}

std::map<int, double> by_cell(const FluidCells &cells, std::vector<double> x, double radius)
{
  Shares shares;
  EXPECT_TRUE(cells.find_shares(x.data(), radius, shares));
  std::map<int, double> found;
  for (const FluidCells::Share &share : shares) found[share.cell] += share.weight;
  return found;
}

double sum_of(const std::map<int, double> &shares)
{
  double sum = 0.0;
  for (const auto &[cell, weight] : shares) {
    EXPECT_GE(weight, 0.0);
    sum += weight;
  }
  return sum;
}

}    // namespace

TEST(FluidCells, SharesAddUpToOne)
{
  RandomSource random(1);
  const std::vector<PointCells::Cell> points = lattice(6, 3.0);
  for (int n = 0; n < 400; n++) {
    const std::vector<double> x{random.uniform(-1, 3), random.uniform(-2, 4),
                                random.uniform(-3, 3)},
        y{random.uniform(0, 3), random.uniform(0, 3), random.uniform(0, 3)};
    const double radius = std::exp2(random.uniform(-6.0, 1.5));
    for (const FluidKernel &kernel :
         {own_ball, FluidKernel{FluidKernel::Shape::TOP_HAT, 2.5}, gaussian(0.05), gaussian(0.8)}) {
      for (const FluidCells::Periods &periods : {none, round_x})
        EXPECT_NEAR(sum_of(by_cell(grid(kernel, periods), x, radius)), 1.0, 4e-15);
      EXPECT_NEAR(sum_of(by_cell(PointCells(kernel, points, none), y, radius)), 1.0, 1e-14);
      EXPECT_NEAR(sum_of(by_cell(PointCells(kernel, points, {{0, 0, 0}, {3, 0, 3}}), y, radius)),
                  1.0, 1e-14);
    }
  }
}

/* Points in the ball, one in each box of a fine grid, are counted in each cell; those beyond the ends are left out. */

TEST(FluidCells, BallIsDividedByVolume)
{
  RandomSource random(2);
  const GridCells cells = grid(own_ball);
  for (int n = 0; n < 20; n++) {
    const std::vector<double> x{random.uniform(-1, 3), random.uniform(-2, 4),
                                random.uniform(-3, 3)};
    const double radius = random.uniform(0.2, 2.0);
    std::map<int, double> counted;
    double inside = 0.0;
    constexpr int half = 45;
    for (int k = -half; k < half; k++)
      for (int j = -half; j < half; j++)
        for (int i = -half; i < half; i++) {
          const double off[3] = {(i + random.uniform(0, 1)) / half,
                                 (j + random.uniform(0, 1)) / half,
                                 (k + random.uniform(0, 1)) / half};
          if (off[0] * off[0] + off[1] * off[1] + off[2] * off[2] > 1.0) continue;
          const double at[3] = {x[0] + radius * off[0], x[1] + radius * off[1],
                                x[2] + radius * off[2]};
          if (std::fabs(at[0] - 1) > 2 || std::fabs(at[1] - 1) > 3 || std::fabs(at[2]) > 3)
            continue;
          inside += 1.0;
          counted[static_cast<int>(at[0] + 1) + 4 * static_cast<int>((at[1] + 2) / 2) +
                  12 * static_cast<int>((at[2] + 3) / 3)] += 1.0;
        }
    std::map<int, double> found = by_cell(cells, x, radius);
    for (int cell = 0; cell < cells.size(); cell++)
      EXPECT_NEAR(found[cell], counted[cell] / inside, 2e-3) << cell;
  }
}

TEST(FluidCells, WideTopHatIsABallOfItsDiameter)
{
  const std::vector<double> x{0.3, 0.1, 0.2};
  EXPECT_EQ(by_cell(grid({FluidKernel::Shape::TOP_HAT, 3.0}), x, 0.1),
            by_cell(grid(own_ball), x, 1.5));
  EXPECT_EQ(by_cell(grid({FluidKernel::Shape::TOP_HAT, 3.0}), x, 2.0),
            by_cell(grid(own_ball), x, 2.0));
}

TEST(FluidCells, SmallGrainInsideACell)
{
  const std::map<int, double> found = by_cell(grid(own_ball), {0.5, 1.0, -1.5}, 0.49);
  EXPECT_EQ(found, (std::map<int, double>{{1 + 4 * 1 + 12 * 0, 1.0}}));
}

/* Half of a Gaussian is on each side of a face; integrals of cells from tables of erf. */

TEST(FluidCells, GaussianIsIntegratedOverCells)
{
  std::map<int, double> found = by_cell(grid(gaussian(0.5)), {1.0, 1.0, -1.5}, 0.01);
  // along x two cells on each side: erf(2), which is cut at 3 widths: erf(3)
  double first = 0.0, second = 0.0;
  for (const auto &[cell, weight] : found) {
    if (cell % 4 == 1) first += weight;
    if (cell % 4 == 0) second += weight;
  }
  EXPECT_NEAR(first, 0.5 * 0.9953222650189527 / 0.9999779095030014, 1e-14);
  EXPECT_NEAR(second, 0.5 * (0.9999779095030014 - 0.9953222650189527) / 0.9999779095030014, 1e-14);
}

TEST(FluidCells, GridGoesRound)
{
  const FluidKernel wide{FluidKernel::Shape::TOP_HAT, 1.6};
  for (const FluidKernel &kernel : {wide, gaussian(0.4)}) {
    const GridCells round = grid(kernel, round_x);
    std::map<int, double> first = by_cell(round, {-0.9, 1.0, 1.0}, 0.3),
                          moved = by_cell(round, {1.1, 1.0, 1.0}, 0.3),
                          in_next = by_cell(round, {3.1, 1.0, 1.0}, 0.3);
    EXPECT_GT(first[3 + 4 * 1 + 12], 0.01);
    for (const auto &[cell, weight] : moved) {
      const int back = cell - cell % 4 + (cell % 4 + 2) % 4;
      EXPECT_NEAR(weight, first[back], 1e-14);
      EXPECT_NEAR(weight, in_next[back], 1e-14);
    }
  }
}

TEST(FluidCells, OutsideOfTheGrid)
{
  const GridCells cells = grid(own_ball);
  Shares shares;
  for (const std::vector<double> &x :
       {std::vector<double>{3.1, 0, 0}, {0, -2.1, 0}, {0, 0, 3.001}}) {
    EXPECT_FALSE(cells.find_shares(x.data(), 0.5, shares));
    EXPECT_TRUE(shares.empty());
  }
  const double x[3] = {5.0, 0.5, -9.0};
  EXPECT_EQ(cells.nearest_to(x), 3 + 4 * 1);
}

TEST(FluidCells, WhatIsWrongWithAGrid)
{
  const double lo[3] = {0, 0, 0}, hi[3] = {4, 4, 4}, flat[3] = {4, 0, 4};
  const int cells[3] = {2, 2, 2}, zero[3] = {2, 2, 0}, many[3] = {1000, 1000, 1000};
  EXPECT_EQ(GridCells::problem(own_ball, lo, hi, cells, none), "");
  EXPECT_EQ(GridCells::problem(own_ball, lo, hi, zero, none),
            "cells along z are 0, expected 1 or more");
  EXPECT_EQ(GridCells::problem(own_ball, lo, flat, cells, none),
            "hi is not larger than lo along y");
  EXPECT_EQ(GridCells::problem(own_ball, lo, hi, many, none), "the grid has more than 1e8 cells");
  EXPECT_EQ(GridCells::problem(gaussian(4.1), lo, hi, cells, none),
            "the kernel is wider than the grid is long");
  EXPECT_EQ(GridCells::problem(own_ball, lo, hi, cells, {{0, 0, 0}, {3.9, 0, 0}}),
            "the grid is longer than the period of the box along x");
}

/* ---- points --------------------------------------------------------------------------------- */

/* Of a fine lattice of points, sums over those of a coarse cell are what the grid of these cells has. The ball of the top hat
   is wider by 1.5 lengths of a cell: its edge is soft. */

TEST(FluidCells, ManyPointsAreLikeAGrid)
{
  const std::vector<PointCells::Cell> points = lattice(40, 4.0);
  const double lo[3] = {0, 0, 0}, hi[3] = {4, 4, 4};
  const int two[3] = {2, 2, 2};
  for (const FluidKernel &kernel : {FluidKernel{FluidKernel::Shape::TOP_HAT, 2.4}, gaussian(0.7)}) {
    const bool soft = kernel.shape == FluidKernel::Shape::TOP_HAT;
    const FluidKernel wider{kernel.shape, kernel.width + (soft ? 1.5 * 0.1 : 0.0)};
    const PointCells fine(kernel, points, none);
    std::map<int, double> of_grid =
                              by_cell(GridCells(wider, lo, hi, two, none), {1.7, 2.2, 2.4}, 0.1),
                          of_points;
    for (const auto &[cell, weight] : by_cell(fine, {1.7, 2.2, 2.4}, 0.1)) {
      const double *const x = points[cell].x;
      of_points[(x[0] > 2) + 2 * (x[1] > 2) + 4 * (x[2] > 2)] += weight;
    }
    for (int cell = 0; cell < 8; cell++) EXPECT_NEAR(of_points[cell], of_grid[cell], 3e-3);
  }
}

TEST(FluidCells, PointsGoRound)
{
  const FluidCells::Periods periods{{0, 0, 0}, {3, 3, 0}};
  for (const FluidKernel &kernel : {own_ball, gaussian(0.4)}) {
    const PointCells cells(kernel, lattice(6, 3.0), periods);
    std::map<int, double> inside = by_cell(cells, {1.6, 1.6, 1.6}, 0.3),
                          across = by_cell(cells, {3.1, -1.4 + 6.0, 1.6}, 0.3);
    EXPECT_EQ(inside.size(), across.size());
    for (const auto &[cell, weight] : inside) {    // three cells along x and none along y
      const int moved = cell - cell % 6 + (cell % 6 + 3) % 6;
      EXPECT_NEAR(across[moved], weight, 1e-14);
    }
  }
}

/* All at once in a list, against bins. */

TEST(FluidCells, NoPointIsMissed)
{
  RandomSource random(5);
  std::vector<PointCells::Cell> points;
  for (int n = 0; n < 500; n++)
    points.push_back({{random.uniform(0, 5), random.uniform(0, 2), random.uniform(-1, 0)},
                      std::exp2(random.uniform(-6.0, -2.0))});
  std::sort(points.begin(), points.end(), PointCells::comes_before);
  for (const FluidCells::Periods &periods : {none, FluidCells::Periods{{0, 0, 0}, {5, 2, 0}}}) {
    const PointCells cells(own_ball, points, periods);
    for (int n = 0; n < 100; n++) {
      const std::vector<double> x{random.uniform(0, 5), random.uniform(0, 2),
                                  random.uniform(-1, 0)};
      std::map<int, double> raw;
      double sum = 0.0;
      for (int k = 0; k < 500; k++) {
        double square = 0.0;
        for (int d = 0; d < 3; d++) {
          double off = std::fabs(x[d] - points[k].x[d]);
          if (periods.length[d] > 0) off = std::min(off, periods.length[d] - off);
          square += off * off;
        }
        const double share =
            points[k].volume *
            std::clamp(1.0 - (std::sqrt(square) - 0.2) / (1.5 * std::cbrt(points[k].volume)), 0.0,
                       1.0);
        if (share > 0.0) raw[k] = share;
        sum += share;
      }
      std::map<int, double> found = by_cell(cells, x, 0.2);
      EXPECT_EQ(found.size(), raw.size());
      for (const auto &[cell, share] : raw) EXPECT_NEAR(found[cell], share / sum, 1e-13);
    }
  }
}

TEST(FluidCells, OutsideOfPoints)
{
  const PointCells cells(own_ball, lattice(4, 2.0), none);
  Shares shares;
  const double far[3] = {3.5, 1.0, 1.0}, corner[3] = {0.0, 2.0, 0.0};
  EXPECT_FALSE(cells.find_shares(far, 0.1, shares));
  EXPECT_EQ(cells.nearest_to(far), 3 + 4 * 1 + 16 * 1);
  EXPECT_TRUE(
      cells.find_shares(corner, 0.001, shares));    // of a box of which the points are centers
  EXPECT_EQ(shares.size(), 1U);
}
