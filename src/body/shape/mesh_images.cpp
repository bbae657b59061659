// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/mesh_images.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace Talus {
namespace {

std::array<int, 3> sorted(const Corners &corners)
{
  std::array<int, 3> all{corners.vertex[0], corners.vertex[1], corners.vertex[2]};
  std::sort(all.begin(), all.end());
  return all;
}

}    // namespace

std::array<bool, 3> PeriodicEdges::ended(const Eigen::AlignedBox3d &extent) const
{
  std::array<bool, 3> found{false, false, false};
  for (int d = 0; d < 3; d++) {
    const double allowed = usual_tolerance * box.sizes()[d];
    const double below = box.min()[d] - extent.min()[d], above = extent.max()[d] - box.max()[d];
    found[d] =
        periodic[d] && below <= allowed && above <= allowed && std::max(below, above) >= -allowed;
  }
  return found;
}

MeshImages images_behind_faces(MeshVertices &vertices, const std::vector<Corners> &triangles,
                               const Eigen::AlignedBox3d &box, const std::array<bool, 3> &edges)
{
  std::set<std::array<int, 3>> seen;
  for (const Corners &corners : triangles) seen.insert(sorted(corners));
  MeshImages images;
  const std::size_t num_own = vertices.all().size();
  for (int k = 0; k < 27; k++) {
    const int step[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
    bool is_image = k != 13;    // 13: no step
    for (int d = 0; d < 3; d++) is_image = is_image && (edges[d] || step[d] == 0);
    if (!is_image) continue;
    const Vector3<double> shift{step[0] * box.sizes()[0], step[1] * box.sizes()[1],
                                step[2] * box.sizes()[2]};
    for (std::size_t t = 0; t < triangles.size(); t++) {
      Corners image;
      for (int c = 0; c < 3; c++) {
        image.vertex[c] = vertices.at(vertices.all()[triangles[t].vertex[c]] + shift);
        if (vertices.all().size() > num_own + images.vertices.size())
          images.vertices.push_back({triangles[t].vertex[c], shift});
      }
      if (!seen.insert(sorted(image)).second) continue;
      images.triangles.push_back(image);
      images.own.push_back(static_cast<int>(t));
    }
  }
  return images;
}

}    // namespace Talus
