// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/regions/region_shape.h"

#include "fmt/format.h"
#include "region.h"
#include "system/host/time_formula.h"

#include <algorithm>

using LAMMPS_NS::Domain;
using LAMMPS_NS::Region;

namespace Talus {

RegionShape::RegionShape(MovedBy what, Region &of, const Domain &domain) :
    by_itself(what == MovedBy::ITSELF)
{
  take(of, domain);
}

/* Some versions of LAMMPS move the extent with the region, others have none of one that moves. */

void RegionShape::take(Region &now, const Domain &domain)
{
  region = &now;
  id = region->id;
  span = PeriodicSpan(*region, domain);
  middle = {0.0, 0.0, 0.0};
  if (region->dynamic) {
    const RegionMotion turned(*region);
    middle = {turned.point[0], turned.point[1], turned.point[2]};
  } else if (region->bboxflag) {
    middle = {0.5 * (region->extent_xlo + region->extent_xhi),
              0.5 * (region->extent_ylo + region->extent_yhi),
              0.5 * (region->extent_zlo + region->extent_zhi)};
  }
  dynamic = by_itself && region->dynamic_check();
  bounded = Talus::has_distance(*region);
  simple = bounded && !is_composite(*region);
  in_frame = !by_itself || (simple && dynamic);
  motion = RegionMotion();
  parts = bounded ? RegionParts(*region) : RegionParts();
  listed_poses.clear();
  all_of_body.resize(by_itself ? 0 : region->cmax);
}

std::string RegionShape::refusal(const Region &region, bool moves)
{
  if (region.varshape)
    return fmt::format("region '{}' changes its shape, which a large body does not: use fix "
                       "wall/gran/region",
                       region.id);
  if (!region.dynamic) return "";
  if (is_composite(region))
    return fmt::format("parts of region '{}' move: let the body move as a whole with 'move', or "
                       "use a body for each part",
                       region.id);
  if (moves)
    return fmt::format("region '{}' moves, and the body has a motion as well: remove one of them",
                       region.id);
  return "";
}

/* ---- of one that moves by itself ---- */

void RegionShape::place()
{
  too_many = false;
  if (!dynamic) return;
  region->prematch();
  region->set_velocity();
  parts.place();
  if (in_frame) motion = RegionMotion(*region);
}

void RegionShape::are_listed(const Eigen::AlignedBox3d &box)
{
  listed_poses = parts.poses();
  listed_box = box;
}

double RegionShape::displacement() const
{
  if (!dynamic || listed_poses.empty()) return 0.0;
  return parts.largest_displacement(listed_poses, listed_box);
}

/* LAMMPS computes the point of contact only if the region turns, but reads it if the region changes
   its shape. */

Vector3<double> RegionShape::velocity_at(const Vector3<double> &center, int k) const
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

void RegionShape::describe(const Vector3<double> &center, int k, SurfaceContact &contact) const
{
  const double radius = region->contact[k].radius;
  if (radius != 0.0) contact.curvature = 1.0 / radius;
  if (dynamic) contact.velocity = velocity_at(center, k);
}

/* ---- contacts ---- */

/* Several, for the engine. */

int RegionShape::most_contacts() const
{
  return by_itself ? std::max(region->tmax, 2) : max_contacts;
}

bool RegionShape::is_inside(const Vector3<double> &at) const
{
  const double x[3] = {at.x, at.y, at.z};
  return in_frame ? RegionInFrame(*region, motion).match(x) : region->match(x[0], x[1], x[2]);
}

TALUS_INLINE int RegionShape::contacts_at(const Vector3<double> &at, double radius) const
{
  const double x[3] = {at.x, at.y, at.z};
  return in_frame ? RegionInFrame(*region, motion).surface(x, radius)
                  : region->surface(x[0], x[1], x[2], radius);
}

bool RegionShape::have_normals(int count) const
{
  return std::all_of(region->contact, region->contact + count,
                     [](const Region::Contact &contact) { return contact.r > 0.0; });
}

/* A center that is on the surface has no normal: that of a place beside it on the inner side. */

int RegionShape::contacts_beside(const Vector3<double> &at, double radius) const
{
  const double aside = 1.0e-9 * radius;
  for (const double s : {aside, -aside}) {
    const Vector3<double> beside = at + s * Vector3<double>{1.0, 0.7, 0.4};
    if (!is_inside(beside)) continue;
    if (const int found = contacts_at(beside, radius); have_normals(found)) return found;
  }
  return 0;
}

/* As in LAMMPS, only particles on the inner side are looked at: others keep their histories. With a
   simple region what has contacts is there, unless its center is on the surface. A particle between
   opposite faces has more contacts than there is room for. */

int RegionShape::find_in_order(const Vector3<double> &center, double radius,
                               SurfaceContact *found) const
{
  const Vector3<double> at = span.image_of(center);
  if (!simple && !is_inside(at)) return -1;
  int touched = contacts_at(at, radius);
  if (!have_normals(touched)) touched = contacts_beside(at, radius);
  const bool known = simple && touched > 0 && region->contact[0].r > 0.0;
  if (simple && !known && !is_inside(at)) return -1;
  int count = 0;
  for (int k = 0; k < touched; k++) {
    const Region::Contact &c = region->contact[k];
    if (!(c.r < radius)) continue;
    if (by_itself && count == region->tmax) {
      too_many = true;
      break;
    }
    const double inverse = 1.0 / c.r;
    SurfaceContact &one = found[count++];
    one = {{c.delx * inverse, c.dely * inverse, c.delz * inverse}, radius - c.r, c.iwall};
    if (by_itself) describe(center, k, one);
  }
  return count;
}

int RegionShape::find_contacts(const Vector3<double> &center, double radius, NearParts /*parts*/,
                               SurfaceContact *found) const
{
  if (by_itself) return find_in_order(center, radius, found);
  const int all = find_in_order(center, radius, all_of_body.data());
  if (all < 0) return all;
  sort_contacts(all_of_body.data(), all);
  const int count = std::min(all, max_contacts);
  std::copy_n(all_of_body.begin(), count, found);
  return count;
}

bool RegionShape::touches(const Vector3<double> &center, double radius,
                          SurfaceContact &contact) const
{
  SurfaceContact found[max_parts];
  const bool any = find_contacts(center, radius, {nullptr, nullptr}, found) > 0;
  if (any) contact = found[0];
  return any;
}

/* Rounding must not hide a particle; particles stay a little beyond a periodic face until they are listed
   again. */

unsigned RegionShape::may_touch_eight(const EightSpheres &spheres) const
{
  constexpr double rounding = 1.000001;
  if (!bounded) return 0xffU;
  const Vector3<Vec8> x{load8(spheres.center[0]), load8(spheres.center[1]),
                        load8(spheres.center[2])};
  const Vec8 reach = splat<Vec8>(rounding) * load8(spheres.radius);
  unsigned bits = 0;
  span.each_image(x, [&](const Vector3<Vec8> &image) { bits |= parts.near(image, reach); });
  return bits;
}

/* What may_touch_eight() cannot tell. */

bool RegionShape::is_near(const Vector3<double> &x, double reach,
                          std::vector<NearPart> & /*parts*/) const
{
  bool near = bounded || by_itself;
  span.each_image(
      x, [&](const Vector3<double> &image) { near = near || contacts_at(image, reach) > 0; });
  return near;
}

}    // namespace Talus
