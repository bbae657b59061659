// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Minkowski Portal Refinement (G. Snethen, in Game Programming Gems 7, 2008) as libccd has it. Its
// tolerances are absolute numbers: lengths are given to it over the size of the pair.

#include "shape/convex/collide.h"
#include "shape/convex/pair_contacts.h"

#if TALUS_HAS_CCD
#include <ccd/ccd.h>

namespace Talus {
namespace {

static_assert(sizeof(ccd_real_t) == sizeof(double), "libccd must be built for double precision");

using Vector = Vector3<double>;

/// A body as libccd sees it.
struct Body {
  const ConvexCore *core;
  Pose pose;
  double radius, per_length;
};

void support(const void *body, const ccd_vec3_t *direction, ccd_vec3_t *point)
{
  const Body &b = *static_cast<const Body *>(body);
  const Vector d{direction->v[0], direction->v[1], direction->v[2]};
  const double size = length(d);
  const int v = highest_vertex(*b.core, b.pose.direction_in_body(d)).vertex;
  Vector x = b.pose.point_in_space(b.core->vertex(v));
  if (b.radius > 0.0 && size > 0.0) x = x + (b.radius / size) * d;
  ccdVec3Set(point, b.per_length * x.x, b.per_length * x.y, b.per_length * x.z);
}

void center(const void *body, ccd_vec3_t *point)
{
  const Body &b = *static_cast<const Body *>(body);
  const Vector &x = b.pose.position;
  ccdVec3Set(point, b.per_length * x.x, b.per_length * x.y, b.per_length * x.z);
}

}    // namespace

bool find_mpr_contact(const CorePair &pair, Rounding radius, ShapeContact &contact)
{
  const double per_length = 1.0 / (pair.scale() + radius.sum());
  const Body a{&pair.a, Pose(), radius.of_a, per_length},
      b{&pair.b, pair.seen, radius.of_b, per_length};
  ccd_t options;
  CCD_INIT(&options);
  options.support1 = options.support2 = support;
  options.center1 = options.center2 = center;
  options.max_iterations = 200;
  options.mpr_tolerance = 1.0e-9;
  ccd_real_t depth;
  ccd_vec3_t direction, position;
  if (ccdMPRPenetration(&a, &b, &options, &depth, &direction, &position) != 0) return false;
  if (!(depth > 0.0)) return false;
  // the direction moves b out of a
  contact.normal = {-direction.v[0], -direction.v[1], -direction.v[2]};
  contact.overlap = depth / per_length;
  contact.position = (1.0 / per_length) * Vector{position.v[0], position.v[1], position.v[2]};
  contact.weight = 1.0;
  contact.name = contact_name(ContactParts::WHOLE, 0, 0);
  return true;
}

bool has_mpr()
{
  return true;
}

}    // namespace Talus

#else

namespace Talus {

bool has_mpr()
{
  return false;
}

bool find_mpr_contact(const CorePair &, Rounding, ShapeContact &)
{
  return false;    // not asked for, see has_mpr()
}

}    // namespace Talus

#endif
