// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/convex/convex_shape.h"

#include "base/cube_root.h"

#include "body/shape/stl_file.h"
#include "body/shape/triangle_mesh.h"
#include "shape/convex/convex_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace Talus {
namespace {

using Points = std::vector<Vector3<double>>;

[[noreturn]] void fail(const std::string &what)
{
  throw std::runtime_error(what);
}

std::string text_of(double value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

bool is_finite(const Vector3<double> &x)
{
  return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
}

void check_radius(double radius)
{
  if (!(radius >= 0.0) || !std::isfinite(radius))
    fail("the rounding radius is " + text_of(radius) + ": it must be 0 or positive");
}

void check_vertices(const Points &points)
{
  if (points.size() < 4)
    fail("it has " + std::to_string(points.size()) + " vertices: a body has 4 or more");
  std::map<std::array<double, 3>, std::size_t> known;
  for (std::size_t k = 0; k < points.size(); k++) {
    const Vector3<double> &p = points[k];
    const std::string name = "vertex " + std::to_string(k + 1);
    if (!is_finite(p)) fail(name + " has a coordinate that is not a finite number");
    const auto [first, is_new] = known.try_emplace({p.x + 0.0, p.y + 0.0, p.z + 0.0}, k);
    if (!is_new)
      fail(name + " is the same point as vertex " + std::to_string(first->second + 1) +
           ": give every vertex once");
  }
}

/* The core whose vertices are corners of the hull. */

ConvexCore core_of(const ConvexHull &hull, const Points &points)
{
  std::vector<int> number(points.size(), -1);
  for (const auto &face : hull.faces)
    for (const int v : face) number[v] = 0;
  Points used;
  for (std::size_t v = 0; v < points.size(); v++) {
    if (number[v] < 0) continue;
    number[v] = static_cast<int>(used.size());
    used.push_back(points[v]);
  }
  std::vector<std::vector<int>> faces = hull.faces;
  for (auto &face : faces)
    for (int &v : face) v = number[v];
  return ConvexCore(used, faces);
}

double depth_inside(const ConvexCore &core, const Vector3<double> &p)
{
  double depth = core.offset(0) - dot(core.normal(0), p);
  for (int f = 1; f < core.num_faces(); f++)
    depth = std::min(depth, core.offset(f) - dot(core.normal(f), p));
  return depth;
}

Pose principal_frame(const MassProperties &body, double extent)
{
  Pose frame;
  frame.position = from_eigen(body.center);
  if (length(frame.position) < 1.0e-13 * extent) frame.position = {0.0, 0.0, 0.0};
  const Eigen::Matrix3d axes = principal_axes(body.inertia()).axes;
  if ((axes - Eigen::Matrix3d::Identity()).norm() > 1.0e-9) frame.rotation = axes;
  return frame;
}

}    // namespace

ConvexShape::ConvexShape(const ConvexCore &given, double radius) :
    polyhedron_(given), rounding(radius)
{
  const MassProperties as_given = mass_properties(given, radius);
  if (!(as_given.volume > 0.0) || !std::isfinite(as_given.volume))
    fail("its volume is " + text_of(as_given.volume) + ": give lengths that are not so extreme");
  offset = principal_frame(as_given, given.outer_radius());
  Points moved;
  for (int v = 0; v < given.num_vertices(); v++)
    moved.push_back(offset.point_in_body(given.vertex(v)));
  polyhedron_.move_vertices(moved);
  const MassProperties body = mass_properties(polyhedron_, radius);
  volume_ = body.volume;
  moments = body.inertia().diagonal();
  sphere_radius = cube_root(0.75 * volume_ / 3.14159265358979323846);
}

ConvexShape ConvexShape::box(const Vector3<double> &edges, double radius)
{
  check_radius(radius);
  for (const double edge : {edges.x, edges.y, edges.z})
    if (!(edge > 0.0) || !std::isfinite(edge))
      fail("an edge of the box has the length " + text_of(edge) + ": it must be positive");
  Points corners;
  for (int k = 0; k < 8; k++)
    corners.push_back({(k & 1 ? 0.5 : -0.5) * edges.x, (k & 2 ? 0.5 : -0.5) * edges.y,
                       (k & 4 ? 0.5 : -0.5) * edges.z});
  return ConvexShape(
      ConvexCore(
          corners,
          {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}),
      radius);
}

ConvexShape ConvexShape::polyhedron(const Points &vertices, double radius)
{
  check_radius(radius);
  check_vertices(vertices);
  const ConvexHull hull = convex_hull(vertices, flatness);
  const ConvexCore core = core_of(hull, vertices);
  for (std::size_t k = 0; k < vertices.size(); k++)
    if (depth_inside(core, vertices[k]) > flatness * hull.least_width)
      fail("vertex " + std::to_string(k + 1) +
           " is inside the hull of the others, so that they are not those of a convex body: leave "
           "it out, or make a body that is not convex of several");
  return ConvexShape(core, radius);
}

ConvexShape ConvexShape::stl(const std::string &content, double scale, double radius)
{
  constexpr double volume_tolerance = 1.0e-4;    // coordinates of binary files are single precision
  check_radius(radius);
  if (!(scale > 0.0) || !std::isfinite(scale))
    fail("the scale is " + text_of(scale) + ": it must be positive");
  const TriangleMesh mesh(parse_stl(content).triangles, true);
  const MeshReport &report = mesh.report();
  if (report.open_edges)
    fail("its surface is open at " + std::to_string(report.open_edges) +
         " edges: close it, since only a closed surface has a volume");
  if (!report.closed())
    fail("its surface is none of a body: " +
         std::to_string(report.nonmanifold_edges + report.inconsistent_edges) +
         " edges belong to more than two triangles, or to two that face opposite sides");
  Points vertices;
  for (int v = 0; v < mesh.num_vertices(); v++) vertices.push_back(scale * mesh.vertex(v));
  check_vertices(vertices);
  const ConvexHull hull = convex_hull(vertices, flatness);
  const ConvexCore core = core_of(hull, vertices);
  const double volume = std::fabs(mesh.volume()) * scale * scale * scale;
  if (std::fabs(mass_properties(core, 0.0).volume - volume) > volume_tolerance * volume)
    fail("it is not convex: its volume is " + text_of(volume) + ", and that of its hull " +
         text_of(mass_properties(core, 0.0).volume) + ": divide it into convex bodies");
  return ConvexShape(core, radius);
}

/* ---- where it is held ------------------------------------------------------------------------ */

namespace {

double turn_of_corner(const ConvexCore &core, int face, int k)
{
  const int n = core.num_corners(face);
  const int *corner = core.corners(face);
  const Vector3<double> here = core.vertex(corner[k]);
  const Vector3<double> in = here - core.vertex(corner[(k + n - 1) % n]);
  const Vector3<double> out = core.vertex(corner[(k + 1) % n]) - here;
  constexpr double right_angle = 1.57079632679489661923;
  return std::acos(std::clamp(dot(in, out) / (length(in) * length(out)), -1.0, 1.0)) / right_angle;
}

}    // namespace

std::vector<HeldFace> ConvexShape::held_faces() const
{
  std::vector<HeldFace> faces;
  for (int f = 0; f < polyhedron_.num_faces(); f++) {
    HeldFace face{polyhedron_.normal(f), {}};
    for (int k = 0; k < polyhedron_.num_corners(f); k++)
      face.points.push_back({polyhedron_.vertex(polyhedron_.corners(f)[k]) + rounding * face.normal,
                             rounding > 0.0 ? 1.0 : turn_of_corner(polyhedron_, f, k)});
    faces.push_back(std::move(face));
  }
  return faces;
}

/* ---- surface --------------------------------------------------------------------------------- */

std::vector<Triangle> ConvexShape::core_surface() const
{
  std::vector<Triangle> triangles;
  for (int f = 0; f < polyhedron_.num_faces(); f++) {
    const int *c = polyhedron_.corners(f);
    for (int k = 1; k + 1 < polyhedron_.num_corners(f); k++)
      triangles.push_back(
          {{polyhedron_.vertex(c[0]), polyhedron_.vertex(c[k]), polyhedron_.vertex(c[k + 1])}});
  }
  return triangles;
}

namespace {

/* Unit vectors from n0 to n1 along the arc. */

Points arc(const Vector3<double> &n0, const Vector3<double> &n1, int pieces)
{
  const double angle = std::atan2(length(cross(n0, n1)), dot(n0, n1));
  const int count = std::max(1, static_cast<int>(std::ceil(angle / 1.5707963 * pieces - 1.0e-6)));
  Points n;
  for (int k = 0; k <= count; k++) {
    const double t = angle * k / count;
    n.push_back((std::sin(angle - t) / std::sin(angle)) * n0 +
                (std::sin(t) / std::sin(angle)) * n1);
  }
  return n;
}

/// The middle of the normals that belong to a vertex.
Vector3<double> middle_normal(const ConvexCore &core, int v)
{
  Vector3<double> sum{0.0, 0.0, 0.0};
  for (int k = 0; k < core.num_edges_of_vertex(v); k++) {
    const ConvexCore::Edge &edge = core.edge(core.edges_of_vertex(v)[k]);
    sum = sum + core.normal(edge.face[0]) + core.normal(edge.face[1]);
  }
  return (1.0 / length(sum)) * sum;
}

}    // namespace

std::vector<Triangle> ConvexShape::surface(int pieces) const
{
  std::vector<Triangle> triangles;
  if (rounding == 0.0) return core_surface();
  const double r = rounding;
  for (int f = 0; f < polyhedron_.num_faces(); f++) {
    const int *c = polyhedron_.corners(f);
    const Vector3<double> up = r * polyhedron_.normal(f);
    for (int k = 1; k + 1 < polyhedron_.num_corners(f); k++)
      triangles.push_back({{polyhedron_.vertex(c[0]) + up, polyhedron_.vertex(c[k]) + up,
                            polyhedron_.vertex(c[k + 1]) + up}});
  }
  for (int e = 0; e < polyhedron_.num_edges(); e++) {
    const ConvexCore::Edge &edge = polyhedron_.edge(e);
    const Vector3<double> end[2] = {polyhedron_.vertex(edge.vertex[0]),
                                    polyhedron_.vertex(edge.vertex[1])};
    const Vector3<double> tip[2] = {end[0] + r * middle_normal(polyhedron_, edge.vertex[0]),
                                    end[1] + r * middle_normal(polyhedron_, edge.vertex[1])};
    const Points n =
        arc(polyhedron_.normal(edge.face[0]), polyhedron_.normal(edge.face[1]), pieces);
    for (std::size_t k = 0; k + 1 < n.size(); k++) {
      const Vector3<double> a = end[0] + r * n[k], b = end[0] + r * n[k + 1],
                            c = end[1] + r * n[k + 1], d = end[1] + r * n[k];
      triangles.push_back({{a, b, c}});
      triangles.push_back({{a, c, d}});
      triangles.push_back({{tip[0], b, a}});
      triangles.push_back({{tip[1], d, c}});
    }
  }
  return triangles;
}

}    // namespace Talus
