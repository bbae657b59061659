// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The tree of boxes against all boxes one by one: none is missing near a point, and each overlapping pair
// comes once, also after the boxes have moved.

#include "body/shape/box_tree.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

using namespace Talus;

namespace {

using Boxes = std::vector<Eigen::AlignedBox3d>;

/// Some of them flat, some points; `size` over that of the whole, which is far from the origin.
Boxes random_boxes(RandomSource &random, int count, double scale, double size)
{
  Boxes boxes;
  for (int n = 0; n < count; n++) {
    const std::array<double, 3> x = random.in_cube(1.0), s = random.in_cube(size);
    Eigen::Vector3d half(std::fabs(s[0]), std::fabs(s[1]), std::fabs(s[2]));
    if (n % 3 == 0) half[n % 9 / 3] = 0.0;
    if (n % 10 == 0) half.setZero();
    const Eigen::Vector3d center(x[0] + 3.0, x[1], x[2] - 7.0);
    boxes.emplace_back(scale * (center - half), scale * (center + half));
  }
  return boxes;
}

class BoxTreeTest : public testing::TestWithParam<int> {
 protected:
  void compare(const BoxTree &tree, const Boxes &boxes, double scale)
  {
    const int count = static_cast<int>(boxes.size());
    int near = 0, visited = 0;
    for (int n = 0; n < 200; n++) {
      const std::array<double, 3> x = random.in_cube(1.2);
      const Vector3<double> p{scale * (x[0] + 3.0), scale * x[1], scale * (x[2] - 7.0)};
      const double reach = scale * random.decade(-3.0, -0.5);
      std::vector<int> found(count);
      tree.visit_near(p, reach, [&](int thing) { found[thing]++; });
      for (int k = 0; k < count; k++) {
        ASSERT_LE(found[k], 1);
        visited += found[k];
        if (!(boxes[k].exteriorDistance(to_eigen(p)) < reach)) continue;
        near++;
        ASSERT_EQ(found[k], 1);
      }
    }
    EXPECT_TRUE(near > 0 || count < 48);
    EXPECT_TRUE(visited < near + 100 * count || count < 300);    // half of all

    std::set<std::pair<int, int>> pairs;
    tree.visit_overlaps([&](int a, int b) {
      ASSERT_NE(a, b);
      ASSERT_TRUE(pairs.insert({std::min(a, b), std::max(a, b)}).second);
    });
    for (int a = 0; a < count; a++)
      for (int b = a + 1; b < count; b++)
        ASSERT_TRUE(!boxes[a].intersects(boxes[b]) || pairs.count({a, b}));
  }

  RandomSource random{3};
};

TEST_P(BoxTreeTest, FindsAll)
{
  const int count = GetParam();
  for (const double scale : {1.0, 1.0e-9, 1.0e6}) {
    const Boxes boxes = random_boxes(random, count, scale, 0.15);
    BoxTree tree(boxes);
    compare(tree, boxes, scale);

    Boxes moved = boxes;
    for (Eigen::AlignedBox3d &box : moved) {
      const std::array<double, 3> way = random.in_cube(0.02 * scale);
      box.translate(Eigen::Vector3d(way[0], way[1], way[2]));
    }
    EXPECT_FALSE(tree.refit(moved));
    compare(tree, moved, scale);
  }
}

INSTANTIATE_TEST_SUITE_P(Counts, BoxTreeTest, testing::Values(1, 8, 9, 64, 65, 300, 1000));

TEST(BoxTreeAlone, WantsANewTreeIfBoxesHaveMixed)
{
  RandomSource random(4);
  const Boxes boxes = random_boxes(random, 500, 1.0, 0.01);
  BoxTree tree(boxes);
  Boxes mixed = boxes;
  random.shuffle(mixed);
  EXPECT_TRUE(tree.refit(mixed));
}

}    // namespace
