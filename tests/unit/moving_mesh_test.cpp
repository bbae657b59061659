// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Meshes whose vertices move: places that they may have, kinematics of the surface, forces on corners.

#include "body/contact/vertex_sums.h"
#include "body/shape/mesh_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace Talus {
namespace {

using Vector = Vector3<double>;
using Places = MovingVertices::Places;

/// n x n squares of edge 1, two triangles each, in the plane z = height.
std::vector<Triangle> sheet(int n, double height = 0.0)
{
  std::vector<Triangle> found;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      const auto at = [=](int di, int dj) {
        return Vector{static_cast<double>(i + di), static_cast<double>(j + dj), height};
      };
      found.push_back({{at(0, 0), at(1, 0), at(1, 1)}});
      found.push_back({{at(0, 0), at(1, 1), at(0, 1)}});
    }
  return found;
}

Places places_of(const TriangleMesh &mesh)
{
  Places all;
  for (int v = 0; v < mesh.num_vertices(); v++) all.push_back(mesh.vertex(v));
  return all;
}

int vertex_at(const TriangleMesh &mesh, const Vector &x)
{
  for (int v = 0; v < mesh.num_vertices(); v++)
    if (length(mesh.vertex(v) - x) < 1.0e-9) return v;
  return -1;
}

class Draw {
 public:
  double operator()() { return uniform(source); }
  Vector vector() { return {(*this)(), (*this)(), (*this)()}; }

 private:
  std::mt19937_64 source{7};
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
};

void expect_near(const Vector &a, const Vector &b, double bound)
{
  EXPECT_NEAR(a.x, b.x, bound);
  EXPECT_NEAR(a.y, b.y, bound);
  EXPECT_NEAR(a.z, b.z, bound);
}

/* ---- places ------------------------------------------------------------------------------------- */

TEST(MeshCheck, AcceptsWhatDeforms)
{
  TriangleMesh mesh(sheet(8));
  MeshCheck check(mesh);
  const Places flat = places_of(mesh);
  Places now = flat;
  for (int step = 1; step <= 40; step++) {    // rolled up into most of a tube, in many exchanges
    const double curvature = 0.7 * step / 40.0;
    Places then = flat;
    for (Vector &x : then)
      x = {std::sin(curvature * x.x) / curvature, x.y,
           (1.0 - std::cos(curvature * x.x)) / curvature};
    EXPECT_EQ(check.problem(now, then), "") << step;
    now = then;
  }
}

TEST(MeshCheck, NamesTrianglesThatCutEachOther)
{
  TriangleMesh mesh(sheet(8));
  MeshCheck check(mesh);
  const Places flat = places_of(mesh);
  Places now = flat;
  std::string problem;
  for (int step = 1; step <= 60 && problem.empty(); step++) {    // and then through itself, tilted
    const double curvature = 1.1 * step / 60.0;
    Places then = flat;
    for (Vector &x : then)
      x = {std::sin(curvature * x.x) / curvature, x.y + 0.05 * x.x,
           (1.0 - std::cos(curvature * x.x)) / curvature};
    problem = check.problem(now, then);
    now = then;
  }
  EXPECT_NE(problem.find("cut each other"), std::string::npos) << problem;
}

TEST(MeshCheck, FindsASheetThatComesThroughAnother)
{
  std::vector<Triangle> soup = sheet(6);
  const std::size_t first = soup.size();
  for (const Triangle &t : sheet(1, 3.0)) soup.push_back(t);
  TriangleMesh mesh(soup);
  MeshCheck check(mesh);
  const Places now = places_of(mesh);
  Places then = now;
  for (Vector &x : then)
    if (x.z > 1.0) x = {2.4 * x.x + 1.7, 2.4 * x.y + 1.6, 0.2 + 0.1 * x.x};
  EXPECT_EQ(check.problem(now, then), "");
  for (std::size_t v = 0; v < then.size(); v++)
    if (now[v].z > 1.0) then[v].z = 0.3 * (now[v].x - 0.4);
  const std::string problem = check.problem(now, then);
  EXPECT_NE(problem.find("cut each other"), std::string::npos) << problem;
  EXPECT_NE(problem.find("triangle " + std::to_string(first)), std::string::npos) << problem;
}

TEST(MeshCheck, NamesTrianglesThatTurnOver)
{
  TriangleMesh mesh(sheet(4));
  MeshCheck check(mesh);
  const Places now = places_of(mesh);
  Places then = now;
  const int middle = vertex_at(mesh, {2.0, 2.0, 0.0});
  then[middle] = then[middle] + Vector{0.9, 0.2, 0.0};
  EXPECT_EQ(check.problem(now, then), "");
  then[middle] = now[middle] + Vector{1.2, 0.1, 0.0};    // across an edge
  EXPECT_NE(check.problem(now, then).find("has turned over"), std::string::npos);
  then[middle] = now[middle] + Vector{1.0, 0.0, 0.0};
  EXPECT_NE(check.problem(now, then).find("has no area"), std::string::npos);
}

/* ---- the surface -------------------------------------------------------------------------------- */

class Turning : public ::testing::Test {
 protected:
  Turning() : mesh({Triangle{{{0.1, 0.2, 0.3}, {1.3, 0.1, -0.2}, {0.4, 0.9, 0.7}}}}), moving(mesh)
  {
  }

  /// One step to places that turn by an angle about an axis and go on, with the velocities of that motion.
  void turn(const Vector &omega, const Vector &velocity, double stretch = 1.0)
  {
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(length(omega), to_eigen(1.0 / length(omega) * omega)).toRotationMatrix();
    Places then, velocities;
    for (const Vector &x : places_of(mesh)) {
      then.push_back(rotated(rotation, stretch * x) + velocity);
      velocities.push_back(velocity + cross(omega, then.back()));
    }
    moving.guide(then, &velocities, 1, 1.0);
    moving.advance(true);
  }

  TriangleMesh mesh;
  MovingVertices moving;
};

TEST_F(Turning, MovesAsARigidBody)
{
  const Vector omega{0.2, -0.3, 0.5}, velocity{1.0, 2.0, -3.0};
  turn(omega, velocity);
  Draw draw;
  for (int n = 0; n < 20; n++) {
    const Vector x = draw.vector();
    const SurfaceMotion motion = moving.motion(moving.point_on(0, x));
    expect_near(motion.omega, omega, 1.0e-14);
    expect_near(motion.velocity_at(x), velocity + cross(omega, x), 1.0e-13);
  }
}

TEST_F(Turning, TurnsVectorsWithoutStretch)
{
  const Vector omega{0.2, -0.3, 0.5};
  const Vector along = mesh.triangle(0).corner[1] - mesh.triangle(0).corner[0];
  turn(omega, {0.1, 0.2, 0.3}, 1.5);
  const TriangleTurn turned = moving.turn(0);
  expect_near(turned(along), 1.0 / 1.5 * (mesh.triangle(0).corner[1] - mesh.triangle(0).corner[0]),
              1.0e-14);
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(length(omega), to_eigen(1.0 / length(omega) * omega)).toRotationMatrix();
  Draw draw;
  const Vector any = draw.vector();
  expect_near(turned(any), rotated(rotation, any), 1.0e-14);
}

TEST_F(Turning, StretchAlongOneAxisDoesNotTurn)
{
  const Vector n = mesh.normal(0), axis = cross(n, Vector{0.3, 0.1, 0.9});
  const Vector a = 1.0 / length(axis) * axis;
  Places then;
  for (const Vector &x : places_of(mesh)) then.push_back(x + 0.4 * dot(x, a) * a);
  moving.guide(then, nullptr, 1, 0.5);
  moving.advance(false);
  Draw draw;
  const Vector any = draw.vector();
  expect_near(moving.turn(0)(any), any, 1.0e-14);
}

TEST_F(Turning, ForcesOnCornersHaveForceTorqueAndPower)
{
  Draw draw;
  for (int n = 0; n < 50; n++) {
    Places then, velocities;
    for (int k = 0; k < 3; k++) {
      then.push_back(draw.vector());
      velocities.push_back(draw.vector());
    }
    moving.guide(then, &velocities, 0, 1.0);
    const SurfacePoint at = moving.point_on(0, draw.vector());
    const SurfaceMotion motion = moving.motion(at);
    const Vector force = draw.vector(), torque = draw.vector();
    Vector on[3], sum{}, turning{};
    MovingVertices::share_out(at, force, torque, on);
    double power = 0.0;
    for (int k = 0; k < 3; k++) {
      const int v = mesh.corners(0).vertex[k];
      sum = sum + on[k];
      turning = turning + cross(mesh.vertex(v) - motion.point, on[k]);
      power += dot(on[k], velocities[v]);
    }
    const double size = 1.0 / at.over_twice_area < 0.05 ? 1.0e-10 : 1.0e-12;
    expect_near(sum, force, size);
    expect_near(turning, torque, size);
    EXPECT_NEAR(power, dot(force, motion.velocity) + dot(torque, motion.omega), size);
  }
}

TEST(MovingVertices, GoOnAStraightWayAndThenRest)
{
  TriangleMesh mesh(sheet(1));
  MovingVertices moving(mesh);
  const Places start = places_of(mesh);
  Places end = start;
  for (Vector &x : end) x = x + Vector{0.3, -0.2, 0.1};
  moving.guide(end, nullptr, 3, 0.1);
  for (int step = 1; step <= 3; step++) {
    EXPECT_TRUE(moving.advance(false));
    expect_near(mesh.vertex(0), start[0] + step / 3.0 * (end[0] - start[0]), 1.0e-15);
    expect_near(moving.motion(moving.point_on(0, start[0])).velocity, {1.0, -2.0 / 3.0, 1.0 / 3.0},
                1.0e-14);
    EXPECT_GE(moving.way() * (1.0 + 1.0e-12), length(moving.gone(0)));
  }
  for (std::size_t v = 0; v < end.size(); v++)
    expect_near(mesh.vertex(static_cast<int>(v)), end[v], 0.0);
  moving.advance(false);
  EXPECT_EQ(length(moving.motion(moving.point_on(0, start[0])).velocity), 0.0);
  moving.advance(false);
  EXPECT_FALSE(moving.advance(false));
}

/* ---- contacts ----------------------------------------------------------------------------------- */

/// The same as a mesh that was read with the places that the other has come to.
TEST(MovingMesh, FindsWhatAMeshAtRestFinds)
{
  Draw draw;
  std::vector<Triangle> soup = sheet(6);
  MeshShape moved(TriangleMesh(soup), MeshSide::BOTH);
  moved.let_vertices_move();
  Places places = places_of(moved.surface());
  for (Vector &x : places) x = x + Vector{0.1 * draw(), 0.1 * draw(), 0.4 * draw()};
  ASSERT_EQ(moved.guide(places, nullptr, 1, 1.0, 10.0), "");
  moved.advance(false);
  moved.settle(false);
  std::vector<Triangle> now;
  for (int t = 0; t < moved.surface().size(); t++) now.push_back(moved.surface().triangle(t));
  const MeshShape still(TriangleMesh(now, false, 0.0), MeshSide::BOTH);
  int touching = 0;
  for (int n = 0; n < 5000; n++) {
    const Vector x{3.0 + 3.4 * draw(), 3.0 + 3.4 * draw(), 0.9 * draw()};
    std::vector<NearPart> parts[2];
    SurfaceContact found[2][LargeBodyShape::max_contacts];
    const double r = 0.5 + 0.3 * draw();
    int count[2], which = 0;
    for (const MeshShape *shape : {const_cast<const MeshShape *>(&moved), &still}) {
      shape->is_near(x, r, parts[which]);
      count[which] = shape->find_contacts(
          x, r, {parts[which].data(), parts[which].data() + parts[which].size()}, found[which]);
      which++;
    }
    ASSERT_EQ(count[0], count[1]);
    for (int k = 0; k < count[0]; k++) {
      EXPECT_NEAR(found[0][k].overlap, found[1][k].overlap, 1.0e-13);
      expect_near(found[0][k].normal, found[1][k].normal, 1.0e-12);
    }
    touching += count[0] > 0;
  }
  EXPECT_GT(touching, 1000);
}

/* ---- sums --------------------------------------------------------------------------------------- */

TEST(VertexSums, HaveTheSameBitsInAnyOrder)
{
  Draw draw;
  std::vector<Vector> numbers;
  for (int n = 0; n < 2000; n++) {
    const double size = std::pow(10.0, 30.0 * draw());
    numbers.push_back(size * draw.vector());
  }
  VertexSums one(3), other(3), third(3);
  for (const Vector &v : numbers) one.add(1, v);
  std::reverse(numbers.begin(), numbers.end());
  for (std::size_t n = 0; n < numbers.size(); n++) (n % 3 ? other : third).add(1, numbers[n]);
  const std::vector<std::int64_t> packed = third.packed();
  other.add_packed(packed.data(), packed.data() + packed.size());
  expect_near(one.sum(1), other.sum(1), 0.0);
  EXPECT_EQ(one.vertices(), std::vector<int>(1, 1));
}

TEST(VertexSums, LoseNothingBesideLargeNumbers)
{
  VertexSums sums(1);
  for (int n = 0; n < 1000; n++) sums.add(0, {0.1, 1.0e20, n % 2 ? -1.0e15 : 1.0e15});
  for (int n = 0; n < 1000; n++) sums.add(0, {0.0, -1.0e20, 0.0});
  sums.add(0, {0.0, 3.0, 0.25});
  expect_near(sums.sum(0), {100.0, 3.0, 0.25}, 1.0e-12);    // which is 2^-106 of the largest
  sums.add(0, {HUGE_VAL, 0.0, 0.0});
  EXPECT_TRUE(std::isnan(sums.sum(0).x));
}

}    // namespace
}    // namespace Talus
