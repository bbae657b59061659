// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shaped/hollow_walls.h"

#include "body/shape/box.h"
#include "body/shape/frustum.h"
#include "body/shape/plane.h"

#include <cmath>

namespace Talus {

namespace {

/* The mantle, and caps unless it is endless. */

std::vector<HollowWall> walls_of(const Frustum &cylinder)
{
  const Vector3<double> n = cylinder.unit_axis(), at = cylinder.reference_point();
  std::vector<HollowWall> walls(1);
  walls[0].normal = n;
  walls[0].radius = cylinder.inner_radius();
  walls[0].point = at;
  if (std::isinf(cylinder.half_length())) return walls;
  for (const double sign : {1.0, -1.0})    // the cap at the low end first
    walls.push_back({sign * n, sign * dot(n, at) - cylinder.half_length()});
  return walls;
}

}    // namespace

std::vector<HollowWall> hollow_walls(const LargeBodyShape &body)
{
  if (const auto *plane = dynamic_cast<const Plane *>(&body)) {
    const Vector3<double> &n = plane->unit_normal();
    return {{n, dot(n, plane->reference_point()), plane->has_two_sides()}};
  }
  if (const auto *cylinder = dynamic_cast<const Frustum *>(&body))
    return cylinder->inner_radius() > 0.0 ? walls_of(*cylinder) : std::vector<HollowWall>{};
  const auto *box = dynamic_cast<const Box *>(&body);
  if (!box || !box->is_inside()) return {};
  std::vector<HollowWall> walls;
  for (int axis = 0; axis < 3; axis++)
    for (const double sign : {1.0, -1.0}) {    // the wall at the low end first
      const Vector3<double> n{axis == 0 ? sign : 0.0, axis == 1 ? sign : 0.0,
                              axis == 2 ? sign : 0.0};
      walls.push_back({n, dot(n, box->reference_point()) - box->half_edge(axis)});
    }
  return walls;
}

}    // namespace Talus
