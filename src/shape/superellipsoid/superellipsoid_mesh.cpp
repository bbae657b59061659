// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Superellipsoids and meshes. A face is touched where the shape is lowest, if that is over it; an edge that stands
// out, at the point that is deepest in the shape; and a corner, each if the normal is one of those of the part. What
// belongs to what is told by signs: on which side of the edges of a triangle a point is, to which faces a direction
// leads. No distance is compared with another one that is the same but for rounding.
//
// Faces that meet at a ridge in the shape are one place, as those of a convex body: of such contacts the least deep
// counts. In a hollow that is cut into facets the deepest one of a smooth patch does, as for spheres.

#include "body/shape/mesh_shape.h"
#include "shape/mesh_features.h"
#include "shape/near_triangles.h"
#include "shape/superellipsoid/superellipsoid_contacts.h"
#include "shape/superellipsoid/touch.h"

#include <algorithm>
#include <utility>

namespace Talus {
namespace {

using Vector = Vector3<double>;
using Found = SuperellipsoidTouch::Found;
using Ridge = MeshFeatures::Ridge;
using MeshCorner = MeshFeatures::Corner;

constexpr double at_border = 1.0e-9;    // sine, see superellipsoid_solids.cpp
constexpr double at_joint = 2.0e-6;     // pieces of one edge may be bent so much where they meet

/// A face, edge or corner that reaches into the shape; of a face, all triangles of one plane.
struct Candidate {
  enum Kind { FACE, EDGE, CORNER };
  Found found;
  Kind kind;
  int triangle, plane;
  ContactParts parts;
  std::uint32_t surface;    ///< the second half of its name
  bool is_over = false;     ///< of a face: the lowest point is, as seen along the normal,
  bool is_cut = false;      ///< and the straight line from there to the center goes through it
  bool counts = false;
};

/// Which planes are in one place.
class Places {
 public:
  void clear() { links.clear(); }
  void join(int plane, int other)
  {
    if (plane != other) links.emplace_back(plane, other);
  }
  /// When all are joined; then of() is the same for all planes of a place.
  void settle()
  {
    planes.clear();
    for (const auto &[a, b] : links) planes.insert(planes.end(), {a, b});
    std::sort(planes.begin(), planes.end());
    planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
    leader = planes;
    for (const auto &[a, b] : links) {
      const int one = of(a), other = of(b);
      leader[index(std::max(one, other))] = std::min(one, other);
    }
  }
  int of(int plane) const
  {
    if (!std::binary_search(planes.begin(), planes.end(), plane)) return plane;
    while (leader[index(plane)] != plane) plane = leader[index(plane)];
    return plane;
  }

 private:
  std::ptrdiff_t index(int plane) const
  {
    return std::lower_bound(planes.begin(), planes.end(), plane) - planes.begin();
  }
  std::vector<std::pair<int, int>> links;
  std::vector<int> planes, leader;    // ascending; of each a lower one of its place, or itself
};

class WithMesh {
 public:
  WithMesh(const PlacedSuperellipsoid &a, const MeshSurface &mesh, ShapeContacts &found_contacts) :
      touch(a.geometry, a.pose), center(a.pose.position), reach(a.geometry.bounding_radius()),
      rounding(1.0e-14 * (length(center) + reach)), surface(*mesh.shape), features(*mesh.features),
      contacts(found_contacts)
  {
  }

  void find()
  {
    if (!find_near_triangles(surface, center, reach, with.parts, with.near)) return;
    with.candidates.clear();
    with.places.clear();
    with.edges_of.clear();
    add_faces();
    const MeshDetail &detail = surface.near_detail();
    for (const NearPart &part : with.parts) {
      const int t = detail.number(part.part);
      features.visit_ridges(t, [&](const Ridge &ridge) { add_ridge(ridge, t); });
      features.visit_corners(t, [&](const MeshCorner &corner) { add_corner(corner, t); });
    }
    if (with.candidates.empty()) return;
    settle_faces();
    keep_one_of_each_place();
    add_contacts();
  }

 private:
  /* ---- faces ---- */

  /// A plane of which triangles are near, and where the shape is below it.
  struct Below {
    int plane = -1;
    double side = 0.0;
    Found lowest{};
    Vector crossing{};
  };

  void add_faces()
  {
    Below below;
    for (const NearTriangle &one : with.near) {
      const int plane = surface.surface().plane_of(one.triangle);
      if (plane != below.plane || one.side != below.side) {
        below.plane = plane;
        below.side = one.side;
        below.lowest = touch.plane(one.normal, one.offset);
        if (below.lowest.overlap > 0.0)
          below.crossing = touch.crossing(below.lowest, one.height(center));
      }
      if (below.lowest.overlap > 0.0) add_face(one, below);
    }
  }
  void add_face(const NearTriangle &one, const Below &below)
  {
    const Vector normal = one.side * one.normal;
    const bool is_over = is_in(one.triangle, normal, below.lowest.place),
               is_cut = is_in(one.triangle, normal, below.crossing);
    auto &all = with.candidates;
    auto face = std::find_if(all.rbegin(), all.rend(),
                             [&](const Candidate &other) { return other.plane == below.plane; });
    if (face == all.rend()) {
      all.push_back({below.lowest, Candidate::FACE, one.triangle, below.plane, ContactParts::WHOLE,
                     patch_of(one.triangle)});
      face = all.rbegin();
    }
    if (is_over ? !face->is_over : is_cut && !face->is_over && !face->is_cut)
      face->triangle = one.triangle;
    face->is_over |= is_over;
    face->is_cut |= is_cut;
  }
  std::uint32_t patch_of(int t) const
  {
    return static_cast<std::uint32_t>(surface.surface().patch(t));
  }
  /// Seen along the normal of its plane, is the point in the triangle? At its border by rounding, perhaps: then it is
  /// in that beside it as well.
  bool is_in(int t, const Vector &normal, const Vector &x) const
  {
    const Triangle triangle = surface.surface().triangle(t);
    for (int k = 0; k < 3; k++) {
      const Vector &from = triangle.corner[k], edge = triangle.corner[(k + 1) % 3] - from;
      const double side = dot(cross(edge, x - from), normal);
      if (side < 0.0 && side * side > rounding * rounding * dot(edge, edge)) return false;
    }
    return true;
  }
  /* A face whose edges are touched is a part of that place. Another one counts if the lowest point is over it and it is
     touched; or if it is all that is touched. */
  void settle_faces()
  {
    auto &all = with.candidates;
    const auto &edges_of = with.edges_of;
    bool is_found = false;
    for (Candidate &one : all) {
      one.counts = one.kind != Candidate::FACE ||
                   std::find(edges_of.begin(), edges_of.end(), one.plane) != edges_of.end() ||
                   (one.is_over && is_touched(one));
      is_found |= one.counts;
    }
    all.erase(
        std::remove_if(all.begin(), all.end(),
                       [&](const Candidate &one) { return is_found ? !one.counts : !one.is_cut; }),
        all.end());
  }
  /* The line from the center meets it; or a point of it is known that is in the shape; or the line meets the surface
     elsewhere, and both are one place. */
  bool is_touched(const Candidate &face)
  {
    if (face.is_cut || touch.is_inside(face.found.other())) return true;
    for (const NearTriangle &near : with.near)
      if (surface.near_detail().is_between(near.part, center, face.found.place)) {
        with.places.join(face.plane, surface.surface().plane_of(near.triangle));
        return true;
      }
    return false;
  }

  /* ---- edges and corners ---- */

  void add_ridge(const Ridge &ridge, int t)
  {
    const Vector d = center - ridge.from;
    const double along = std::clamp(dot(d, ridge.along) / dot(ridge.along, ridge.along), 0.0, 1.0);
    const Vector away = d - along * ridge.along;
    if (dot(away, away) >= reach * reach) return;
    if (!may_act(ridge)) return;
    const SuperellipsoidTouch::AlongLine line =
        touch.edge(ridge.from, ridge.along, 0.0, 0.0, at_joint);
    if (!line.touches) return;
    for (const int plane : ridge.planes)
      if (plane >= 0) with.edges_of.push_back(plane);
    if (ridge.planes[1] >= 0) with.places.join(ridge.planes[0], ridge.planes[1]);
    if (!line.is_within) return;
    const Vector m = -line.deepest.normal;
    if (dot(m, ridge.inward[0]) > at_border || dot(m, ridge.inward[1]) > at_border) return;
    if (!acts(m, ridge.outward)) return;
    // that of two facets of a smooth patch is named by the patch, on which friction goes on
    const bool is_smooth =
        ridge.planes[1] >= 0 && patch_of(ridge.planes[0]) == patch_of(ridge.planes[1]);
    with.candidates.push_back({line.deepest, Candidate::EDGE, t, ridge.planes[0],
                               is_smooth ? ContactParts::WHOLE : ContactParts::EDGES,
                               is_smooth ? patch_of(t) : ridge.name});
  }
  void add_corner(const MeshCorner &corner, int t)
  {
    if (touch.is_beyond(corner.place, 0.0)) return;
    const Found found = touch.ball(corner.place, 0.0);
    if (!(found.overlap > 0.0)) return;
    const Vector m = -found.normal;
    const TriangleMesh &mesh = surface.surface();
    bool is_of_corner = true;
    features.visit_around(corner.vertex, [&](int triangle) {
      for (const int v : mesh.corners(triangle).vertex) {
        const Vector side = mesh.vertex(v) - corner.place;
        if (dot(m, side) > at_border * length(side)) is_of_corner = false;
      }
    });
    if (!is_of_corner || !acts(m, corner.outward)) return;
    const int plane = mesh.plane_of(t);
    features.visit_around(corner.vertex,
                          [&](int triangle) { with.places.join(plane, mesh.plane_of(triangle)); });
    const bool is_smooth = is_in_smooth_patch(corner.vertex, t);
    with.candidates.push_back(
        {found, Candidate::CORNER, t, plane,
         is_smooth ? ContactParts::WHOLE : ContactParts::VERTEX_OF_B,
         is_smooth ? patch_of(t) : static_cast<std::uint32_t>(corner.vertex)});
  }
  /// Inside of one, not at its border.
  bool is_in_smooth_patch(int vertex, int t) const
  {
    bool is_smooth = true;
    features.visit_around(vertex, [&](int triangle) {
      is_smooth &= patch_of(triangle) == patch_of(t);
      const int *const corner = surface.surface().corners(triangle).vertex;
      for (int k = 0; k < 3; k++)
        if (corner[k] == vertex || corner[(k + 1) % 3] == vertex)
          is_smooth &= features.edge_kind(triangle, k) != EdgeKind::BOUNDARY;
    });
    return is_smooth;
  }
  /// A ridge is one from in front, a valley from behind: where that side acts, and the center is on it.
  bool may_act(const Ridge &ridge) const
  {
    if (ridge.edge_kind == EdgeKind::BOUNDARY) return true;
    const bool in_front = ridge.edge_kind == EdgeKind::RIDGE;
    if (surface.side() == (in_front ? MeshSide::BACKS : MeshSide::NORMALS)) return false;
    const Vector away = center - ridge.from;
    const TriangleMesh &mesh = surface.surface();
    return std::any_of(ridge.planes, ridge.planes + 2, [&](int t) {
      return t < 0 || (dot(away, mesh.normal(t)) > 0.0) == in_front;
    });
  }
  /// The normal says from which side of its triangles something that stands out is touched: does that act?
  bool acts(const Vector &normal, const Vector &outward) const
  {
    const double in_front = dot(normal, outward);
    if (in_front == 0.0) return true;
    return surface.side() != (in_front > 0.0 ? MeshSide::BACKS : MeshSide::NORMALS);
  }

  /* ---- what counts ---- */

  /// Where the normal of an edge is that of a face but for rounding it is the face.
  double rank(const Candidate &one) const
  {
    return one.kind == Candidate::FACE ? one.found.overlap : one.found.overlap + rounding;
  }
  void keep_one_of_each_place()
  {
    auto &all = with.candidates;
    if (all.size() < 2) return;
    with.places.settle();
    for (Candidate &one : all) one.plane = with.places.of(one.plane);
    std::sort(all.begin(), all.end(), [&](const Candidate &a, const Candidate &b) {
      if (rank(a) != rank(b)) return rank(a) < rank(b);
      return a.triangle != b.triangle ? a.triangle < b.triangle : a.kind < b.kind;
    });
    auto kept = all.begin();
    for (const Candidate &one : all)
      if (std::none_of(all.begin(), kept,
                       [&](const Candidate &other) { return other.plane == one.plane; }))
        *kept++ = one;
    all.erase(kept, all.end());
  }
  /// Of contacts with faces of one smooth patch, or with pieces of one edge, whose normals are nearly the same the
  /// deepest.
  void add_contacts()
  {
    auto &all = with.candidates;
    for (auto one = all.rbegin(); one != all.rend(); ++one) {
      one->counts = std::none_of(all.rbegin(), one, [&](const Candidate &deeper) {
        return deeper.counts && deeper.parts == one->parts && deeper.surface == one->surface &&
               (deeper.kind == Candidate::FACE) == (one->kind == Candidate::FACE) &&
               dot(one->found.normal, deeper.found.normal) > TriangleMesh::smooth_cosine;
      });
      if (one->counts) add_contact(*one);
    }
  }
  void add_contact(const Candidate &one)
  {
    const std::uint32_t name =
        one.parts == ContactParts::WHOLE
            ? place_name((1.0 / length(one.found.place - center)) * (one.found.place - center))
            : contact_name(one.parts, 0, 0);
    ShapeContact contact = shape_contact(one.found, 0.0, name);
    contact.surface = one.surface;
    contact.part = surface.part_of(one.triangle);
    contact.is_named_by_place = one.parts == ContactParts::WHOLE;
    contacts.points.push_back(contact);
  }

  // of this thread, used again
  struct Buffers {
    std::vector<NearPart> parts;
    std::vector<NearTriangle> near;
    std::vector<Candidate> candidates;
    std::vector<int> edges_of;    // planes of which edges are touched
    Places places;
  };
  static Buffers &buffers()
  {
    static thread_local Buffers of_thread;
    return of_thread;
  }

  const SuperellipsoidTouch touch;
  const Vector center;
  const double reach, rounding;    // lengths; the latter that of coordinates
  const MeshShape &surface;
  const MeshFeatures &features;
  ShapeContacts &contacts;
  Buffers &with = buffers();
};

}    // namespace

bool superellipsoid_and_mesh(const PlacedSuperellipsoid &a, const Placed<MeshSurface> &b,
                             const CollisionRequest & /*request*/, ShapeContacts &contacts)
{
  contacts.clear();
  WithMesh(a, b.geometry, contacts).find();
  return !contacts.points.empty();
}

}    // namespace Talus
