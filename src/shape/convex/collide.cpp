// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/convex/collide.h"

#include "shape/convex/pair_contacts.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

using Vector = Vector3<double>;

// Over the size of a pair. Where cores are nearer to each other than this their nearest points have
// no direction any more.
constexpr double too_near = 1.0e-7;

/* Along a direction in space from b to a. */

double width_along(const ConvexShape &a, const Pose &pose_a, const ConvexShape &b,
                   const Pose &pose_b, const Vector &n)
{
  return dot(n, pose_a.position - pose_b.position) -
         largest_height(a.core(), pose_a.direction_in_body(-n)) -
         largest_height(b.core(), pose_b.direction_in_body(n));
}

bool spheres_apart(const ConvexShape &a, const ConvexShape &b, const Vector &apart)
{
  const double reach = a.bounding_radius() + b.bounding_radius();
  return dot(apart, apart) > reach * reach;
}

bool is_known(const Vector &direction)
{
  return direction.x != 0.0 || direction.y != 0.0 || direction.z != 0.0;
}

void to_space(const Pose &pose, std::vector<ShapeContact> &contacts)
{
  for (ShapeContact &contact : contacts) {
    contact.position = pose.point_in_space(contact.position);
    contact.normal = pose.direction_in_space(contact.normal);
  }
}

/* Need not be the direction of the gap: the search for the least depth of sharp cores, and that for
   features along a gap that is nearly as wide as contacts of rounded ones reach, bring little more
   to light along another one. */

bool is_good_enough(Rounding radius, double width)
{
  constexpr double nearly = 0.9;
  return radius.sum() <= 0.0 || width > nearly * radius.sum();
}

/* Contacts in the frame of a. What is returned of the gap decides only which way is gone, with a
   margin, and what is looked at; contacts themselves are computed from the poses alone. Returns the
   direction that is worth to be known in the next step. */

Vector find_contacts(const CorePair &pair, Rounding radius, const Gap &gap, double merging,
                     double force_exponent, ShapeContacts &contacts)
{
  const double margin = too_near * pair.scale();
  if (radius.sum() > 0.0 && gap.width > margin) {
    add_feature_contacts(pair, radius, gap, force_exponent, contacts.points);
    return gap.direction;
  }
  const LeastDepth least = find_least_depth(pair, gap);
  if (radius.sum() > 0.0 && least.depth < -margin) {
    add_feature_contacts(pair, radius, {least.direction, -least.depth}, force_exponent,
                         contacts.points);
    return least.direction;
  }
  if (!(least.depth + radius.sum() > 0.0)) return least.direction;
  contacts.cores_overlap = radius.sum() > 0.0;
  add_face_contacts(pair, radius, least, merging, force_exponent, contacts.points);
  return least.direction;
}

}    // namespace

double merging_length(const ConvexShape &a, const ConvexShape &b)
{
  return 1.0e-4 * std::min(a.volume_radius(), b.volume_radius());
}

bool collide(const ConvexShape &a, const Pose &pose_a, const ConvexShape &b, const Pose &pose_b,
             SeparatingDirection &direction, ShapeContacts &contacts, NarrowPhase method,
             double force_exponent)
{
  contacts.clear();
  const Vector apart = pose_a.position - pose_b.position;
  if (spheres_apart(a, b, apart)) return false;
  const Rounding radius{a.radius(), b.radius()};
  const double enough =
      radius.sum() + 1.0e-10 * (a.core().outer_radius() + b.core().outer_radius());
  Gap known{{1.0, 0.0, 0.0}, -1.0};
  const bool is_old = is_known(direction.direction);
  if (is_old) {
    known.width = width_along(a, pose_a, b, pose_b, direction.direction);
    if (known.width > enough) return false;
  }
  const CorePair pair{a.core(), b.core(), relative_pose(pose_a, pose_b)};
  if (is_old)
    known.direction = pose_a.direction_in_body(direction.direction);
  else if (dot(apart, apart) > 0.0)
    known.direction = -pair.seen.position;
  if (method == NarrowPhase::MPR) {
    ShapeContact contact;
    if (find_mpr_contact(pair, radius, contact)) {
      contacts.points.push_back(contact);
    } else {
      const Gap gap = find_gap(pair, known.direction, enough, 1.0e-3 * enough);
      direction.direction = pose_a.direction_in_space(gap.direction);
    }
  } else {
    const bool skip = is_old && is_good_enough(radius, known.width);
    Gap gap = known;
    if (!skip) gap = find_gap(pair, known.direction, enough, 1.0e-3 * radius.sum());
    Vector next = gap.direction;
    if (gap.width <= enough)
      next = find_contacts(pair, radius, gap, merging_length(a, b), force_exponent, contacts);
    // apart, but not along what is known: looked for now, not again in each step
    if (skip && contacts.points.empty() && radius.sum() > 0.0)
      next = find_gap(pair, known.direction, enough, 1.0e-3 * radius.sum()).direction;
    direction.direction = pose_a.direction_in_space(next);
  }
  to_space(pose_a, contacts.points);
  return !contacts.points.empty();
}

/* ---- what is no convex body ------------------------------------------------------------------ */

bool collide_sphere(const ConvexShape &shape, const Pose &pose, const Vector &center, double radius,
                    ShapeContacts &contacts)
{
  contacts.clear();
  const Vector apart = center - pose.position;
  const double bound = shape.bounding_radius() + radius, reach = shape.radius() + radius;
  if (dot(apart, apart) >= bound * bound) return false;
  const CorePoint near = nearest_point(shape.core(), pose.point_in_body(center));
  if (!(near.distance < reach)) return false;
  ShapeContact contact;
  contact.normal = -pose.direction_in_space(near.normal);
  contact.overlap = reach - near.distance;
  contact.position = center + (radius - 0.5 * contact.overlap) * contact.normal;
  contact.weight = 1.0;
  contact.name = contact_name(ContactParts::WHOLE, 0, 0);
  contacts.points.push_back(contact);
  return true;
}

bool collide_plane(const ConvexShape &shape, const Pose &pose, const Vector &normal, double offset,
                   ShapeContacts &contacts)
{
  contacts.clear();
  const double middle = dot(normal, pose.position) - offset;
  if (middle >= shape.bounding_radius()) return false;
  const ConvexCore &core = shape.core();
  const Vector n = pose.direction_in_body(normal);
  for (int v = 0; v < core.num_vertices(); v++) {
    const Vector x = core.vertex(v);
    const double overlap = shape.radius() - (middle + dot(n, x));
    if (!(overlap > 0.0)) continue;
    ShapeContact contact;
    contact.normal = normal;
    contact.overlap = overlap;
    contact.position = pose.point_in_space(x) - (shape.radius() - 0.5 * overlap) * normal;
    contact.weight = 1.0;
    contact.name = contact_name(ContactParts::VERTEX_OF_A, v, 0);
    contacts.points.push_back(contact);
  }
  return !contacts.points.empty();
}

/* A sphere about the vertex that reaches far tells the distance of the walls, also from behind. */

bool collide_vessel(const ConvexShape &shape, const Pose &pose, const LargeBodyShape &vessel,
                    ShapeContacts &contacts)
{
  contacts.clear();
  const double reach = shape.bounding_radius();
  if (vessel.distance_bound(pose.position) >= reach) return false;
  const ConvexCore &core = shape.core();
  SurfaceContact found[LargeBodyShape::max_contacts];
  for (int v = 0; v < core.num_vertices(); v++) {
    const Vector x = pose.point_in_space(core.vertex(v));
    const int count = vessel.find_contacts(x, reach, {nullptr, nullptr}, found);
    for (int k = 0; k < count; k++) {
      const double overlap = found[k].overlap - (reach - shape.radius());
      if (!(overlap > 0.0)) continue;
      ShapeContact contact;
      contact.normal = found[k].normal;
      contact.overlap = overlap;
      contact.position = x - (shape.radius() - 0.5 * overlap) * contact.normal;
      contact.weight = 1.0;
      contact.name = contact_name(ContactParts::VERTEX_OF_A, v, 0);
      contact.surface = static_cast<std::uint32_t>(found[k].part);
      contact.part = found[k].part;
      contacts.points.push_back(contact);
    }
  }
  return !contacts.points.empty();
}

}    // namespace Talus
