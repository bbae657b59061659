// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/convex/convex_core.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace Talus {

void VectorArray::assign(const std::vector<Vector3<double>> &values)
{
  count = static_cast<int>(values.size());
  const std::size_t padded = (values.size() + 7) / 8 * 8;
  for (auto &c : component) c.resize(padded);
  for (std::size_t k = 0; k < padded; k++) {
    const Vector3<double> &v = values[std::min(k, values.size() - 1)];
    component[0][k] = v.x;
    component[1][k] = v.y;
    component[2][k] = v.z;
  }
}

ConvexCore::ConvexCore(const std::vector<Vector3<double>> &points,
                       const std::vector<std::vector<int>> &faces)
{
  first_corner.push_back(0);
  for (const auto &face : faces) {
    corner.insert(corner.end(), face.begin(), face.end());
    first_corner.push_back(static_cast<int>(corner.size()));
  }
  if (std::max(points.size(), corner.size() / 2) > most_parts)
    throw std::runtime_error("it has more than " + std::to_string(most_parts) +
                             " vertices or edges: use a coarser shape");
  find_edges(static_cast<int>(points.size()));
  move_vertices(points);
}

void ConvexCore::find_edges(int num_points)
{
  std::map<std::pair<int, int>, int> known;
  edge_of_corner.resize(corner.size());
  for (int f = 0; f + 1 < static_cast<int>(first_corner.size()); f++)
    for (int k = first_corner[f]; k < first_corner[f + 1]; k++) {
      const int from = corner[k],
                to = corner[k + 1 < first_corner[f + 1] ? k + 1 : first_corner[f]];
      const auto back = known.find({to, from});
      if (back == known.end()) {
        edge_of_corner[k] = known[{from, to}] = num_edges();
        edges.push_back({{from, to}, {f, f}});
      } else {
        edge_of_corner[k] = back->second;
        edges[back->second].face[1] = f;
      }
    }
  std::vector<std::vector<int>> of_vertex(num_points);
  for (int e = 0; e < num_edges(); e++)
    for (const int v : edges[e].vertex) of_vertex[v].push_back(e);
  first_spoke.push_back(0);
  for (const auto &list : of_vertex) {
    spoke.insert(spoke.end(), list.begin(), list.end());
    first_spoke.push_back(static_cast<int>(spoke.size()));
  }
}

void ConvexCore::move_vertices(const std::vector<Vector3<double>> &points)
{
  vertices.assign(points);
  outer = 0.0;
  for (const Vector3<double> &p : points) outer = std::max(outer, length(p));
  find_planes();
}

/* The normal of a polygon whose corners are in one plane but for rounding: that of its area. */

void ConvexCore::find_planes()
{
  const int count = static_cast<int>(first_corner.size()) - 1;
  std::vector<Vector3<double>> of_faces(count);
  offsets.resize((count + 7) / 8 * 8);
  for (int f = 0; f < count; f++) {
    const int *c = corners(f);
    const Vector3<double> base = vertices[c[0]];
    Vector3<double> area{0.0, 0.0, 0.0};
    for (int k = 1; k + 1 < num_corners(f); k++)
      area = area + cross(vertices[c[k]] - base, vertices[c[k + 1]] - base);
    of_faces[f] = (1.0 / length(area)) * area;
    double highest = dot(of_faces[f], base);
    for (int v = 0; v < num_vertices(); v++)
      highest = std::max(highest, dot(of_faces[f], vertices[v]));
    offsets[f] = highest;
  }
  for (std::size_t f = count; f < offsets.size(); f++) offsets[f] = offsets[count - 1];
  normals.assign(of_faces);
  inner = *std::min_element(offsets.begin(), offsets.end());
}

double ConvexCore::memory_usage() const
{
  const double integers =
      static_cast<double>(first_corner.size() + corner.size() + edge_of_corner.size() +
                          first_spoke.size() + spoke.size());
  return 8.0 * (3.0 * vertices.padded_size() + 4.0 * normals.padded_size()) + 4.0 * integers +
         static_cast<double>(edges.size() * sizeof(Edge));
}

}    // namespace Talus
