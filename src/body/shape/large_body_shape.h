// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Geometry of a large body: a body that spans sub-domains, is known to every rank and never becomes
// a ghost. Derive from this class to add a shape of your own; examples/custom_shape does.
//
// All points are given in the frame of the body, which is that of the input script at the beginning
// of the run: a body that moves is asked with coordinates turned and shifted back. Lengths are in
// the units of the caller. No function but focus() may change the object, and unless thread_safe()
// says no, all others may be called from several threads.
//
// A shape that touches a sphere at one point at most implements touches() and distance_bound(), and
// touches_eight() if it is to be fast. One that may touch it at several points, such as the inside
// of a box, says so (most_contacts()) and implements find_contacts() as well, and is_near() to list
// which of its parts are near a particle.
//
// Raise TALUS_SHAPE_VERSION in custom_shape.h with every change of what is declared here.

#ifndef TALUS_BODY_SHAPE_LARGE_BODY_SHAPE_H
#define TALUS_BODY_SHAPE_LARGE_BODY_SHAPE_H

#include "base/vector3.h"

#include <algorithm>
#include <limits>
#include <vector>

// Only shapes with draw() or focus() need <Eigen/Geometry>.
namespace Eigen {
template <typename Scalar, int dimension> class AlignedBox;
typedef AlignedBox<double, 3> AlignedBox3d;
}    // namespace Eigen

namespace Talus {

class MeshShape;
class SurfaceVisitor;

/// Where a sphere touches a body.
struct SurfaceContact {
  Vector3<double> normal;    ///< unit vector from the body to the center of the sphere
  double overlap;            ///< radius minus distance of the center from the surface, > 0
  int part = 0;              ///< the part that is touched; of a mesh, a triangle
  // only of shapes that describe their surface
  double curvature = 0.0;    ///< of the surface there: 1/radius; 0: flat, < 0: hollow
  Vector3<double> velocity{0.0, 0.0, 0.0};    ///< of the surface there, in the frame of the body
};

/// Eight spheres, or less, side by side: `center` by component.
struct EightSpheres {
  static constexpr int width = 8;
  alignas(64) double center[3][width], radius[width];

  Vector3<double> at(int k) const { return {center[0][k], center[1][k], center[2][k]}; }
};

/// Where they touch a body; see SurfaceContact.
struct EightContacts {
  alignas(64) double normal[3][EightSpheres::width], overlap[EightSpheres::width];
  // only of shapes that describe their surface
  alignas(64) double velocity[3][EightSpheres::width], curvature[EightSpheres::width];
  int part[EightSpheres::width];

  void set(int k, const SurfaceContact &one)
  {
    const Vector3<double> &n = one.normal, &v = one.velocity;
    const double along[3] = {n.x, n.y, n.z}, way[3] = {v.x, v.y, v.z};
    for (int d = 0; d < 3; d++) {
      normal[d][k] = along[d];
      velocity[d][k] = way[d];
    }
    overlap[k] = one.overlap;
    curvature[k] = one.curvature;
    part[k] = one.part;
  }
  /// Of a surface that does not describe itself.
  SurfaceContact plain(int k) const
  {
    return {{normal[0][k], normal[1][k], normal[2][k]}, overlap[k], part[k]};
  }
};

/// Where a body is flat around the point of it that is nearest to a sphere: the plane there.
struct FlatPlace {
  Vector3<double> normal{0.0, 0.0, 0.0};
  double offset = 0.0;    ///< the product of the points of the plane with the normal
  int part = 0;           ///< see SurfaceContact
  /// The foot of the center on the plane stays on this part as long as the center goes no further
  /// (length); 0: nothing is known.
  double way = 0.0;
};

/// Eight of them side by side.
struct EightFlatPlaces {
  alignas(64) double normal[3][EightSpheres::width], offset[EightSpheres::width];
  int part[EightSpheres::width];

  void set(int k, const FlatPlace &one)
  {
    const double along[3] = {one.normal.x, one.normal.y, one.normal.z};
    for (int d = 0; d < 3; d++) normal[d][k] = along[d];
    offset[k] = one.offset;
    part[k] = one.part;
  }
};

/// A part of a body near some particle, and its distance at the time when it was listed.
struct NearPart {
  int part;
  int group;    ///< for the shape: what it needs without reading the part
  double distance;
};

/// The parts that may touch a sphere, as listed by is_near() and thinned out since.
struct NearParts {
  const NearPart *begin, *end;
};

/// A part that the center of a sphere went through.
struct Passage {
  int part = -1;                   ///< -1: none
  bool from_acting_side = true;    ///< from a side on which spheres are touched
};

struct Triangle {
  Vector3<double> corner[3];
};

class LargeBodyShape {
 public:
  /// No shape may have more contacts with a sphere than this; but for those whose contacts are known
  /// by their parts, see BodyHistory.
  static constexpr int max_contacts = 8, max_parts = 32;

  virtual ~LargeBodyShape() = default;

  /// Does the sphere touch the body? Fills `contact` (the deepest) only if it does. Called for
  /// every candidate particle in every step if there is one contact at most.
  virtual bool touches(const Vector3<double> &center, double radius,
                       SurfaceContact &contact) const = 0;

  /// A lower bound of the distance at which touches() measures the surface, for the broad phase: a
  /// sphere further away than its radius plus the skin is not looked at until the next rebuild.
  virtual double distance_bound(const Vector3<double> &center) const = 0;

  /// Point about which torques on the body are taken, in the frame of the body.
  virtual Vector3<double> reference_point() const = 0;

  /// No point of the surface that touches() measures is further away from this one; infinite if that is
  /// not known. A body that turns lists particles anew as it moves there, instead of where the
  /// furthest particle is.
  virtual double extent_from(const Vector3<double> &point) const
  {
    (void) point;
    return std::numeric_limits<double>::infinity();
  }

  /// No sphere touches the body at more points than this: 1 ... max_contacts, or max_parts.
  virtual int most_contacts() const { return 1; }

  /// Fills found[0 ...] with at most most_contacts() contacts, in an order that depends on nothing
  /// but the sphere, and returns their number; or a number < 0: the sphere is where its contacts neither
  /// act nor end, behind a surface of LAMMPS.
  virtual int find_contacts(const Vector3<double> &center, double radius, NearParts parts,
                            SurfaceContact *found) const
  {
    (void) parts;
    return touches(center, radius, *found) ? 1 : 0;
  }

  /// Contacts tell curvature and velocity as well, and the part also where there is one contact at
  /// most. Of all others the surface is flat on the scale of particles, at rest in the frame of the
  /// body, and without parts unless there are several contacts. Each contact tells all of it, and laws of
  /// second order take the velocity for that of the whole step.
  virtual bool describes_surface() const { return false; }

  /// Of eight spheres the bits of those that the surface may be within; all that it is have theirs. To
  /// implement it pays for a surface that moves by itself, or one that costs much to ask: it is called for
  /// lists, with radii as wide as they must be, and of shapes with several contacts in every step,
  /// before find_contacts().
  virtual unsigned may_touch_eight(const EightSpheres &spheres) const
  {
    unsigned near = 0;
    const auto &x = spheres.center;
    if (most_contacts() > 1) return (1U << EightSpheres::width) - 1U;    // is_near() is to tell
    for (int k = 0; k < EightSpheres::width; k++)
      if (distance_bound({x[0][k], x[1][k], x[2][k]}) < spheres.radius[k]) near |= 1U << k;
    return near;
  }

  /// Is the surface nearer than `reach`? Appends the parts which are, nearest first, if the shape
  /// has any.
  virtual bool is_near(const Vector3<double> &center, double reach,
                       std::vector<NearPart> &parts) const
  {
    (void) parts;
    return distance_bound(center) < reach;
  }

  /// Of a part that is_near() has told, the nearest one to a sphere at `center`; `reach`: as there.
  virtual FlatPlace flat_place(const Vector3<double> &center, double reach, int part) const
  {
    (void) center;
    (void) reach;
    (void) part;
    return {};
  }

  /// Of eight spheres near nothing but flat places with a way, or parts of the same group, the bits
  /// of those that touch, whose contacts are filled in. `told` receives the bits of those of which
  /// this is all that find_contacts() would say, with the same bits; it is asked for the others.
  virtual unsigned touches_flat(const EightSpheres &spheres, const EightFlatPlaces &places,
                                EightContacts &contacts, unsigned &told) const
  {
    (void) spheres;
    (void) places;
    (void) contacts;
    told = 0;
    return 0;
  }

  /// For messages, of shapes with parts: the part through which the straight way leads that a
  /// center went, if the center was at `from` when `parts` were listed; or none.
  virtual Passage passage(const Vector3<double> &from, const Vector3<double> &to,
                          NearParts parts) const
  {
    (void) from;
    (void) to;
    (void) parts;
    return {};
  }

  /// For messages: the part which a sphere reaches but does not touch, because the center is on its
  /// side that does not act, if no other part is nearer; or -1.
  virtual int idle_part(const Vector3<double> &center, double radius, NearParts parts) const
  {
    (void) center;
    (void) radius;
    (void) parts;
    return -1;
  }

  /// Prefetches what find_contacts() will read of a part.
  virtual void prefetch(int part) const { (void) part; }

  /// Has so many parts that it prepares only those near the particles of this rank, see focus().
  virtual bool wants_focus() const { return false; }

  /// Until the next call all spheres that are asked for stay within `bounds`; parts that were
  /// listed before are no longer valid. Returns whether anything changed.
  virtual bool focus(const Eigen::AlignedBox3d &bounds)
  {
    (void) bounds;
    return false;
  }

  virtual bool thread_safe() const { return true; }

  /// All of it has one normal, apart from the sign.
  virtual bool has_one_normal() const { return false; }
  /// The same of each of its parts, so that a surface may run in a direction along it.
  virtual bool is_flat() const { return has_one_normal(); }
  /// Itself if it is a mesh, whose triangles can be looked at one by one.
  virtual MeshShape *as_mesh() { return nullptr; }

  /// For pictures: the surface as triangles; what is infinite ends at `visible`.
  virtual void tessellate(const Eigen::AlignedBox3d &visible,
                          std::vector<Triangle> &triangles) const
  {
    (void) visible;
    (void) triangles;
  }

  /// For particles with a shape: tells the surfaces that they touch, see surface_visitor.h. They touch
  /// none of a body that tells none, and scripts with both are refused.
  virtual void visit_surfaces(SurfaceVisitor &visitor) const { (void) visitor; }

  /// touches() for the first `count` of eight spheres: returns one bit for each, and fills the
  /// contacts whose bits are set. Called instead of touches(), so it must yield the same bits. To
  /// implement it pays for a shape that is computed in a few nanoseconds.
  virtual unsigned touches_eight(const EightSpheres &spheres, int count,
                                 EightContacts &contacts) const
  {
    unsigned touching = 0;
    for (int k = 0; k < count; k++) {
      SurfaceContact one;
      const auto &x = spheres.center;
      if (!touches({x[0][k], x[1][k], x[2][k]}, spheres.radius[k], one)) continue;
      touching |= 1U << k;
      contacts.set(k, one);
    }
    return touching;
  }
};

/// Puts contacts in the order that find_contacts() may return: deepest first, then by part.
inline void sort_contacts(SurfaceContact *found, int count)
{
  std::sort(found, found + count, [](const SurfaceContact &a, const SurfaceContact &b) {
    return a.overlap != b.overlap ? a.overlap > b.overlap : a.part < b.part;
  });
}

}    // namespace Talus

#endif
