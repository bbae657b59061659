// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/superellipsoid/least_overlap.h"
#include "shape/superellipsoid/superellipsoid_contacts.h"
#include "shape/superellipsoid/superellipsoid_words.h"
#include "shape/superellipsoid/touch.h"

#include <vector>

namespace Talus {
namespace {

const std::uint32_t whole = contact_name(ContactParts::WHOLE, 0, 0);

bool single(const SuperellipsoidTouch::Found &found, double other_curvature,
            ShapeContacts &contacts)
{
  if (!(found.overlap > 0.0)) return false;
  contacts.points.push_back(shape_contact(found, other_curvature, whole));
  return true;
}

bool finish(const Superellipsoid &a, const Pose &pose, const CommonNormal &found,
            SeparatingDirection *direction, ShapeContacts &contacts)
{
  const Vector3<double> normal = pose.direction_in_space(found.normal);
  if (!(found.overlap > 0.0)) {
    if (direction) direction->direction = -normal;
    return false;
  }
  const Vector3<double> middle = 0.5 * (found.of_a.place + found.place_on_b);
  return single({normal, pose.point_in_space(found.of_a.place), pose.point_in_space(middle),
                 found.overlap, a.curvature_for_laws(found.of_a)},
                found.curvature_of_b, contacts);
}

bool with_superellipsoid(const PlacedSuperellipsoid &a, const PlacedSuperellipsoid &b,
                         const CollisionRequest &how, ShapeContacts &contacts)
{
  contacts.clear();
  const Pose seen = relative_pose(a.pose, b.pose);
  const CommonNormal found = find_common_normal(a.geometry, b.geometry, seen);
  return finish(a.geometry, a.pose, found, how.direction, contacts);
}

/* ---- several pairs ---------------------------------------------------------------------------- */

/// Pairs of two shapes, up to eight at a time.
class EightPairs {
 public:
  EightPairs(const Superellipsoid &shape_a, const Superellipsoid &shape_b) : a(shape_a), b(shape_b)
  {
  }
  ~EightPairs() { flush(); }
  EightPairs(const EightPairs &) = delete;
  EightPairs &operator=(const EightPairs &) = delete;

  void add(const CollisionJob &job)
  {
    jobs[count] = &job;
    seen[count++] = relative_pose(*job.pose_a, *job.pose_b);
    if (count == lanes) look_along_known();
  }

 private:
  /* Those that are known to be apart by more than rounding along a direction are done: no search would find that
     they touch. */
  void look_along_known()
  {
    Vector3<double> along[lanes];
    for (int k = 0; k < count; k++)
      along[k] = -jobs[k]->pose_a->direction_in_body(jobs[k]->direction->direction);
    const unsigned apart = count ? apart_along(a, b, seen, along, count) : 0U;
    for (int k = 0; k < count; k++)
      if (!(apart >> k & 1U)) search(*jobs[k], seen[k]);
    count = 0;
  }
  void search(const CollisionJob &job, const Pose &pose)
  {
    near_jobs[near_count] = &job;
    near_seen[near_count++] = pose;
    if (near_count == lanes) search();
  }
  void search()
  {
    CommonNormal found[lanes];
    if (near_count) find_common_normals(a, b, near_seen, near_count, found);
    for (int k = 0; k < near_count; k++)
      finish(a, *near_jobs[k]->pose_a, found[k], near_jobs[k]->direction, *near_jobs[k]->contacts);
    near_count = 0;
  }
  void flush()
  {
    look_along_known();
    search();
  }

  const Superellipsoid &a, &b;
  const CollisionJob *jobs[lanes], *near_jobs[lanes];
  Pose seen[lanes], near_seen[lanes];
  int count = 0, near_count = 0;
};

void many_superellipsoids(const CollisionJob *jobs, int count)
{
  std::vector<bool> done(count, false);
  for (int first = 0; first < count; first++) {
    if (done[first]) continue;
    const Geometry *const a = jobs[first].a, *const b = jobs[first].b;
    EightPairs pairs(static_cast<const Superellipsoid &>(*a),
                     static_cast<const Superellipsoid &>(*b));
    for (int k = first; k < count; k++) {
      if (done[k] || jobs[k].a != a || jobs[k].b != b) continue;
      done[k] = true;
      pairs.add(jobs[k]);
    }
  }
}

/* ---- others ----------------------------------------------------------------------------------- */

bool with_sphere(const PlacedSuperellipsoid &a, const Placed<Sphere> &b,
                 const CollisionRequest & /*how*/, ShapeContacts &contacts)
{
  contacts.clear();
  const SuperellipsoidTouch touch(a.geometry, a.pose);
  const double radius = b.geometry.radius;
  if (touch.is_beyond(b.pose.position, radius)) return false;
  return single(touch.ball(b.pose.position, radius), 1.0 / radius, contacts);
}

/* As for other shapes, up to a center one bounding radius behind. */

bool with_flat(const PlacedSuperellipsoid &a, const Placed<FlatSurface> &b,
               const CollisionRequest & /*how*/, ShapeContacts &contacts)
{
  contacts.clear();
  const FlatSurface &plane = b.geometry;
  const double height = dot(plane.normal, a.pose.position) - plane.offset,
               reach = a.geometry.bounding_radius();
  if (height <= -reach || height >= reach) return false;
  const double side = plane.two_sided && height < 0.0 ? -1.0 : 1.0;
  const SuperellipsoidTouch touch(a.geometry, a.pose);
  if (!single(touch.plane(side * plane.normal, side * plane.offset), 0.0, contacts)) return false;
  contacts.points.back().part = plane.part;
  return true;
}

}    // namespace

void add_superellipsoid_collisions(Collisions &table)
{
  table.add<with_superellipsoid, with_sphere, with_flat, superellipsoid_and_convex,
            superellipsoid_and_round, superellipsoid_and_vessel, superellipsoid_and_mesh>();
  table.add_many<Superellipsoid, Superellipsoid>(many_superellipsoids);
}

}    // namespace Talus
