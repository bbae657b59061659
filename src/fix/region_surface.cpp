// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/region_surface.h"

#include "system/lammps_compat.h"
#include "system/private_members.h"
#include "system/time_formula.h"

#include "input.h"
#include "lammps.h"
#include "region.h"
#include "variable.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

namespace Talus {

bool is_composite(const Region &region)
{
  return std::strcmp(region.style, "union") == 0 || std::strcmp(region.style, "intersect") == 0;
}

namespace {

/* Contacts of these lie on the surface, and there is one if it is nearer than the cutoff. Region
   ellipsoid is none of them: near its inner surface it finds only some. */

bool is_convex(const Region &region)
{
  static const char *const styles[] = {"block", "cone", "cylinder", "plane", "prism", "sphere"};
  return std::any_of(std::begin(styles), std::end(styles),
                     [&](const char *style) { return std::strcmp(region.style, style) == 0; });
}

}    // namespace

void AxisBox::add(const double *x)
{
  for (int d = 0; d < 3; d++) {
    lo[d] = std::min(lo[d], x[d]);
    hi[d] = std::max(hi[d], x[d]);
  }
}

void AxisBox::widen(double by)
{
  for (int d = 0; d < 3; d++) {
    lo[d] -= by;
    hi[d] += by;
  }
}

/* ---------------------------------------------------------------------- */

RegionPose::RegionPose(Region &region)
{
  if (!region.dynamic) return;
  move_with_region(region, shift);
  for (int axis = 0; axis < 3; axis++) {
    double x[3] = {0.0, 0.0, 0.0};
    x[axis] = 1.0;
    move_with_region(region, x);
    for (int d = 0; d < 3; d++) rotation[d][axis] = x[d] - shift[d];
  }
}

void RegionPose::place_of(const double *x0, double *x) const
{
  for (int d = 0; d < 3; d++)
    x[d] = rotation[d][0] * x0[0] + rotation[d][1] * x0[1] + rotation[d][2] * x0[2] + shift[d];
}

void RegionPose::origin_of(const double *x, double *x0) const
{
  const double r[3] = {x[0] - shift[0], x[1] - shift[1], x[2] - shift[2]};
  for (int d = 0; d < 3; d++)
    x0[d] = rotation[0][d] * r[0] + rotation[1][d] * r[1] + rotation[2][d] * r[2];
}

void RegionPose::turn(double *vector) const
{
  const double v[3] = {vector[0], vector[1], vector[2]};
  for (int d = 0; d < 3; d++)
    vector[d] = rotation[d][0] * v[0] + rotation[d][1] * v[1] + rotation[d][2] * v[2];
}

/* The displacement is an affine function of the point, so its length is largest in a corner. */

double RegionPose::largest_displacement(const RegionPose &then, const AxisBox &box) const
{
  if (box.is_empty()) return 0.0;
  double largest = 0.0;
  for (int corner = 0; corner < 8; corner++) {
    double now[3], origin[3], before[3];
    for (int d = 0; d < 3; d++) now[d] = corner & (1 << d) ? box.hi[d] : box.lo[d];
    origin_of(now, origin);
    then.place_of(origin, before);
    largest =
        std::max(largest, std::hypot(now[0] - before[0], now[1] - before[1], now[2] - before[2]));
  }
  return largest;
}

RegionTurn::RegionTurn(const Region &region)
{
  if (region.moveflag) {
    const double its[3] = {region.dx, region.dy, region.dz};
    std::copy_n(its, 3, displacement);
  }
  if (!region.rotateflag) return;
  angle = region.theta;
  std::copy_n(point_of_rotation(region), 3, point);
  std::copy_n(axis_of_rotation(region), 3, axis);
}

/* ---------------------------------------------------------------------- */

bool has_distance(const Region &region)
{
  if (region.varshape) return false;
  if (!is_composite(region)) return is_convex(region);
  return !region.moveflag && !region.rotateflag &&
         std::all_of(region.reglist, region.reglist + region.nregion,
                     [](const Region *part) { return has_distance(*part); });
}

void RegionParts::collect(Region &region)
{
  if (is_composite(region)) {
    for (int n = 0; n < region.nregion; n++) collect(*region.reglist[n]);
    return;
  }
  simple.push_back(&region);
  pose.emplace_back();
}

void RegionParts::place()
{
  for (std::size_t k = 0; k < simple.size(); k++) pose[k] = RegionPose(*simple[k]);
}

double RegionParts::largest_displacement(const std::vector<RegionPose> &then,
                                         const AxisBox &box) const
{
  double largest = 0.0;
  for (std::size_t k = 0; k < simple.size(); k++)
    if (simple[k]->dynamic) largest = std::max(largest, pose[k].largest_displacement(then[k], box));
  return largest;
}

/* Of all equal-style variables the first whose value depends on more than the time, or "". */

static std::string variable_of_more_than_time(LAMMPS *lmp)
{
  Variable &all = *lmp->input->variable;
#if TALUS_HOST_TELLS_FORMULAS
  const int count = all.get_nvar();
  const auto name = [&all](int n) { return all.get_name(n); };
#else
  const int count = all.nvar;
  const auto name = [&all](int n) { return all.names[n]; };
#endif
  for (int n = 0; n < count; n++)
    if (all.equalstyle(n) && !reads_only_time(lmp, name(n))) return name(n);
  return "";
}

/* The variables of a shape are known to each style alone: all must do. */

std::string variable_that_may_read_particles(LAMMPS *lmp, Region &region)
{
  if (region.varshape) return variable_of_more_than_time(lmp);
  if (is_composite(region)) {
    for (int n = 0; n < region.nregion; n++) {
      const std::string its = variable_that_may_read_particles(lmp, *region.reglist[n]);
      if (!its.empty()) return its;
    }
    return "";
  }
  if (!region.dynamic) return "";
  for (const char *name : variables_of(region))
    if (name && !reads_only_time(lmp, name)) return name;
  return "";
}

/* ---------------------------------------------------------------------- */

RegionAtRest::RegionAtRest(Region &its) : region(its), dynamic(its.dynamic), turns(its.rotateflag)
{
  region.dynamic = region.rotateflag = 0;
}

RegionAtRest::~RegionAtRest()
{
  region.dynamic = dynamic;
  region.rotateflag = turns;
}

bool RegionInFrame::match(const double *x) const
{
  double x0[3];
  pose.origin_of(x, x0);
  const RegionAtRest at_rest(region);
  return region.match(x0[0], x0[1], x0[2]);
}

int RegionInFrame::surface(const double *x, double cutoff) const
{
  double x0[3];
  pose.origin_of(x, x0);
  const RegionAtRest at_rest(region);
  const int contacts = region.surface(x0[0], x0[1], x0[2], cutoff);
  for (int n = 0; n < contacts; n++) {
    Region::Contact &its = region.contact[n];
    double separation[3] = {its.delx, its.dely, its.delz};
    pose.turn(separation);
    its.delx = separation[0];
    its.dely = separation[1];
    its.delz = separation[2];
  }
  return contacts;
}

/* ---------------------------------------------------------------------- */

ClosedSurface::ClosedSurface(const RegionParts &its) : parts(its)
{
  for (Region *part : parts.regions()) {
    Settings now{part->interior, part->openflag, part->dynamic, part->rotateflag, {}};
    std::copy(part->open_faces, part->open_faces + 6, now.open_faces);
    before.push_back(now);
    part->openflag = part->dynamic = part->rotateflag = 0;
    std::fill(part->open_faces, part->open_faces + 6, 0);
  }
}

/* From behind, for one may be there twice. */

ClosedSurface::~ClosedSurface()
{
  for (std::size_t k = before.size(); k-- > 0;) {
    Region *part = parts.regions()[k];
    part->interior = before[k].interior;
    part->openflag = before[k].openflag;
    part->dynamic = before[k].dynamic;
    part->rotateflag = before[k].rotateflag;
    std::copy(before[k].open_faces, before[k].open_faces + 6, part->open_faces);
  }
}

/* A surface point of a union or intersection is one of its parts. Asked beside x: on an axis or in
   a center regions find no nearest point. */

bool ClosedSurface::is_near(const double *x, double reach) const
{
  const double aside[3] = {7.1e-4 * reach, -4.3e-4 * reach, 5.9e-4 * reach};
  const double beside[3] = {x[0] + aside[0], x[1] + aside[1], x[2] + aside[2]};
  const double wide = 1.002 * reach;
  for (std::size_t k = 0; k < before.size(); k++) {
    double y[3];
    parts.poses()[k].origin_of(beside, y);
    Region *part = parts.regions()[k];
    for (const int interior : {1, 0}) {
      part->interior = interior;
      if (part->surface(y[0], y[1], y[2], wide)) return true;
    }
  }
  return false;
}

}    // namespace Talus
