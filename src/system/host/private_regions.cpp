// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// See private_members.h: of regions.

#include "system/host/private_member.h"
#include "system/host/private_members.h"

#include "region.h"
#include "region_block.h"
#include "region_cone.h"
#include "region_cylinder.h"
#include "region_plane.h"
#include "region_prism.h"
#include "region_sphere.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace Talus {

template <class Style> using VectorOf = double (Style::*)[3];
template <class Style> using NumberOf = double Style::*;

#define TALUS_PRIVATE_NUMBER(tag, style, member)                                                   \
  TALUS_PRIVATE_MEMBER(tag, NumberOf<style>, &style::member)

TALUS_PRIVATE_MEMBER(Point, VectorOf<Region>, &Region::point)
TALUS_PRIVATE_MEMBER(Axis, VectorOf<Region>, &Region::runit)
TALUS_PRIVATE_MEMBER(MoveX, char *Region::*, &Region::xstr)
TALUS_PRIVATE_MEMBER(MoveY, char *Region::*, &Region::ystr)
TALUS_PRIVATE_MEMBER(MoveZ, char *Region::*, &Region::zstr)
TALUS_PRIVATE_MEMBER(Angle, char *Region::*, &Region::tstr)
TALUS_PRIVATE_NUMBER(BlockXlo, RegBlock, xlo)
TALUS_PRIVATE_NUMBER(BlockXhi, RegBlock, xhi)
TALUS_PRIVATE_NUMBER(BlockYlo, RegBlock, ylo)
TALUS_PRIVATE_NUMBER(BlockYhi, RegBlock, yhi)
TALUS_PRIVATE_NUMBER(BlockZlo, RegBlock, zlo)
TALUS_PRIVATE_NUMBER(BlockZhi, RegBlock, zhi)
TALUS_PRIVATE_MEMBER(PrismLo, VectorOf<RegPrism>, &RegPrism::clo)
TALUS_PRIVATE_MEMBER(PrismHi, VectorOf<RegPrism>, &RegPrism::chi)
TALUS_PRIVATE_MEMBER(PrismFaces, double (RegPrism::*)[6][3], &RegPrism::face)
TALUS_PRIVATE_MEMBER(CylinderAxis, char RegCylinder::*, &RegCylinder::axis)
TALUS_PRIVATE_NUMBER(CylinderFirst, RegCylinder, c1)
TALUS_PRIVATE_NUMBER(CylinderSecond, RegCylinder, c2)
TALUS_PRIVATE_NUMBER(CylinderRadius, RegCylinder, radius)
TALUS_PRIVATE_NUMBER(CylinderLo, RegCylinder, lo)
TALUS_PRIVATE_NUMBER(CylinderHi, RegCylinder, hi)
TALUS_PRIVATE_MEMBER(ConeAxis, char RegCone::*, &RegCone::axis)
TALUS_PRIVATE_NUMBER(ConeFirst, RegCone, c1)
TALUS_PRIVATE_NUMBER(ConeSecond, RegCone, c2)
TALUS_PRIVATE_NUMBER(ConeRadiusLo, RegCone, radiuslo)
TALUS_PRIVATE_NUMBER(ConeRadiusHi, RegCone, radiushi)
TALUS_PRIVATE_NUMBER(ConeLo, RegCone, lo)
TALUS_PRIVATE_NUMBER(ConeHi, RegCone, hi)
TALUS_PRIVATE_NUMBER(SphereX, RegSphere, xc)
TALUS_PRIVATE_NUMBER(SphereY, RegSphere, yc)
TALUS_PRIVATE_NUMBER(SphereZ, RegSphere, zc)
TALUS_PRIVATE_NUMBER(SphereRadius, RegSphere, radius)
TALUS_PRIVATE_NUMBER(PlaneX, RegPlane, xp)
TALUS_PRIVATE_NUMBER(PlaneY, RegPlane, yp)
TALUS_PRIVATE_NUMBER(PlaneZ, RegPlane, zp)
TALUS_PRIVATE_MEMBER(PlaneNormal, VectorOf<RegPlane>, &RegPlane::normal)

const double *point_of_rotation(const Region &region)
{
  return region.*pointer_to(Point{});
}

const double *axis_of_rotation(const Region &region)
{
  return region.*pointer_to(Axis{});
}

std::array<const char *, 4> variables_of(const Region &region)
{
  return {region.*pointer_to(MoveX{}), region.*pointer_to(MoveY{}), region.*pointer_to(MoveZ{}),
          region.*pointer_to(Angle{})};
}

CornersOfRegion corners_of(const RegBlock &r)
{
  return {{{r.*pointer_to(BlockXlo{}), r.*pointer_to(BlockYlo{}), r.*pointer_to(BlockZlo{})},
           {r.*pointer_to(BlockXhi{}), r.*pointer_to(BlockYhi{}), r.*pointer_to(BlockZhi{})}},
          {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
}

CornersOfRegion corners_of(const RegPrism &r)
{
  CornersOfRegion corners;
  std::copy_n(r.*pointer_to(PrismLo{}), 3, corners.corner[0]);
  std::copy_n(r.*pointer_to(PrismHi{}), 3, corners.corner[1]);
  for (int face = 0; face < 6; face++)
    std::copy_n((r.*pointer_to(PrismFaces{}))[face], 3, corners.normal[face]);
  return corners;
}

RoundRegion shape_of(const RegCylinder &r)
{
  const double radius = r.*pointer_to(CylinderRadius{});
  return {r.*pointer_to(CylinderAxis{}) - 'x',
          {r.*pointer_to(CylinderFirst{}), r.*pointer_to(CylinderSecond{})},
          {radius, radius},
          {r.*pointer_to(CylinderLo{}), r.*pointer_to(CylinderHi{})}};
}

RoundRegion shape_of(const RegCone &r)
{
  return {r.*pointer_to(ConeAxis{}) - 'x',
          {r.*pointer_to(ConeFirst{}), r.*pointer_to(ConeSecond{})},
          {r.*pointer_to(ConeRadiusLo{}), r.*pointer_to(ConeRadiusHi{})},
          {r.*pointer_to(ConeLo{}), r.*pointer_to(ConeHi{})}};
}

std::array<double, 4> shape_of(const RegSphere &r)
{
  return {r.*pointer_to(SphereX{}), r.*pointer_to(SphereY{}), r.*pointer_to(SphereZ{}),
          r.*pointer_to(SphereRadius{})};
}

std::array<std::array<double, 3>, 2> shape_of(const RegPlane &r)
{
  const double *n = r.*pointer_to(PlaneNormal{});
  return {{{r.*pointer_to(PlaneX{}), r.*pointer_to(PlaneY{}), r.*pointer_to(PlaneZ{})},
           {n[0], n[1], n[2]}}};
}

}    // namespace Talus
