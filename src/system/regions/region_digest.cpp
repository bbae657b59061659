// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/regions/region_digest.h"

#include "base/state_digest.h"
#include "system/host/private_members.h"
#include "system/host/time_formula.h"

#include "region.h"
#include "region_block.h"
#include "region_cone.h"
#include "region_cylinder.h"
#include "region_plane.h"
#include "region_prism.h"
#include "region_sphere.h"

using namespace LAMMPS_NS;

namespace Talus {

namespace {

void add_shape(StateDigest &digest, const CornersOfRegion &shape)
{
  for (const double(&corner)[3] : shape.corner) digest.add(corner, 3);
  for (const double(&normal)[3] : shape.normal) digest.add(normal, 3);
}

void add_shape(StateDigest &digest, const RoundRegion &shape)
{
  digest.add(static_cast<double>(shape.axis));
  digest.add(shape.center, 2);
  digest.add(shape.radius, 2);
  digest.add(shape.end, 2);
}

void add_shape(StateDigest &digest, const std::array<double, 4> &shape)
{
  digest.add(shape.data(), 4);
}

void add_shape(StateDigest &digest, const std::array<std::array<double, 3>, 2> &shape)
{
  for (const std::array<double, 3> &row : shape) digest.add(row.data(), 3);
}

template <class Style> const Style *as(const Region &region)
{
  return dynamic_cast<const Style *>(&region);
}

/// Of the styles whose shape is known.
void add_shape_of(const Region &region, StateDigest &digest)
{
  if (const auto *block = as<RegBlock>(region)) add_shape(digest, corners_of(*block));
  if (const auto *prism = as<RegPrism>(region)) add_shape(digest, corners_of(*prism));
  if (const auto *cylinder = as<RegCylinder>(region)) add_shape(digest, shape_of(*cylinder));
  if (const auto *cone = as<RegCone>(region)) add_shape(digest, shape_of(*cone));
  if (const auto *sphere = as<RegSphere>(region)) add_shape(digest, shape_of(*sphere));
  if (const auto *plane = as<RegPlane>(region)) add_shape(digest, shape_of(*plane));
}

}    // namespace

/* Neither where a region is that moves, nor what bounds it, which some hosts move along; nor the regions of
   which one is made, which may be gone. */

std::uint64_t digest_of(const Region &region)
{
  StateDigest digest;
  for (const char *c = region.style; *c; c++) digest.add(static_cast<std::uint64_t>(*c));
  for (const int number :
       {region.interior, region.openflag, region.varshape, region.moveflag, region.rotateflag,
        region.bboxflag, region.cmax, is_composite(region) ? region.nregion : 0})
    digest.add(static_cast<std::uint64_t>(number));
  if (region.dynamic || region.varshape) return digest.value();
  if (region.bboxflag)
    for (const double edge : {region.extent_xlo, region.extent_xhi, region.extent_ylo,
                              region.extent_yhi, region.extent_zlo, region.extent_zhi})
      digest.add(edge);
  add_shape_of(region, digest);
  return digest.value();
}

}    // namespace Talus
