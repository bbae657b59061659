// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/mesh_shape.h"

#include "body/shape/surface_visitor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace Talus {
namespace {

constexpr int max_minima = 64;    // of one sphere, before they are merged

constexpr int max_planes = 4;    // of one sphere that are known to be touched

// A cover is longer at each end, by this share, than what it must contain, so that it is not
// recomputed soon; old and new are joined if this does not make it larger than so many times the
// new one.
constexpr double spare = 0.1;
constexpr double joins = 4.0;

/// Keeps the deepest.
void keep(SurfaceContact *raw, int &count, const SurfaceContact &contact)
{
  if (count < max_minima) {
    raw[count++] = contact;
    return;
  }
  SurfaceContact *flattest =
      std::min_element(raw, raw + count, [](const SurfaceContact &a, const SurfaceContact &b) {
        return a.overlap < b.overlap;
      });
  if (contact.overlap > flattest->overlap) *flattest = contact;
}

}    // namespace

MeshShape::MeshShape(TriangleMesh m, MeshSide side, bool focused) :
    mesh(std::move(m)), cover(mesh.bounds()), acting(side)
{
  if (!focused) look_at(mesh.bounds());
}

void MeshShape::look_at(const Eigen::AlignedBox3d &bounds)
{
  cover = bounds;
  covers_all = cover.contains(mesh.bounds());
  detail.reset();    // both would be a waste of memory
  detail = std::make_unique<MeshDetail>(mesh, cover);
}

bool MeshShape::focus(const Eigen::AlignedBox3d &bounds)
{
  if (bounds.isEmpty()) return false;    // no particles: nothing will be asked
  if (detail && (covers_all || cover.contains(bounds))) return false;
  const Eigen::Vector3d more = spare * bounds.sizes();
  Eigen::AlignedBox3d wide(bounds.min() - more, bounds.max() + more);
  if (detail && cover.merged(wide).volume() <= joins * wide.volume()) wide.extend(cover);
  look_at(wide);
  return true;
}

double MeshShape::memory_usage() const
{
  return mesh.memory_usage() + (detail ? detail->memory_usage() : 0.0) +
         (vertices ? vertices->memory_usage() + check->memory_usage() : 0.0);
}

/* A center in the surface is on any side. */

bool MeshShape::acts_at(double height) const
{
  if (acting == MeshSide::NORMALS) return !(height < 0.0);
  return acting != MeshSide::BACKS || !(height > 0.0);
}

/* `face_height`: of a contact with the inside of a triangle. */

bool MeshShape::contact_with(int t, const Vector3<double> &center, double radius,
                             SurfaceContact &contact, double &face_height) const
{
  const NearestPoint nearest = detail->nearest(t, center);
  if (nearest.square >= radius * radius) return false;
  double height;
  if (!detail->is_local_minimum(t, nearest, height)) return false;
  if (!acts_at(height)) return false;
  const double distance = std::sqrt(nearest.square);
  const bool on_face = nearest.feature == NearestPoint::FACE;
  face_height = on_face ? std::fabs(height) : 0.0;
  contact.overlap = radius - distance;
  contact.part = part_of(detail->number(t));
  if (on_face || distance == 0.0) {
    const Vector3<double> n = on_face ? nearest.normal : detail->normal(t);
    contact.normal = height < 0.0 || (height == 0.0 && acting == MeshSide::BACKS)
                         ? -n
                         : n;    // also in the plane
  } else {
    contact.normal = 1.0 / distance * nearest.away;
  }
  return true;
}

/* Two minima that are one: facets of a smooth patch, or an edge and a face on it that rounding has
   both admitted. */

bool MeshShape::same_contact(const SurfaceContact &a, const SurfaceContact &b, double radius) const
{
  const double cosine = dot(a.normal, b.normal);
  if (mesh.patch(a.part) == mesh.patch(b.part) && cosine > TriangleMesh::smooth_cosine) return true;
  return cosine > 1.0 - 1.0e-12 && std::fabs(a.overlap - b.overlap) < 1.0e-9 * radius;
}

/* Behind another triangle. */

bool MeshShape::is_hidden(const SurfaceContact &contact, const Vector3<double> &center,
                          double radius, NearParts parts) const
{
  constexpr double just_before = 1.0 - 1.0e-6;
  const double distance = just_before * (radius - contact.overlap);
  const Vector3<double> to = center - distance * contact.normal;
  return std::any_of(parts.begin, parts.end, [&](const NearPart &p) {
    return part_of(detail->number(p.part)) != contact.part &&
           detail->is_between(p.part, center, to);
  });
}

int MeshShape::merge(SurfaceContact *raw, int count, const Vector3<double> &center, double radius,
                     NearParts parts, SurfaceContact *found) const
{
  const bool may_hide = acting == MeshSide::BOTH || acting == MeshSide::UNDECIDED;
  sort_contacts(raw, count);
  int kept = 0;
  for (int k = 0; k < count && kept < max_contacts; k++) {
    const bool known = std::any_of(found, found + kept, [&](const SurfaceContact &other) {
      return same_contact(raw[k], other, radius);
    });
    if (known || (k && may_hide && is_hidden(raw[k], center, radius, parts))) continue;
    found[kept++] = raw[k];
  }
  return kept;
}

/* Where the foot on a plane is known, the other triangles of this plane add nothing: what else they
   touch has nearly the same normal, is of the same patch and less deep. */

template <class Take>
void MeshShape::each_minimum(const Vector3<double> &center, double radius, NearParts parts,
                             Take take) const
{
  SurfaceContact contact;
  int planes[max_planes], num_planes = 0;
  for (const NearPart *p = parts.begin; p != parts.end; p++) {
    if (std::find(planes, planes + num_planes, p->group) != planes + num_planes) continue;
    double height;
    if (!contact_with(p->part, center, radius, contact, height)) continue;
    take(contact);
    if (height > TriangleMesh::smooth_cosine * radius && num_planes < max_planes)
      planes[num_planes++] = p->group;
  }
}

int MeshShape::find_contacts(const Vector3<double> &center, double radius, NearParts parts,
                             SurfaceContact *found) const
{
  int count = 0;
  each_minimum(center, radius, parts, [&](const SurfaceContact &contact) {
    if (count < max_contacts) found[count] = contact;
    count++;
  });
  if (count < 2) return count;
  if (count <= max_contacts) return merge(found, count, center, radius, parts, found);
  return find_many(center, radius, parts, found);
}

int MeshShape::find_many(const Vector3<double> &center, double radius, NearParts parts,
                         SurfaceContact *found) const
{
  SurfaceContact raw[max_minima];
  int count = 0;
  each_minimum(center, radius, parts,
               [&](const SurfaceContact &contact) { keep(raw, count, contact); });
  return merge(raw, count, center, radius, parts, found);
}

/* Parts are sorted by their distance from `from`. */

Passage MeshShape::passage(const Vector3<double> &from, const Vector3<double> &to,
                           NearParts parts) const
{
  const double way = farther(length(to - from));
  for (const NearPart *p = parts.begin; p != parts.end && p->distance <= way; p++) {
    Vector3<double> start = from;    // as the triangle sees it
    if (vertices) start = from + vertices->gone(mesh.corners(detail->number(p->part)).vertex[0]);
    if (detail->is_between(p->part, start, to))
      return {mesh.own(detail->number(p->part)), acts_at(dot(start - to, detail->normal(p->part)))};
  }
  return {};
}

int MeshShape::idle_part(const Vector3<double> &center, double radius, NearParts parts) const
{
  double least = radius * radius;
  int idle = -1;
  for (const NearPart *p = parts.begin; p != parts.end; p++) {
    const NearestPoint nearest = detail->nearest(p->part, center);
    double height;
    if (nearest.square >= least || !detail->is_local_minimum(p->part, nearest, height)) continue;
    least = nearest.square;
    idle = acts_at(height) ? -1 : mesh.own(detail->number(p->part));
  }
  return idle;
}

bool MeshShape::is_near(const Vector3<double> &center, double reach,
                        std::vector<NearPart> &parts) const
{
  const std::size_t before = parts.size();
  if (!detail) return false;
  detail->visit_near(center, farther(reach), [&](int t) {
    const double square = detail->nearest(t, center).square;
    const int number = detail->number(t), group = vertices ? number : mesh.plane_of(number);
    if (square < reach * reach) parts.push_back({t, group, std::sqrt(square)});
  });
  const auto first = parts.begin() + static_cast<std::ptrdiff_t>(before);
  std::sort(first, parts.end(), [](const NearPart &a, const NearPart &b) {
    return a.distance != b.distance ? a.distance < b.distance : a.part < b.part;
  });
  return parts.size() > before;
}

bool MeshShape::touches(const Vector3<double> &center, double radius, SurfaceContact &contact) const
{
  std::vector<NearPart> parts;
  if (!is_near(center, radius, parts)) return false;
  SurfaceContact found[max_contacts];
  const int count =
      find_contacts(center, radius, {parts.data(), parts.data() + parts.size()}, found);
  if (count) contact = found[0];
  return count > 0;
}

double MeshShape::distance_bound(const Vector3<double> &center) const
{
  // a first guess that is doubled until something is found
  double reach = 0.01 * mesh.bounds().diagonal().norm();
  double least = std::numeric_limits<double>::infinity();
  while (std::isinf(least)) {
    detail->visit_near(center, farther(reach),
                       [&](int t) { least = std::min(least, detail->nearest(t, center).square); });
    if (least >= reach * reach) least = std::numeric_limits<double>::infinity();
    reach *= 2.0;
  }
  return std::sqrt(least);
}

double MeshShape::extent_from(const Vector3<double> &point) const
{
  const Eigen::Vector3d p = to_eigen(point);
  return (p - mesh.bounds().min()).cwiseAbs().cwiseMax((p - mesh.bounds().max()).cwiseAbs()).norm();
}

void MeshShape::tessellate(const Eigen::AlignedBox3d & /*visible*/,
                           std::vector<Triangle> &triangles) const
{
  for (int t = 0; t < mesh.num_own(); t++) triangles.push_back(mesh.triangle(t));
}

void MeshShape::visit_surfaces(SurfaceVisitor &visitor) const
{
  visitor.mesh({std::shared_ptr<void>(), this});    // not the owner
}

}    // namespace Talus
