// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/convex/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>

namespace Talus {
namespace {

using Points = std::vector<Vector3<double>>;
using Corners3 = std::array<int, 3>;
using Side = std::pair<int, int>;

// Of the extent: what is nearer to a plane is in it. Rounding of coordinates is far below, and a
// hull whose points are that much inside is the same body.
constexpr double thickness = 1.0e-6;

struct Plane {
  Vector3<double> normal;
  double offset, area;
  double height(const Vector3<double> &x) const { return dot(normal, x) - offset; }
};

Plane plane_through(const Points &x, const Corners3 &t)
{
  const Vector3<double> twice = cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
  const double size = length(twice);
  const Vector3<double> n = size > 0.0 ? (1.0 / size) * twice : Vector3<double>{0.0, 0.0, 0.0};
  return {n, dot(n, x[t[0]]), 0.5 * size};
}

template <class Measure> int farthest(const Points &x, Measure measure)
{
  int best = 0;
  for (int k = 1; k < static_cast<int>(x.size()); k++)
    if (measure(x[k]) > measure(x[best])) best = k;
  return best;
}

/// The surface that grows.
class Surface {
 public:
  /// What is less than `rounding` (over the extent) above a triangle does not see it.
  Surface(const Points &points, double rounding) : x(points)
  {
    begin();
    for (int k = 0; k < static_cast<int>(x.size()); k++)
      if (std::find(first, first + 4, k) == first + 4) add(k, rounding * extent);
  }
  const std::vector<Corners3> &all() const { return triangles; }
  bool holds_all_points() const;

 private:
  void begin();
  void add(int point, double limit);
  void append(const Corners3 &t)
  {
    triangles.push_back(t);
    planes.push_back(plane_through(x, t));
  }

  const Points &x;
  int first[4];
  double extent;
  std::vector<Corners3> triangles;
  std::vector<Plane> planes;
};

void Surface::begin()
{
  const auto distance = [this](int from) {
    return [this, from](const Vector3<double> &p) { return length(p - x[from]); };
  };
  first[0] = farthest(x, distance(0));
  first[1] = farthest(x, distance(first[0]));
  const Vector3<double> line = x[first[1]] - x[first[0]];
  extent = length(line);
  first[2] =
      farthest(x, [&](const Vector3<double> &p) { return length(cross(p - x[first[0]], line)); });
  const Plane base = plane_through(x, {first[0], first[1], first[2]});
  first[3] = farthest(x, [&](const Vector3<double> &p) { return std::fabs(base.height(p)); });
  const double height = base.height(x[first[3]]);
  if (!(length(cross(x[first[2]] - x[first[0]], line)) > thickness * extent * extent))
    throw std::runtime_error("all its vertices are on one line: give a body that has a volume");
  if (!(std::fabs(height) > thickness * extent))
    throw std::runtime_error("all its vertices are in one plane: give a body that has a volume");
  if (height > 0.0) std::swap(first[1], first[2]);
  append({first[0], first[1], first[2]});
  append({first[0], first[2], first[3]});
  append({first[2], first[1], first[3]});
  append({first[1], first[0], first[3]});
}

/* What sees the point goes; its border has to be one loop. Where triangles that are too thin for a
   direction spoil that, the point is left out, which is found out at the end. */

void Surface::add(int point, double limit)
{
  std::vector<std::size_t> seen;
  std::set<Side> sides;
  for (std::size_t t = 0; t < triangles.size(); t++) {
    if (!(planes[t].height(x[point]) > limit)) continue;
    seen.push_back(t);
    for (int k = 0; k < 3; k++) sides.insert({triangles[t][k], triangles[t][(k + 1) % 3]});
  }
  std::map<int, int> border;
  for (const Side &side : sides)
    if (!sides.count({side.second, side.first}) && !border.insert(side).second) return;
  if (border.empty()) return;
  std::size_t loop = 1;
  for (int v = border.begin()->second; v != border.begin()->first; v = border.at(v)) loop++;
  if (loop != border.size()) return;
  for (auto t = seen.rbegin(); t != seen.rend(); ++t) {
    triangles[*t] = triangles.back();
    planes[*t] = planes.back();
    triangles.pop_back();
    planes.pop_back();
  }
  for (const auto &[from, to] : border) append({from, to, point});
}

bool Surface::holds_all_points() const
{
  for (const Plane &plane : planes)
    for (const Vector3<double> &p : x)
      if (plane.height(p) > 0.1 * thickness * extent) return false;
  return true;
}

/* ---- faces ----------------------------------------------------------------------------------- */

double width_along(const Points &x, const Plane &plane)
{
  double deepest = 0.0;
  for (const Vector3<double> &p : x) deepest = std::max(deepest, -plane.height(p));
  return deepest;
}

/* The face of each triangle: from the largest one over all neighbors that are in its plane. */

std::vector<int> faces_of(const Points &x, const std::vector<Corners3> &triangles, double tolerance)
{
  std::map<Side, int> owner;
  std::vector<Plane> planes;
  for (int t = 0; t < static_cast<int>(triangles.size()); t++) {
    planes.push_back(plane_through(x, triangles[t]));
    for (int k = 0; k < 3; k++) owner[{triangles[t][k], triangles[t][(k + 1) % 3]}] = t;
  }
  std::vector<int> order(triangles.size()), face(triangles.size(), -1), to_do;
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int s, int t) {
    return planes[s].area > planes[t].area || (planes[s].area == planes[t].area && s < t);
  });
  for (const int seed : order) {
    if (face[seed] >= 0) continue;
    face[seed] = seed;
    to_do.assign(1, seed);
    while (!to_do.empty()) {
      const int t = to_do.back();
      to_do.pop_back();
      for (int k = 0; k < 3; k++) {
        const int other = owner.at({triangles[t][(k + 1) % 3], triangles[t][k]});
        const auto in_plane = [&](int v) { return planes[seed].height(x[v]) > -tolerance; };
        if (face[other] >= 0 ||
            !std::all_of(triangles[other].begin(), triangles[other].end(), in_plane))
          continue;
        face[other] = seed;
        to_do.push_back(other);
      }
    }
  }
  return face;
}

/* The loops between faces; a point where only two faces meet is on the line between others. */

std::vector<std::vector<int>> loops(const std::vector<Corners3> &triangles,
                                    const std::vector<int> &face)
{
  std::map<Side, int> owner;
  for (std::size_t t = 0; t < triangles.size(); t++)
    for (int k = 0; k < 3; k++) owner[{triangles[t][k], triangles[t][(k + 1) % 3]}] = face[t];
  std::map<int, std::map<int, int>> next;    // of each face
  std::map<int, int> degree;
  for (const auto &[side, f] : owner)
    if (owner.at({side.second, side.first}) != f) {
      next[f][side.first] = side.second;
      degree[side.first]++;
    }
  std::vector<std::vector<int>> all;
  for (const auto &[f, step] : next) {
    std::vector<int> corners;
    int v = step.begin()->first;
    for (std::size_t k = 0; k < step.size(); k++, v = step.at(v))
      if (degree[v] > 2) corners.push_back(v);
    all.push_back(corners);
  }
  return all;
}

}    // namespace

ConvexHull convex_hull(const Points &points, double flatness)
{
  constexpr const char *thin = "its hull has faces that are too thin: give fewer vertices, or with "
                               "more digits";
  ConvexHull hull;
  for (double rounding = 1.0e-13; hull.triangles.empty(); rounding *= 30.0) {
    const Surface surface(points, rounding);
    if (surface.holds_all_points()) hull.triangles = surface.all();
    if (rounding > thickness) throw std::runtime_error(thin);
  }
  hull.least_width = std::numeric_limits<double>::infinity();
  for (const Corners3 &t : hull.triangles) {
    const Plane plane = plane_through(points, t);
    // slivers have no direction
    if (plane.area > 0.0) hull.least_width = std::min(hull.least_width, width_along(points, plane));
  }
  for (double part = flatness;; part *= 0.01) {
    hull.faces = loops(hull.triangles, faces_of(points, hull.triangles, part * hull.least_width));
    const bool good = std::all_of(hull.faces.begin(), hull.faces.end(),
                                  [](const std::vector<int> &f) { return f.size() > 2; });
    if (good && hull.faces.size() > 3) return hull;
    if (part < 1.0e-14) throw std::runtime_error(thin);
  }
}

}    // namespace Talus
