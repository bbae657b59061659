// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/wall/region_wall.h"

#include "system/host/time_formula.h"

#include "region.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace Talus;

RegionWall::RegionWall(Region &r, const Domain &domain, bool radii_vary) :
    region(&r), dynamic(r.dynamic_check()), bounded(has_distance(r) && !radii_vary),
    simple(bounded && !is_composite(r)), in_frame(dynamic && simple), span(r, domain)
{
  if (bounded) parts = RegionParts(r);
}

void RegionWall::place()
{
  if (!dynamic) return;
  region->prematch();
  region->set_velocity();
  parts.place();
  if (in_frame) motion = RegionMotion(*region);
}

void RegionWall::are_listed(const Eigen::AlignedBox3d &box)
{
  listed_poses = parts.poses();
  listed_box = box;
}

double RegionWall::displacement() const
{
  return dynamic && bounded ? parts.largest_displacement(listed_poses, listed_box) : 0.0;
}

int RegionWall::most_contacts() const
{
  return std::max(region->tmax, 2);    // several, for the engine
}

bool RegionWall::is_inside(const Vector3<double> &center) const
{
  const Vector3<double> at = span.image_of(center);
  const double x[3] = {at.x, at.y, at.z};
  return in_frame ? RegionInFrame(*region, motion).match(x) : region->match(x[0], x[1], x[2]);
}

TALUS_INLINE int RegionWall::contacts_at(const Vector3<double> &center, double radius) const
{
  const Vector3<double> at = span.image_of(center);
  const double x[3] = {at.x, at.y, at.z};
  return in_frame ? RegionInFrame(*region, motion).surface(x, radius)
                  : region->surface(x[0], x[1], x[2], radius);
}

bool RegionWall::have_normals(int count) const
{
  return std::all_of(region->contact, region->contact + count,
                     [](const Region::Contact &contact) { return contact.r > 0.0; });
}

/* A center that is on the surface has no normal: that of a place beside it on the inner side. */

int RegionWall::contacts_beside(const Vector3<double> &center, double radius) const
{
  const double aside = 1.0e-9 * radius;
  for (const double s : {aside, -aside}) {
    const Vector3<double> beside = center + s * Vector3<double>{1.0, 0.7, 0.4};
    if (!is_inside(beside)) continue;
    if (const int found = contacts_at(beside, radius); have_normals(found)) return found;
  }
  return 0;
}

/* As in LAMMPS, only particles on the inner side are looked at: others keep their histories. With a
   simple region what has contacts is there, unless its center is on the surface. */

int RegionWall::find(const Vector3<double> &center, double radius, SurfaceContact *found,
                     Point *points) const
{
  if (!simple && !is_inside(center)) return -1;
  int touched = contacts_at(center, radius);
  if (!have_normals(touched)) touched = contacts_beside(center, radius);
  const bool known = simple && touched > 0 && region->contact[0].r > 0.0;
  if (simple && !known && !is_inside(center)) return -1;
  int count = 0;
  for (int k = 0; k < touched; k++) {
    const Region::Contact &c = region->contact[k];
    if (!(c.r < radius)) continue;
    const double inverse = 1.0 / c.r;
    found[count] = {{c.delx * inverse, c.dely * inverse, c.delz * inverse}, radius - c.r, c.iwall};
    Point &point = points[count++];
    point.part = c.iwall;
    point.curvature = c.radius != 0.0 ? 1.0 / c.radius : 0.0;
    if (dynamic) point.velocity = velocity_at(center, k);
  }
  return count;
}

bool RegionWall::touches(const Vector3<double> &center, double radius,
                         SurfaceContact &contact) const
{
  SurfaceContact found[most_of_wall];
  Point points[most_of_wall];
  const bool any = find(center, radius, found, points) > 0;
  if (any) contact = found[0];
  return any;
}

unsigned RegionWall::may_touch(const EightSpheres &spheres, bool listed) const
{
  constexpr double rounding = 1.000001;
  if (!bounded) return 0xffU;
  const Vector3<Vec8> x{load8(spheres.center[0]), load8(spheres.center[1]),
                        load8(spheres.center[2])};
  const Vec8 reach = splat<Vec8>(rounding) * load8(spheres.radius);
  return span.is_empty() ? parts.near(x, reach) : near_in_images(x, reach, listed);
}

unsigned RegionWall::near_in_images(const Vector3<Vec8> &x, Vec8 reach, bool listed) const
{
  unsigned bits = 0;
  for (int k = 0; k < lanes; k++) {
    const auto look = [&](const Vector3<double> &image) {
      bits |= parts.near(in_all_lanes<Vec8>(image), reach) & (1U << k);
    };
    const Vector3<double> position{x.x[k], x.y[k], x.z[k]};
    if (listed)
      span.each_image(position, look);
    else
      look(span.image_of(position));
  }
  return bits;
}

/* LAMMPS computes the point of contact only if the region turns, but reads it if the region changes
   its shape. */

Vector3<double> RegionWall::velocity_at(const Vector3<double> &center, int k) const
{
  double x[3] = {center.x, center.y, center.z}, velocity[3];
  const int varies = region->varshape;
  if (!region->rotateflag) region->varshape = 0;
  region->velocity_contact(velocity, x, k);
  region->varshape = varies;
  const Region::Contact &contact = region->contact[k];
  if (!region->rotateflag && varies && contact.varflag) {
    double at[3] = {x[0] - contact.delx, x[1] - contact.dely, x[2] - contact.delz};
    region->velocity_contact_shape(velocity, at);
  }
  return {velocity[0], velocity[1], velocity[2]};
}
