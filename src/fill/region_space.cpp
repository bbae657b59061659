// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fill/region_space.h"

#include "domain.h"
#include "error.h"
#include "region.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace Talus;

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
  const double of_region[6] = {region->extent_xlo, region->extent_ylo, region->extent_zlo,
                               region->extent_xhi, region->extent_yhi, region->extent_zhi};
  lo = {domain->boxlo[0], domain->boxlo[1], domain->boxlo[2]};
  hi = {domain->boxhi[0], domain->boxhi[1], domain->boxhi[2]};
  bool empty = false;
  for (int d = 0; d < 3; d++) {
    periodic[d] = domain->periodicity[d] != 0;
    const bool bounded = region->bboxflag && !region->dynamic;
    low[d] = bounded ? std::max(domain->boxlo[d], of_region[d]) : domain->boxlo[d];
    high[d] = bounded ? std::min(domain->boxhi[d], of_region[d + 3]) : domain->boxhi[d];
    empty = empty || !(high[d] > low[d]);
  }
  if (empty) error->all(FLERR, "{}: region '{}' is empty or outside the box", command, region_id);
}

bool RegionSpace::contains(const Vector3<double> &x) const
{
  const double place[3] = {x.x, x.y, x.z};
  for (int d = 0; d < 3; d++)
    if (place[d] < domain->boxlo[d] || place[d] >= domain->boxhi[d]) return false;
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

Vector3<double> RegionSpace::draw(RandomNumbers &random) const
{
  double x[3];
  for (int d = 0; d < 3; d++) x[d] = low[d] + random.uniform() * (high[d] - low[d]);
  return {x[0], x[1], x[2]};
}
