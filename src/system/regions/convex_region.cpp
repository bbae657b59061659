// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/regions/convex_region.h"

#include "base/rows.h"
#include "system/host/private_members.h"
#include "system/regions/region_surface.h"

#include "region_block.h"
#include "region_cone.h"
#include "region_cylinder.h"
#include "region_plane.h"
#include "region_prism.h"
#include "region_sphere.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

namespace Talus {
namespace {

/// The region as the class of its style, or nullptr.
template <class Style> const Style *as(const Region &region)
{
  return dynamic_cast<const Style *>(&region);
}

Vec8 smaller(Vec8 a, Vec8 b)
{
  return select(a < b, a, b);
}

}    // namespace

/* Contacts of these lie on the surface, and there is one if it is nearer than the cutoff. Region
   ellipsoid is none of them: near its inner surface it finds only some. */

bool ConvexRegion::includes(const Region &region)
{
  static const char *const styles[] = {"block", "cone", "cylinder", "plane", "prism", "sphere"};
  return std::any_of(std::begin(styles), std::end(styles),
                     [&](const char *style) { return std::strcmp(region.style, style) == 0; });
}

ConvexRegion::ConvexRegion(const Region &region)
{
  if (const auto *block = as<RegBlock>(region)) {
    add_planes(corners_of(*block));
  } else if (const auto *prism = as<RegPrism>(region)) {
    add_planes(corners_of(*prism));
  } else if (const auto *cylinder = as<RegCylinder>(region)) {
    add_round(shape_of(*cylinder));
  } else if (const auto *cone = as<RegCone>(region)) {
    add_round(shape_of(*cone));
  } else if (const auto *sphere = as<RegSphere>(region)) {
    const auto sphere_shape = shape_of(*sphere);
    rounds_at_rest.push_back(
        {row(sphere_shape.data()), {0.0, 0.0, 0.0}, sphere_shape[3], 0.0, 1.0});
  } else if (const auto *plane = as<RegPlane>(region)) {
    const auto [point, normal] = shape_of(*plane);
    add_plane(row(point.data()), row(normal.data()));
  }
  place(RegionPose());
}

void ConvexRegion::add_plane(const Vector3<double> &point, const Vector3<double> &normal)
{
  planes_at_rest.push_back({normal, dot(normal, point)});
}

void ConvexRegion::add_planes(const CornersOfRegion &corners)
{
  for (int face = 0; face < 6; face++)
    add_plane(row(corners.corner[face % 2]), row(corners.normal[face]));
}

/* Ends may be as far away as 1e20. */

void ConvexRegion::add_round(const RoundRegion &shape)
{
  double point[3] = {0.0, 0.0, 0.0}, axis[3] = {0.0, 0.0, 0.0};
  axis[shape.axis] = 1.0;
  point[shape.axis == 0 ? 1 : 0] = shape.center[0];
  point[shape.axis == 2 ? 1 : 2] = shape.center[1];
  const Vector3<double> along = row(axis);
  planes_at_rest.push_back({along, shape.end[0]});
  planes_at_rest.push_back({-along, -shape.end[1]});
  const double slope = (shape.radius[1] - shape.radius[0]) / (shape.end[1] - shape.end[0]);
  rounds_at_rest.push_back({row(point), along, shape.radius[0] - slope * shape.end[0], slope,
                            1.0 / std::sqrt(1.0 + slope * slope)});
}

void ConvexRegion::place(const RegionPose &pose)
{
  planes = planes_at_rest;
  for (Plane &plane : planes) {
    plane.normal = pose.turned(plane.normal);
    plane.offset += dot(plane.normal, pose.displacement());
  }
  rounds = rounds_at_rest;
  for (Round &round : rounds) {
    round.point = pose.turned(round.point) + pose.displacement();
    round.axis = pose.turned(round.axis);
  }
}

Vec8 ConvexRegion::depth(const Vector3<Vec8> &x) const
{
  Vec8 least = splat<Vec8>(HUGE_VAL);
  for (const Plane &plane : planes)
    least = smaller(least, dot(in_all_lanes<Vec8>(plane.normal), x) - splat<Vec8>(plane.offset));
  for (const Round &round : rounds) {
    const Vector3<Vec8> axis = in_all_lanes<Vec8>(round.axis),
                        away = x - in_all_lanes<Vec8>(round.point);
    const Vec8 s = dot(axis, away);
    const Vector3<Vec8> across = away - s * axis;
    const Vec8 inwards =
        splat<Vec8>(round.radius) + splat<Vec8>(round.slope) * s - square_root(dot(across, across));
    least = smaller(least, splat<Vec8>(round.cosine) * inwards);
  }
  return least;
}

/* What is not a number is near. */

unsigned ConvexRegion::near(const Vector3<Vec8> &x, Vec8 reach) const
{
  return ~less_bits(reach, magnitude(depth(x))) & 0xffU;
}

}    // namespace Talus
