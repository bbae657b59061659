// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/regions/region_shape.h"

#include "fmt/format.h"
#include "region.h"
#include "system/host/time_formula.h"

#include <algorithm>
#include <limits>
#include <vector>

using namespace LAMMPS_NS;
using Talus::NearPart;
using Talus::NearParts;
using Talus::SurfaceContact;
using Talus::Vector3;

RegionShape::RegionShape(Region *r, const char *name, const Domain &domain) : id(name)
{
  replace(r, domain);
}

/* Some versions of LAMMPS move the extent with the region, others have none of one that moves. */

void RegionShape::replace(Region *now, const Domain &domain)
{
  region = now;
  span = Talus::PeriodicSpan(*now, domain);
  middle = {0.0, 0.0, 0.0};
  if (region->dynamic) {
    const Talus::RegionMotion motion(*region);
    middle = {motion.point[0], motion.point[1], motion.point[2]};
  } else if (region->bboxflag) {
    middle = {0.5 * (region->extent_xlo + region->extent_xhi),
              0.5 * (region->extent_ylo + region->extent_yhi),
              0.5 * (region->extent_zlo + region->extent_zhi)};
  }
}

std::string RegionShape::refusal(Region &region, bool moves)
{
  if (region.varshape)
    return fmt::format("region '{}' changes its shape, which a large body does not: use fix "
                       "wall/gran/region",
                       region.id);
  if (!region.dynamic) return "";
  if (Talus::is_composite(region))
    return fmt::format("parts of region '{}' move: let the body move as a whole with 'move', or "
                       "use a body for each part",
                       region.id);
  if (moves)
    return fmt::format("region '{}' moves, and the body has a motion as well: remove one of them",
                       region.id);
  return "";
}

int RegionShape::find_contacts(const Vector3<double> &center, double radius, NearParts /*parts*/,
                               SurfaceContact *found) const
{
  const Talus::RegionAtRest at_rest(*region);
  const Vector3<double> x = span.image_of(center);
  const int touched = region->surface(x.x, x.y, x.z, radius);
  std::vector<SurfaceContact> all;
  for (int k = 0; k < touched; k++) {
    const Region::Contact &c = region->contact[k];
    if (!(c.r > 0.0) || c.r >= radius) continue;
    const Vector3<double> away{c.delx, c.dely, c.delz};
    all.push_back({1.0 / c.r * away, radius - c.r, c.iwall});
  }
  Talus::sort_contacts(all.data(), static_cast<int>(all.size()));
  const int count = std::min(static_cast<int>(all.size()), max_contacts);
  std::copy(all.begin(), all.begin() + count, found);
  return count;
}

bool RegionShape::touches(const Vector3<double> &center, double radius,
                          SurfaceContact &contact) const
{
  SurfaceContact found[max_contacts];
  const int count = find_contacts(center, radius, {nullptr, nullptr}, found);
  if (count) contact = found[0];
  return count > 0;
}

bool RegionShape::is_near(const Vector3<double> &x, double reach,
                          std::vector<NearPart> & /*parts*/) const
{
  const Talus::RegionAtRest at_rest(*region);
  bool near = false;
  span.each_image(x, [&](const Vector3<double> &image) {
    near = near || region->surface(image.x, image.y, image.z, reach) > 0;
  });
  return near;
}

/* Only is_near() is asked where there may be several contacts; a region does not know more. */

double RegionShape::distance_bound(const Vector3<double> & /*center*/) const
{
  return 0.0;
}
