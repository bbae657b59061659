// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Polygons are cut side by side (I. E. Sutherland, G. W. Hodgman, Commun. ACM 17, 32, 1974).

#include "shape/convex/face_projection.h"

#include <algorithm>

namespace Talus {

ProjectionFrame::ProjectionFrame(const Vector3<double> &n) : normal(n)
{
  const double ax = std::fabs(n.x), ay = std::fabs(n.y), az = std::fabs(n.z);
  const Vector3<double> other = ax <= ay && ax <= az ? Vector3<double>{1.0, 0.0, 0.0}
                                : ay <= az           ? Vector3<double>{0.0, 1.0, 0.0}
                                                     : Vector3<double>{0.0, 0.0, 1.0};
  const Vector3<double> across = cross(other, n);
  x = (1.0 / length(across)) * across;
  y = cross(n, x);
}

/* Those of a face that looks against the normal are taken backward. */

void project(const ConvexCore &core, int f, const Pose &pose, const ProjectionFrame &frame,
             ProjectedFace &face)
{
  const Vector3<double> n = pose.direction_in_space(core.normal(f));
  const double offset = core.offset(f) + dot(n, pose.position), along = dot(n, frame.normal);
  const int count = core.num_corners(f);
  face.corner.clear();
  face.vertex.clear();
  face.edge.clear();
  for (int k = 0; k < count; k++) {
    const int at = along < 0.0 ? count - 1 - k : k;
    const int v = core.corners(f)[at];
    face.vertex.push_back(v);
    face.corner.push_back(frame.projected(pose.point_in_space(core.vertex(v))));
    // backward, the edge to the corner before
    face.edge.push_back(core.edges_of_face(f)[along < 0.0 ? (at + count - 1) % count : at]);
  }
  face.at_origin = offset / along;
  face.slope = {-dot(n, frame.x) / along, -dot(n, frame.y) / along};
}

void cut(std::vector<PolygonCorner> &polygon, std::vector<PolygonCorner> &buffer, Flat from,
         Flat to, PolygonCorner::Side side, int edge)
{
  const Flat along = to - from;
  if (std::all_of(polygon.begin(), polygon.end(),
                  [&](const PolygonCorner &c) { return cross(along, c.place - from) >= 0.0; }))
    return;
  buffer.clear();
  const std::size_t count = polygon.size();
  for (std::size_t k = 0; k < count; k++) {
    const PolygonCorner &here = polygon[k], &next = polygon[k + 1 < count ? k + 1 : 0];
    const double left = cross(along, here.place - from), beyond = cross(along, next.place - from);
    if (left >= 0.0) buffer.push_back(here);
    if ((left >= 0.0) == (beyond >= 0.0)) continue;
    const Flat place = here.place + (left / (left - beyond)) * (next.place - here.place);
    if (left >= 0.0)
      buffer.push_back({side, place, edge});    // from here on along the line
    else
      buffer.push_back({here.side, place, here.edge});
  }
  polygon.swap(buffer);
}

void common_polygon(const ProjectedFace &of_a, const ProjectedFace &of_b,
                    std::vector<PolygonCorner> &polygon, std::vector<PolygonCorner> &buffer)
{
  polygon.clear();
  for (int k = 0; k < of_a.num_corners(); k++)
    polygon.push_back({PolygonCorner::OF_A, of_a.corner[k], of_a.edge[k]});
  for (int k = 0; k < of_b.num_corners() && !polygon.empty(); k++)
    cut(polygon, buffer, of_b.corner[k], of_b.next_corner(k), PolygonCorner::OF_B, of_b.edge[k]);
}

}    // namespace Talus
