// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Springs at the corners of the faces of a body: its highest frequency against closed formulas.

#include "shape/convex/convex_shape.h"
#include "shape/face_stiffness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace Talus;

namespace {

double largest(const ConvexShape &shape, double kn, double kt)
{
  return FaceStiffness(shape).largest(kn, kt);
}

}    // namespace

TEST(FaceStiffness, Cube)
{
  // translation 8 kn + 16 kt; rotation: per face of four about an axis 4 (s/2)^2 (kn of two pairs,
  // kt of all), over the moment s^2/6
  for (const double edge : {1.0, 0.02}) {
    const ConvexShape cube = ConvexShape::box({edge, edge, edge}, 0.0);
    EXPECT_NEAR(largest(cube, 3.0, 0.0), 72.0, 1e-11);
    EXPECT_NEAR(largest(cube, 3.0, 3.0), 216.0, 1e-11);
    EXPECT_NEAR(largest(cube, 0.0, 1.0), 48.0, 1e-11);
  }
}

TEST(FaceStiffness, Plate)
{
  // height h of 1 x 1 x h: translation across it is as before, and the rotation about an edge of
  // the plate has kn (8/4 of the faces, 8 h^2/4 of the sides) over (1 + h^2)/12
  constexpr double h = 0.1;
  const ConvexShape plate = ConvexShape::box({1.0, 1.0, h}, 0.0);
  EXPECT_NEAR(largest(plate, 1.0, 0.0), 12.0 * (2.0 + 2.0 * h * h) / (1.0 + h * h), 1e-11);
}

TEST(FaceStiffness, WeightsOfCorners)
{
  // the triangles of a sharp tetrahedron turn by 120 degrees at each corner: 4/3; rounded ones
  // count 1, and a little more by their lever arms
  const std::vector<Vector3<double>> corners = {
      {1.0, 1.0, 1.0}, {1.0, -1.0, -1.0}, {-1.0, 1.0, -1.0}, {-1.0, -1.0, 1.0}};
  const double sharp = largest(ConvexShape::polyhedron(corners, 0.0), 1.0, 1.0);
  const double rounded = largest(ConvexShape::polyhedron(corners, 1.0e-9), 1.0, 1.0);
  EXPECT_NEAR(sharp / rounded, 4.0 / 3.0, 1e-6);
}

namespace {

ConvexShape prism(int sides, double height, double rounding)
{
  std::vector<Vector3<double>> corners;
  for (int k = 0; k < sides; k++)
    for (const double z : {-0.5 * height, 0.5 * height})
      corners.push_back(
          {std::cos(6.283185307179586 * k / sides), std::sin(6.283185307179586 * k / sides), z});
  return ConvexShape::polyhedron(corners, rounding);
}

}    // namespace

TEST(FaceStiffness, OneFaceMayHoldABodyBest)
{
  // the cap of a prism, of radius 1 and moment (2 + cos(2 pi/n))/12 + h^2/12 about a line in it: on a
  // large body each corner is a contact, on another sharp shape all together are four
  constexpr double h = 0.2;
  for (const int n : {50, 100}) {
    const double moment = (2.0 + std::cos(6.283185307179586 / n) + h * h) / 12.0;
    const FaceStiffness sharp(prism(n, h, 0.0)), rounded(prism(n, h, 1.0e-9));
    EXPECT_NEAR(sharp.largest_on_bodies(3.0, 0.0), 1.5 * n / moment, 1e-9 * n);
    EXPECT_NEAR(rounded.largest_on_bodies(3.0, 0.0), 1.5 * n / moment, 1e-6 * n);
    EXPECT_GE(sharp.largest(3.0, 0.0), 6.0 / moment);
    EXPECT_LT(sharp.largest(3.0, 0.0), 0.5 * sharp.largest_on_bodies(3.0, 0.0));
  }
}

TEST(FaceStiffness, ManyFacesCountLess)
{
  // the sides of a long prism
  EXPECT_LT(largest(prism(400, 4.0, 0.0), 1.0, 1.0), largest(prism(10, 4.0, 0.0), 1.0, 1.0));
}

TEST(FaceStiffness, OnLargeBodies)
{
  // three faces of a cube in a corner; a tetrahedron on one of its faces: 3 kn
  const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, 0.0);
  EXPECT_NEAR(FaceStiffness(cube).largest_on_bodies(3.0, 3.0), 108.0, 1e-11);
  const std::vector<Vector3<double>> corners = {
      {1.0, 1.0, 1.0}, {1.0, -1.0, -1.0}, {-1.0, 1.0, -1.0}, {-1.0, -1.0, 1.0}};
  EXPECT_GE(FaceStiffness(ConvexShape::polyhedron(corners, 0.0)).largest_on_bodies(1.0, 0.0), 3.0);
}
