// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/mesh_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace Talus {
namespace {

constexpr int max_minima = 64;    // of one sphere, before they are merged

std::vector<Bounds> boxes_of(const TriangleMesh &mesh)
{
  std::vector<Bounds> boxes;
  for (int t = 0; t < mesh.size(); t++) {
    const Triangle &tri = mesh.triangle(t);
    Bounds box{tri.corner[0], tri.corner[0]};
    for (const Vector3<double> &p : tri.corner) {
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
    boxes.push_back(box);
  }
  return boxes;
}

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

MeshShape::MeshShape(TriangleMesh m, bool both) :
    mesh(std::move(m)), tree(boxes_of(mesh)), two_sided(both)
{
}

bool MeshShape::contact_with(int t, const Vector3<double> &centre, double radius,
                             SurfaceContact &contact) const
{
  const NearestPoint nearest = mesh.nearest(t, centre);
  if (nearest.square >= radius * radius) return false;
  double height;
  if (!mesh.is_local_minimum(t, nearest, height)) return false;
  if (height < 0.0 && !two_sided) return false;
  const double distance = std::sqrt(nearest.square);
  contact.overlap = radius - distance;
  contact.part = t;
  if (nearest.feature == NearestPoint::FACE || distance == 0.0)
    contact.normal = height < 0.0 ? -mesh.normal(t) : mesh.normal(t);    // also in the plane
  else
    contact.normal = 1.0 / distance * nearest.away;
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

int MeshShape::merge(SurfaceContact *raw, int count, double radius, SurfaceContact *found) const
{
  sort_contacts(raw, count);
  int kept = 0;
  for (int k = 0; k < count && kept < max_contacts; k++) {
    const bool known = std::any_of(found, found + kept, [&](const SurfaceContact &other) {
      return same_contact(raw[k], other, radius);
    });
    if (!known) found[kept++] = raw[k];
  }
  return kept;
}

int MeshShape::find_contacts(const Vector3<double> &centre, double radius, NearParts parts,
                             SurfaceContact *found) const
{
  SurfaceContact raw[max_minima], contact;
  int count = 0;
  for (const NearPart *p = parts.begin; p != parts.end; p++)
    if (contact_with(p->part, centre, radius, contact)) keep(raw, count, contact);
  if (count == 0) return 0;
  return merge(raw, count, radius, found);
}

bool MeshShape::is_near(const Vector3<double> &centre, double reach,
                        std::vector<NearPart> &parts) const
{
  const std::size_t before = parts.size();
  tree.visit_near(centre, reach, [&](int t) {
    const double square = mesh.nearest(t, centre).square;
    if (square < reach * reach) parts.push_back({t, std::sqrt(square)});
  });
  const auto first = parts.begin() + static_cast<std::ptrdiff_t>(before);
  std::sort(first, parts.end(), [](const NearPart &a, const NearPart &b) {
    return a.distance != b.distance ? a.distance < b.distance : a.part < b.part;
  });
  return parts.size() > before;
}

bool MeshShape::touches(const Vector3<double> &centre, double radius, SurfaceContact &contact) const
{
  std::vector<NearPart> parts;
  if (!is_near(centre, radius, parts)) return false;
  SurfaceContact found[max_contacts];
  const int count =
      find_contacts(centre, radius, {parts.data(), parts.data() + parts.size()}, found);
  if (count) contact = found[0];
  return count > 0;
}

double MeshShape::distance_bound(const Vector3<double> &centre) const
{
  // a first guess that is doubled until something is found
  const Vector3<double> span = tree.bounds().high - tree.bounds().low;
  double reach = 0.01 * std::sqrt(dot(span, span));
  double least = std::numeric_limits<double>::infinity();
  while (std::isinf(least)) {
    tree.visit_near(centre, reach,
                    [&](int t) { least = std::min(least, mesh.nearest(t, centre).square); });
    if (least >= reach * reach) least = std::numeric_limits<double>::infinity();
    reach *= 2.0;
  }
  return std::sqrt(least);
}

void MeshShape::tessellate(const Bounds & /*visible*/, std::vector<Triangle> &triangles) const
{
  for (int t = 0; t < mesh.size(); t++) triangles.push_back(mesh.triangle(t));
}

}    // namespace Talus
