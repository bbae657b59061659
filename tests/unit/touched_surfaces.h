// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Smooth shapes, and surfaces that they touch.

#ifndef TALUS_TESTS_TOUCHED_SURFACES_H
#define TALUS_TESTS_TOUCHED_SURFACES_H

#include "body/shape/ball.h"
#include "body/shape/frustum.h"
#include "body/shape/mesh_shape.h"
#include "body/shape/surface_visitor.h"
#include "convex_bodies.h"
#include "shape/contact/shape_list.h"
#include "shape/mesh_features.h"
#include "shape/superellipsoid/superellipsoid.h"
#include "shape/surface.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Talus {

inline constexpr double pi = 3.14159265358979323846;

inline const std::vector<Superellipsoid> &particles()
{
  static const std::vector<Superellipsoid> shapes = {
      {{0.5, 0.35, 0.2}, 2.0, 2.0},    {{0.5, 0.5, 0.5}, 2.0, 2.0},
      {{0.5, 0.025, 0.025}, 2.0, 2.0}, {{0.5, 0.5, 0.05}, 2.0, 2.0},
      {{0.4, 0.3, 0.35}, 4.0, 4.0},    {{0.3, 0.3, 0.4}, 6.0, 2.0},
      {{0.35, 0.3, 0.25}, 20.0, 20.0}, {{0.4, 0.4, 0.04}, 20.0, 2.0},
      {{0.4, 0.3, 0.3}, 2.5, 8.0}};
  return shapes;
}

/// A surface that shapes touch, and what keeps it alive.
struct Touched {
  std::string name;
  std::shared_ptr<const Geometry> geometry;
  Pose pose{};
  std::shared_ptr<const LargeBodyShape> body{};

  bool touch(const Superellipsoid &a, const Pose &at, ShapeContacts &contacts) const
  {
    return collisions_of_shapes().find(a, *geometry)(a, at, *geometry, pose, {}, contacts);
  }
};

inline Touched box(const Vector3<double> &center, const Vector3<double> &edges)
{
  const auto shape = std::make_shared<ConvexShape>(ConvexShape::box(edges, 0.0));
  Pose pose = shape->given_frame();
  pose.position = pose.position + center;
  return {"box", shape, pose};
}
inline Touched frustum(double low, double high, double middle, double size)
{
  const auto body = std::make_shared<Frustum>(Vector3<double>{0, 0, middle},
                                              Vector3<double>{0, 0, 1}, low, high, size, false);
  RoundSurface round;
  round.body = body.get();
  return {low == high ? "cylinder" : "cone", std::make_shared<RoundSurface>(round), {}, body};
}
/// The inside of a body that has one.
inline VesselSurface inside_of(const LargeBodyShape &body)
{
  struct Walls : SurfaceVisitor {
    VesselSurface surface;
    void flat(const Vector3<double> &, const Vector3<double> &, bool, int) override {}
    void box(const Vector3<double> &, const Vector3<double> &) override {}
    void ball(const Vector3<double> &, double) override {}
    void frustum(const Frustum &) override {}
    void vessel(const LargeBodyShape &of, const std::vector<InwardWall> &walls) override
    {
      surface.body = &of;
      surface.walls = walls;
    }
    void mesh(std::shared_ptr<const MeshShape>) override {}
  } seen;
  body.visit_surfaces(seen);
  return seen.surface;
}
inline Touched vessel(const std::string &name, std::shared_ptr<const LargeBodyShape> body)
{
  const VesselSurface inside = inside_of(*body);
  return {name, std::make_shared<VesselSurface>(inside), {}, body};
}
inline Touched mesh(const std::string &name, const std::vector<Triangle> &triangles,
                    MeshSide side = MeshSide::NORMALS)
{
  MeshSurface surface;
  const auto shape = std::make_shared<MeshShape>(TriangleMesh(triangles, false), side);
  surface.features = std::make_shared<const MeshFeatures>(shape->surface());
  surface.shape = shape;
  return {name, std::make_shared<MeshSurface>(surface), {}, shape};
}

inline std::vector<Triangle> two_triangles(double half)
{
  const Vector3<double> a{-half, -half, 0}, b{half, -half, 0}, c{half, half, 0}, d{-half, half, 0};
  return {{{a, b, c}}, {{a, c, d}}};
}
/// Strips of very different widths, cut by diagonals.
inline std::vector<Triangle> slivers()
{
  std::vector<Triangle> triangles;
  const std::vector<double> x = {-4.0, -1.0, -0.999, -0.1, 0.0, 1.0e-4,
                                 0.01, 0.5,  0.5001, 1.7,  4.0},
                            y = {-4.0, -0.3, -0.2999, 0.25, 0.2501, 1.1, 4.0};
  for (std::size_t i = 1; i < x.size(); i++)
    for (std::size_t j = 1; j < y.size(); j++) {
      const Vector3<double> a{x[i - 1], y[j - 1], 0}, b{x[i], y[j - 1], 0}, c{x[i], y[j], 0},
          d{x[i - 1], y[j], 0};
      triangles.push_back({{a, b, c}});
      triangles.push_back({{a, c, d}});
    }
  return triangles;
}
/// The inside of a drum along z, of facets.
inline std::vector<Triangle> drum(int facets, double radius, double half)
{
  std::vector<Triangle> triangles;
  const auto at = [&](int k, double z) {
    return Vector3<double>{radius * std::cos(2.0 * pi * k / facets),
                           radius * std::sin(2.0 * pi * k / facets), z};
  };
  for (int k = 0; k < facets; k++) {
    triangles.push_back({{at(k, -half), at(k, half), at(k + 1, half)}});
    triangles.push_back({{at(k, -half), at(k + 1, half), at(k + 1, -half)}});
  }
  return triangles;
}

}    // namespace Talus

#endif
