// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/regions/region_surface.h"

#include "system/host/private_members.h"
#include "system/host/time_formula.h"

#include "domain.h"
#include "region.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

namespace Talus {

/* ---------------------------------------------------------------------- */

RegionMotion::RegionMotion(const Region &region)
{
  if (region.moveflag) {
    const double shift[3] = {region.dx, region.dy, region.dz};
    std::copy_n(shift, 3, displacement);
  }
  if (!region.rotateflag) return;
  rotates = true;
  angle = region.theta;
  cosine = std::cos(angle);
  sine = std::sin(angle);
  std::copy_n(point_of_rotation(region), 3, point);
  std::copy_n(axis_of_rotation(region), 3, axis);
}

void RegionMotion::move(double (&x)[3]) const
{
  if (rotates) rotate(x, sine);
  for (int d = 0; d < 3; d++) x[d] += displacement[d];
}

void RegionMotion::move_back(double (&x)[3]) const
{
  for (int d = 0; d < 3; d++) x[d] -= displacement[d];
  if (rotates) rotate(x, -sine);
}

void RegionMotion::rotate(double (&x)[3], double sine_of_angle) const
{
  double along[3], across[3];
  for (int d = 0; d < 3; d++) x[d] -= point[d];
  const double length = x[0] * axis[0] + x[1] * axis[1] + x[2] * axis[2];
  for (int d = 0; d < 3; d++) {
    along[d] = length * axis[d];
    across[d] = x[d] - along[d];
  }
  for (int d = 0; d < 3; d++) {
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    const double upright = axis[e] * across[f] - axis[f] * across[e];
    x[d] = point[d] + along[d] + (across[d] * cosine + upright * sine_of_angle);
  }
}

/* ---------------------------------------------------------------------- */

RegionPose::RegionPose(const RegionMotion &motion)
{
  motion.move(shift);
  for (int axis = 0; axis < 3; axis++) {
    double x[3] = {0.0, 0.0, 0.0};
    x[axis] = 1.0;
    motion.move(x);
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

Vector3<double> RegionPose::turned(const Vector3<double> &v) const
{
  const auto &r = rotation;
  return {r[0][0] * v.x + r[0][1] * v.y + r[0][2] * v.z,
          r[1][0] * v.x + r[1][1] * v.y + r[1][2] * v.z,
          r[2][0] * v.x + r[2][1] * v.y + r[2][2] * v.z};
}

/* The displacement is an affine function of the point, so its length is largest in a corner. */

double RegionPose::largest_displacement(const RegionPose &then,
                                        const Eigen::AlignedBox3d &box) const
{
  if (box.isEmpty()) return 0.0;
  double largest = 0.0;
  for (int corner = 0; corner < 8; corner++) {
    double now[3], origin[3], before[3];
    for (int d = 0; d < 3; d++) now[d] = corner & (1 << d) ? box.max()[d] : box.min()[d];
    origin_of(now, origin);
    then.place_of(origin, before);
    largest =
        std::max(largest, std::hypot(now[0] - before[0], now[1] - before[1], now[2] - before[2]));
  }
  return largest;
}

/* ---------------------------------------------------------------------- */

bool has_distance(const Region &region)
{
  if (region.varshape) return false;
  if (!is_composite(region)) return ConvexRegion::includes(region);
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
  shape.emplace_back(region);
}

void RegionParts::place()
{
  for (std::size_t k = 0; k < simple.size(); k++) {
    if (!simple[k]->dynamic) continue;
    pose[k] = RegionPose(RegionMotion(*simple[k]));
    shape[k].place(pose[k]);
  }
}

unsigned RegionParts::near(const Vector3<Vec8> &x, Vec8 reach) const
{
  unsigned bits = 0;
  for (const ConvexRegion &part : shape) bits |= part.near(x, reach);
  return bits;
}

double RegionParts::largest_displacement(const std::vector<RegionPose> &then,
                                         const Eigen::AlignedBox3d &box) const
{
  double largest = 0.0;
  for (std::size_t k = 0; k < simple.size(); k++)
    if (simple[k]->dynamic) largest = std::max(largest, pose[k].largest_displacement(then[k], box));
  return largest;
}

/* ---------------------------------------------------------------------- */

PeriodicSpan::PeriodicSpan(const Region &region, const Domain &domain)
{
  if (!region.bboxflag || region.varshape || region.dynamic) return;
  if (domain.triclinic || domain.box_change) return;
  const double lo[3] = {region.extent_xlo, region.extent_ylo, region.extent_zlo},
               hi[3] = {region.extent_xhi, region.extent_yhi, region.extent_zhi};
  constexpr double tolerance = 1.0e-6;    // of the length of the box
  for (int d = 0; d < 3; d++) {
    const double length = domain.prd[d], allowed = tolerance * length;
    if (!domain.periodicity[d] || std::fabs(lo[d] - domain.boxlo[d]) > allowed ||
        std::fabs(hi[d] - domain.boxhi[d]) > allowed)
      continue;
    low[d] = domain.boxlo[d];
    period[d] = length;
  }
}

Vector3<double> PeriodicSpan::wrapped(Vector3<double> x) const
{
  constexpr double off_face = 1.0e-6;    // over the period: further than the tolerance above
  double *const at[3] = {&x.x, &x.y, &x.z};
  for (int d = 0; d < 3; d++) {
    if (!(period[d] > 0.0)) continue;
    const double least = off_face * period[d], s = *at[d] - low[d];
    if (s > least && s < period[d] - least) continue;
    const double wrapped = s - period[d] * std::floor(s / period[d]);
    *at[d] = low[d] + std::clamp(wrapped, least, period[d] - least);
  }
  return x;
}

/* ---------------------------------------------------------------------- */

namespace {

/// While it exists, a simple region answers as it was before it moved.
class RegionAtRest {
 public:
  explicit RegionAtRest(Region &moving) :
      region(moving), dynamic(moving.dynamic), turns(moving.rotateflag)
  {
    region.dynamic = region.rotateflag = 0;
  }
  ~RegionAtRest()
  {
    region.dynamic = dynamic;
    region.rotateflag = turns;
  }
  RegionAtRest(const RegionAtRest &) = delete;
  RegionAtRest &operator=(const RegionAtRest &) = delete;

 private:
  Region &region;
  const int dynamic, turns;
};

}    // namespace

bool RegionInFrame::match(const double *x) const
{
  double x0[3] = {x[0], x[1], x[2]};
  motion.move_back(x0);
  const RegionAtRest at_rest(region);
  return region.match(x0[0], x0[1], x0[2]);
}

/* LAMMPS turns the point of contact, not the vector from it. */

int RegionInFrame::surface(const double *x, double cutoff) const
{
  double x0[3] = {x[0], x[1], x[2]};
  motion.move_back(x0);
  const RegionAtRest at_rest(region);
  const int contacts = region.surface(x0[0], x0[1], x0[2], cutoff);
  for (int n = 0; n < contacts && motion.rotates; n++) {
    Region::Contact &contact = region.contact[n];
    double point[3] = {x0[0] - contact.delx, x0[1] - contact.dely, x0[2] - contact.delz};
    motion.move(point);
    contact.delx = x[0] - point[0];
    contact.dely = x[1] - point[1];
    contact.delz = x[2] - point[2];
  }
  return contacts;
}

}    // namespace Talus
