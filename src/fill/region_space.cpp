// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fill/region_space.h"

#include "base/linear_algebra.h"
#include "system/host/lammps_compat.h"
#include "system/host/private_members.h"
#include "system/host/time_formula.h"

#include "domain.h"
#include "error.h"
#include "region.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

using Eigen::AlignedBox3d;

AlignedBox3d all_of_space()
{
  const Eigen::Vector3d far = Eigen::Vector3d::Constant(HUGE_VAL);
  return {-far, far};
}

/// What may have some of the region, where it is now.
AlignedBox3d extent_of(const Region &region)
{
  if (region.varshape || !region.bboxflag) return all_of_space();
  const Eigen::Vector3d lo{region.extent_xlo, region.extent_ylo, region.extent_zlo},
      hi{region.extent_xhi, region.extent_yhi, region.extent_zhi};
  const AlignedBox3d given(lo, hi);
  if (!region.dynamic || TALUS_HOST_MOVES_EXTENTS) return given;
  if (is_composite(region)) {    // its parts move
    const bool is_union = std::strcmp(region.style, "union") == 0;
    AlignedBox3d all = is_union ? AlignedBox3d() : all_of_space();
    for (int n = 0; n < region.nregion; n++) {
      const AlignedBox3d part = extent_of(*region.reglist[n]);
      all = is_union ? all.merged(part) : all.intersection(part);
    }
    return all;
  }
  AlignedBox3d moved;
  for (int n = 0; n < 8; n++) {
    Eigen::Vector3d corner = given.corner(static_cast<AlignedBox3d::CornerType>(n));
    if (region.rotateflag) {
      const Eigen::Map<const Eigen::Vector3d> point(point_of_rotation(region)),
          axis(axis_of_rotation(region));
      corner = point + Eigen::AngleAxisd(region.theta, axis) * (corner - point);
    }
    if (region.moveflag) corner += Eigen::Vector3d{region.dx, region.dy, region.dz};
    moved.extend(corner);
  }
  return moved;
}

bool is_shrink_wrapped(const Domain &domain, int d, int side)
{
  return domain.boundary[d][side] >= 2;
}

}    // namespace

RegionSpace::RegionSpace(LAMMPS *lmp, const std::string &command, const std::string &region_id) :
    Pointers(lmp)
{
  if (domain->dimension != 3 || domain->triclinic)
    error->all(FLERR, "{} requires 'dimension 3' and a box that is not triclinic", command);
  region = domain->get_region_by_id(region_id);
  if (!region) error->all(FLERR, "{}: there is no region '{}'", command, region_id);
  if (region->openflag)
    error->all(FLERR, "{}: region '{}' has open faces: spheres would leave it", command, region_id);
  region->init();
  region->prematch();
  const AlignedBox3d extent = extent_of(*region);
  bool empty = false;
  double from[3], to[3];
  for (int d = 0; d < 3; d++) {
    periodic[d] = domain->periodicity[d] != 0;
    const auto grows = [&](int side, double end) {
      return is_shrink_wrapped(*domain, d, side) && std::isfinite(end);
    };
    low[d] = extent.min()[d];
    high[d] = extent.max()[d];
    if (!grows(0, low[d])) low[d] = std::max(domain->boxlo[d], low[d]);
    if (!grows(1, high[d])) high[d] = std::min(domain->boxhi[d], high[d]);
    from[d] = std::min(domain->boxlo[d], low[d]);
    to[d] = std::max(domain->boxhi[d], high[d]);
    empty = empty || (!(high[d] > low[d]) && !region->dynamic);    // a moving one may come back
  }
  lo = {from[0], from[1], from[2]};
  hi = {to[0], to[1], to[2]};
  if (empty) error->all(FLERR, "{}: region '{}' is empty or outside the box", command, region_id);
}

bool RegionSpace::contains(const Vector3<double> &x) const
{
  const double place[3] = {x.x, x.y, x.z};
  for (int d = 0; d < 3; d++) {
    if (place[d] < domain->boxlo[d] && !is_shrink_wrapped(*domain, d, 0)) return false;
    if (place[d] >= domain->boxhi[d] && !is_shrink_wrapped(*domain, d, 1)) return false;
  }
  return region->match(x.x, x.y, x.z) != 0;
}

bool RegionSpace::is_periodic_face(const Vector3<double> &at, const Vector3<double> &n) const
{
  const double place[3] = {at.x, at.y, at.z}, normal[3] = {n.x, n.y, n.z};
  for (int d = 0; d < 3; d++) {
    if (!periodic[d] || std::fabs(normal[d]) < 1.0 - 1.0e-9) continue;
    const double near = 1.0e-9 * domain->prd[d];
    if (std::fabs(place[d] - domain->boxlo[d]) < near ||
        std::fabs(place[d] - domain->boxhi[d]) < near)
      return true;
  }
  return false;
}

void RegionSpace::find_walls(const Vector3<double> &x, double radius,
                             std::vector<std::pair<Vector3<double>, double>> &walls) const
{
  const int found = region->surface(x.x, x.y, x.z, radius);
  for (int k = 0; k < found; k++) {
    const Region::Contact &c = region->contact[k];
    if (!(c.r > 0.0)) continue;
    const Vector3<double> normal{c.delx / c.r, c.dely / c.r, c.delz / c.r};
    if (!is_periodic_face(x - c.r * normal, normal)) walls.emplace_back(normal, radius - c.r);
  }
  const double place[3] = {x.x, x.y, x.z};
  for (int d = 0; d < 3; d++) {
    const Vector3<double> up{d == 0 ? 1.0 : 0.0, d == 1 ? 1.0 : 0.0, d == 2 ? 1.0 : 0.0};
    constexpr int fixed = 1;
    const double below = radius - (place[d] - domain->boxlo[d]);
    const double above = radius - (domain->boxhi[d] - place[d]);
    if (domain->boundary[d][0] == fixed && below > 0.0) walls.emplace_back(up, below);
    if (domain->boundary[d][1] == fixed && above > 0.0) walls.emplace_back(-up, above);
  }
}

bool RegionSpace::holds(const Vector3<double> &x, double radius) const
{
  if (!contains(x)) return false;
  std::vector<std::pair<Vector3<double>, double>> walls;
  find_walls(x, radius, walls);
  return walls.empty();
}

double RegionSpace::volume() const
{
  constexpr int parts = 128;
  const double h[3] = {(high[0] - low[0]) / parts, (high[1] - low[1]) / parts,
                       (high[2] - low[2]) / parts};
  int inside = 0;
  for (int k = 0; k < parts; k++)
    for (int j = 0; j < parts; j++)
      for (int i = 0; i < parts; i++)
        inside += region->match(low[0] + (i + 0.5) * h[0], low[1] + (j + 0.5) * h[1],
                                low[2] + (k + 0.5) * h[2]);
  return inside * (h[0] * h[1] * h[2]);
}

double RegionSpace::volume_between_corners() const
{
  double volume = 1.0;
  for (int d = 0; d < 3; d++) volume *= std::max(0.0, high[d] - low[d]);
  return volume;
}

Vector3<double> RegionSpace::draw(RandomNumbers &random) const
{
  double x[3];
  for (int d = 0; d < 3; d++) x[d] = low[d] + random.uniform() * (high[d] - low[d]);
  return {x[0], x[1], x[2]};
}
