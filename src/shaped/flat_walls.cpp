// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shaped/flat_walls.h"

#include "body/shape/box.h"
#include "body/shape/plane.h"

namespace Talus {

std::vector<FlatWall> flat_walls(const LargeBodyShape &body)
{
  if (const auto *plane = dynamic_cast<const Plane *>(&body)) {
    const Vector3<double> &n = plane->unit_normal();
    return {{n, dot(n, plane->reference_point()), plane->has_two_sides()}};
  }
  const auto *box = dynamic_cast<const Box *>(&body);
  if (!box || !box->is_inside()) return {};
  std::vector<FlatWall> walls;
  for (int axis = 0; axis < 3; axis++)
    for (const double sign : {1.0, -1.0}) {    // the wall at the low end first
      const Vector3<double> n{axis == 0 ? sign : 0.0, axis == 1 ? sign : 0.0,
                              axis == 2 ? sign : 0.0};
      walls.push_back({n, dot(n, box->reference_point()) - box->half_edge(axis), false});
    }
  return walls;
}

}    // namespace Talus
