// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/near_triangles.h"

namespace Talus {

bool find_near_triangles(const MeshShape &mesh, const Vector3<double> &center, double reach,
                         std::vector<NearPart> &parts, std::vector<NearTriangle> &near)
{
  parts.clear();
  near.clear();
  if (!mesh.is_near(center, reach, parts)) return false;
  const TriangleMesh &surface = mesh.surface();
  const MeshDetail &detail = mesh.near_detail();
  const MeshSide acting = mesh.side();
  for (const NearPart &part : parts) {
    const int t = detail.number(part.part);
    const Vector3<double> n = detail.normal(part.part);
    const double offset = dot(surface.vertex(surface.corners(surface.plane_of(t)).vertex[0]), n);
    const bool in_front = dot(n, center) >= offset;
    if (acting == (in_front ? MeshSide::BACKS : MeshSide::NORMALS)) continue;
    const double side = in_front ? 1.0 : -1.0;
    near.push_back({t, part.part, side, side * n, side * offset});
  }
  return !near.empty();
}

}    // namespace Talus
