// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Triangles that programs leave apart: corners that differ a little, corners on edges of others.

#include "body/shape/mesh_seams.h"
#include "body/shape/triangle_mesh.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace Talus;

namespace {

using V = Vector3<double>;

/// The unit cube from `at`, its faces cut into n x n squares but for the top, which is two triangles.
std::vector<Triangle> cube_with_plain_top(int n)
{
  std::vector<Triangle> soup;
  const auto face = [&](const V &origin, const V &u, const V &v, int cuts) {
    const auto at = [&](int i, int j) {
      return origin + static_cast<double>(i) / cuts * u + static_cast<double>(j) / cuts * v;
    };
    for (int i = 0; i < cuts; i++)
      for (int j = 0; j < cuts; j++) {
        soup.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
        soup.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
      }
  };
  const V x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  face({0, 0, 0}, y, x, n);
  face({0, 0, 1}, x, y, 1);
  face({0, 0, 0}, x, z, n);
  face({0, 1, 0}, z, x, n);
  face({0, 0, 0}, z, y, n);
  face({1, 0, 0}, y, z, n);
  return soup;
}

TEST(MeshVertices, CornersWithinTheToleranceAreOne)
{
  MeshVertices vertices(0.01);
  EXPECT_EQ(vertices.at({0.0, 0.0, 0.0}), 0);
  EXPECT_EQ(vertices.at({0.004, -0.004, 0.004}), 0);
  EXPECT_EQ(vertices.at({0.02, 0.0, 0.0}), 1);
  EXPECT_EQ(vertices.at({-0.0, 0.0, -0.0}), 0);
  // nearer to the last one, but the first is near enough
  EXPECT_EQ(vertices.at({0.0099, 0.0, 0.0}), 0);
  EXPECT_EQ(vertices.at({0.0101, 0.0, 0.0}), 1);
  EXPECT_EQ(vertices.num_joined(), 3);
  EXPECT_NEAR(vertices.largest_gap(), 0.0099, 1e-15);
  EXPECT_EQ(vertices.all().size(), 2U);
  EXPECT_EQ(vertices.all()[1].x, 0.02);
}

TEST(MeshVertices, ToleranceOfNothingJoinsWhatIsEqual)
{
  MeshVertices vertices(0.0);
  EXPECT_EQ(vertices.at({1.0, 0.0, 0.0}), 0);
  EXPECT_EQ(vertices.at({std::nextafter(1.0, 2.0), 0.0, 0.0}), 1);
  EXPECT_EQ(vertices.at({1.0, -0.0, 0.0}), 0);
  EXPECT_EQ(vertices.num_joined(), 0);
}

// A chain of points that are all near to the next.
TEST(MeshVertices, NoVertexIsFurtherAwayThanTheTolerance)
{
  RandomSource random(3);
  MeshVertices vertices(0.05);
  for (int k = 0; k < 3000; k++) {
    const V p{random.uniform(0.0, 1.0), random.uniform(0.0, 1.0), random.uniform(0.0, 0.1)};
    const int v = vertices.at(p);
    EXPECT_LE(length(vertices.all()[v] - p), 0.05);
  }
  const std::vector<V> &all = vertices.all();
  for (std::size_t a = 0; a < all.size(); a++)
    for (std::size_t b = 0; b < a; b++) EXPECT_GT(length(all[a] - all[b]), 0.05);
}

TEST(MeshSeams, TrianglesAreDividedWhereCornersLieOnTheirEdges)
{
  for (const int n : {1, 2, 3, 7}) {
    const std::vector<Triangle> soup = cube_with_plain_top(n);
    const TriangleMesh mesh(soup, true);
    EXPECT_TRUE(mesh.report().closed()) << n;
    EXPECT_NEAR(std::fabs(mesh.volume()), 1.0, 1e-14);
    EXPECT_NEAR(length(mesh.center() - V{0.5, 0.5, 0.5}), 0.0, 1e-14);
    EXPECT_EQ(mesh.report().divided_edges, n > 1 ? 4 : 0);
    EXPECT_EQ(mesh.size(), static_cast<int>(soup.size()) + 4 * (n - 1));
    double top = 0.0;
    for (int t = 0; t < mesh.size(); t++) {
      const int number = mesh.number_in_file(t);
      const bool of_top = number == 2 * n * n || number == 2 * n * n + 1;
      EXPECT_EQ(of_top, std::fabs(mesh.normal(t).z) > 0.5 && mesh.triangle(t).corner[0].z > 0.5);
      if (of_top) top += mesh.area(t);
    }
    EXPECT_NEAR(top, 1.0, 1e-14);
    EXPECT_EQ(mesh.report().first_divided, n > 1 ? 2 * n * n + 1 : 0);
  }
}

TEST(MeshSeams, NothingIsDividedWithoutTolerance)
{
  const TriangleMesh mesh(cube_with_plain_top(3), true, 0.0);
  EXPECT_EQ(mesh.report().divided_edges, 0);
  EXPECT_EQ(mesh.report().open_edges, 4 + 12);
}

// As a program that writes seven digits leaves them.
TEST(MeshSeams, RoundedCornersCloseAMesh)
{
  RandomSource random(5);
  std::vector<Triangle> soup = cube_with_plain_top(4);
  for (Triangle &t : soup)
    for (V &p : t.corner)
      p = p + 2.0e-7 * V{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  const TriangleMesh mesh(soup, true);
  EXPECT_TRUE(mesh.report().closed());
  EXPECT_GT(mesh.report().joined_corners, 50);
  EXPECT_LT(mesh.report().largest_gap, 7e-7);
  EXPECT_NEAR(std::fabs(mesh.volume()), 1.0, 1e-6);
  EXPECT_FALSE(TriangleMesh(soup, true, 0.0).report().closed());
}

// Edges that have only a part in common, on both sides of a seam.
TEST(MeshSeams, EdgesThatOverlapInPart)
{
  const std::vector<Triangle> soup{{{V{0, 0, 0}, V{2, 0, 0}, V{1, 1, 0}}},
                                   {{V{3, 0, 0}, V{1, 0, 0}, V{2, -1, 0}}}};
  const TriangleMesh mesh(soup);
  EXPECT_EQ(mesh.size(), 4);
  EXPECT_EQ(mesh.report().divided_edges, 2);
  EXPECT_EQ(mesh.report().open_edges, 6);
  for (int t = 0; t < 4; t++) EXPECT_EQ(mesh.plane_of(t), 0);
}

}    // namespace
