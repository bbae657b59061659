// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/mesh_interior.h"

#include <utility>

namespace Talus {
namespace {

// Rays go along +x.
std::vector<Eigen::AlignedBox3d> shadows(const TriangleMesh &mesh)
{
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(mesh.num_own());
  for (int t = 0; t < mesh.num_own(); t++) {
    Eigen::AlignedBox3d box = bounds_of(mesh.triangle(t));
    box.min().x() = box.max().x() = 0.0;
    boxes.push_back(box);
  }
  return boxes;
}

}    // namespace

MeshInterior::MeshInterior(const TriangleMesh &triangle_mesh) :
    mesh(triangle_mesh), tree(shadows(triangle_mesh))
{
}

/* Is the point within the shadow of the triangle, by the parity of the edges that a line in the
   shadow meets, and does the plane lie ahead? Edges are taken from the lower vertex to the higher
   one, so that both triangles of an edge see it at the same place: the shadows of a closed mesh
   neither overlap at edges nor leave gaps (half-open rule, as for polygons). */

bool MeshInterior::ray_passes(int t, const Vector3<double> &p) const
{
  const int *v = mesh.corners(t).vertex;
  bool within = false;
  for (int k = 0; k < 3; k++) {
    int from = v[k], to = v[(k + 1) % 3];
    if (from > to) std::swap(from, to);
    const Vector3<double> a = mesh.vertex(from), b = mesh.vertex(to);
    if ((a.z > p.z) == (b.z > p.z)) continue;
    if (p.y < a.y + (p.z - a.z) / (b.z - a.z) * (b.y - a.y)) within = !within;
  }
  if (!within) return false;
  const Vector3<double> n = mesh.normal(t), a = mesh.vertex(v[0]);
  if (n.x == 0.0) return false;
  return a.x - (n.y * (p.y - a.y) + n.z * (p.z - a.z)) / n.x > p.x;
}

bool MeshInterior::contains(const Vector3<double> &point) const
{
  if (!mesh.bounds().contains(to_eigen(point))) return false;
  const double reach = 1.0e-9 * length(from_eigen(mesh.bounds().sizes()));
  bool inside = false;
  tree.visit_near({0.0, point.y, point.z}, reach, [&](int t) {
    if (ray_passes(t, point)) inside = !inside;
  });
  return inside;
}

}    // namespace Talus
