// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Lists of the particles that may touch a large body that moves: until they are stale none is missing that
// touches, and they get stale as the surface moves, wherever the furthest particle is.

#include "base/cube_root.h"
#include "body/contact/body_candidates.h"
#include "body/shape/ball.h"
#include "body/shape/box.h"
#include "body/shape/frustum.h"
#include "body/shape/mesh_shape.h"
#include "body/shape/rectangle.h"
#include "packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

using namespace Talus;
using namespace slow;

namespace {

constexpr double skin = 0.2, pi = 3.14159265358979324;

/// Within 2.5 of the origin; none is centered there.
std::unique_ptr<LargeBodyShape> make_shape(int kind)
{
  const Vector3<double> middle{0.3, -0.2, 0.1};
  switch (kind) {
  case 0:
    return std::make_unique<Ball>(middle, 1.8, false);
  case 1:
    return std::make_unique<Box>(middle, Vector3<double>{3.0, 1.0, 2.0}, false);
  case 2:
    return std::make_unique<Frustum>(middle, Vector3<double>{0.0, 1.0, 0.0}, 0.5, 1.5, 2.0, false);
  case 3:
    return std::make_unique<Rectangle>(middle, Vector3<double>{0.0, 0.0, 1.0},
                                       Vector3<double>{1.0, 0.0, 0.0}, 3.0, 2.0, true);
  default: {
    std::vector<Triangle> triangles;
    Box(middle, {3.0, 1.0, 2.0}, false).tessellate({}, triangles);
    return std::make_unique<MeshShape>(TriangleMesh(triangles, true), MeshSide::BOTH);
  }
  }
}

/// Particles at rest, and a body that turns about a point beside it and goes on a way.
class BodyCandidatesTest : public testing::TestWithParam<int> {
 protected:
  BodyCandidatesTest() :
      p(random_packing(4000, random)), shape(make_shape(GetParam())), mask(p.size(), 1)
  {
    frame.moves = true;
    frame.origin = {0.1, 0.4, 0.0};
  }

  void place_at(double angle)
  {
    BodyState state;
    state.orientation =
        Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d(0.0, 0.6, 0.8)));
    state.position = {0.1 + 0.3 * angle, 0.4, 0.0};
    frame.set(state);
  }

  ParticleState view()
  {
    ParticleView arrays{};
    arrays.x = p.x[0].data();
    arrays.radius = p.radius.data();
    return {p.size(), arrays, p.type.data()};
  }

  int touching_and_not_listed(int &touching)
  {
    int missing = 0;
    for (int i = 0; i < p.size(); i++) {
      SurfaceContact contact;
      if (!shape->touches(frame.point_to_body(view().position(i)), p.radius[i], contact)) continue;
      touching++;
      missing += std::count(candidates.atoms().begin(), candidates.atoms().end(), i) == 0;
    }
    return missing;
  }

  RandomSource random{5};
  Packing p;
  std::unique_ptr<LargeBodyShape> shape;
  BodyFrame frame;
  BodyCandidates candidates;
  std::vector<int> mask;
};

TEST_P(BodyCandidatesTest, HoldWhileTheSurfaceHasGoneHalfASkin)
{
  place_at(0.0);
  candidates.list(*shape, frame, view(), mask.data(), 1, skin, 0.0, {}, 1);
  int lists = 1, touching = 0;
  constexpr int steps = 600;
  for (int step = 1; step <= steps; step++) {
    place_at(2.0 * pi * step / steps);
    if (candidates.are_stale(frame, skin)) {
      candidates.list(*shape, frame, view(), mask.data(), 1, skin, 0.0, {}, 1);
      lists++;
    }
    ASSERT_EQ(touching_and_not_listed(touching), 0) << step;
  }
  EXPECT_GT(touching, 1000);
  // reach of what may touch, with the largest particle
  const double reach = shape->extent_from(frame.origin) + 1.0 + 1.5 * skin;
  EXPECT_LT(reach, 5.0);
  EXPECT_LE(lists, 2.0 * pi * (reach + 0.3) / (0.5 * skin) + 1.0);
  const double farthest = 0.5 * Talus::cube_root(2.9 * p.size());
  EXPECT_LT(reach, 0.5 * farthest);
}

TEST_P(BodyCandidatesTest, NoTouchedPointIsFurtherThanTheExtent)
{
  int touching = 0;
  for (int n = 0; n < 50000; n++) {
    const Vector x = random.in_cube(3.5);
    const double radius = random.uniform(0.2, 1.0);
    const Vector3<double> center{x[0], x[1], x[2]}, point{0.1, 0.4, 0.0};
    SurfaceContact contact;
    if (!shape->touches(center, radius, contact)) continue;
    touching++;
    const Vector3<double> touched = center - (radius - contact.overlap) * contact.normal;
    EXPECT_LE(length(touched - point), shape->extent_from(point) * (1.0 + 1e-12));
  }
  EXPECT_GT(touching, 1000);
}

INSTANTIATE_TEST_SUITE_P(Shapes, BodyCandidatesTest, testing::Range(0, 5));

}    // namespace
