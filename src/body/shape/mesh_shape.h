// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BODY_SHAPE_MESH_SHAPE_H
#define TALUS_BODY_SHAPE_MESH_SHAPE_H

#include "body/shape/large_body_shape.h"
#include "body/shape/mesh_detail.h"
#include "body/shape/triangle_mesh.h"

#include <memory>

namespace Talus {

/// A surface of triangles.
///
/// A sphere touches the surface wherever the distance from its center has a local minimum that is
/// smaller than its radius. This depends on the surface alone, not on how it is cut into triangles:
/// an edge or a corner between triangles of one plane is no such point, a foot on a face is one. On
/// surfaces that are curved inward like a basin, cut into flat facets, several facets of one smooth
/// patch are near: of contacts in one patch whose normals differ by less than
/// TriangleMesh::smooth_angle only the deepest counts, so that the force stays continuous when the
/// sphere goes from facet to facet.
///
/// All ranks hold the whole surface, but only what MeshDetail has of it is large: this is made for
/// the neighborhood of the particles of a rank, and anew when they or the body have gone further.
///
/// One-sided, only spheres whose center is on the side of the normals are touched.
class MeshShape : public LargeBodyShape {
 public:
  /// `focused`: nothing is found before focus() has said where.
  MeshShape(TriangleMesh mesh, bool two_sided, bool focused = false);

  MeshShape(const MeshShape &) = delete;    // the detail knows the mesh by its address
  MeshShape &operator=(const MeshShape &) = delete;

  const TriangleMesh &surface() const { return mesh; }
  /// Triangles that may be found here.
  int size_of_detail() const { return detail ? detail->size() : 0; }
  double memory_usage() const;

  bool touches(const Vector3<double> &center, double radius,
               SurfaceContact &contact) const override;
  double distance_bound(const Vector3<double> &center) const override;
  Vector3<double> reference_point() const override { return mesh.center(); }
  int most_contacts() const override { return max_contacts; }
  int find_contacts(const Vector3<double> &center, double radius, NearParts parts,
                    SurfaceContact *found) const override;
  bool is_near(const Vector3<double> &center, double reach,
               std::vector<NearPart> &parts) const override;
  void prefetch(int part) const override { detail->prefetch(part); }
  bool wants_focus() const override { return !covers_all; }
  bool focus(const Eigen::AlignedBox3d &bounds) override;
  void tessellate(const Eigen::AlignedBox3d &visible,
                  std::vector<Triangle> &triangles) const override;

 private:
  void look_at(const Eigen::AlignedBox3d &bounds);
  bool contact_with(int t, const Vector3<double> &center, double radius, SurfaceContact &contact,
                    double &face_height) const;
  template <class Take>
  void each_minimum(const Vector3<double> &center, double radius, NearParts parts, Take take) const;
  int find_many(const Vector3<double> &center, double radius, NearParts parts,
                SurfaceContact *found) const;
  bool same_contact(const SurfaceContact &a, const SurfaceContact &b, double radius) const;
  int merge(SurfaceContact *raw, int count, double radius, SurfaceContact *found) const;

  TriangleMesh mesh;
  std::unique_ptr<MeshDetail> detail;
  Eigen::AlignedBox3d cover;
  bool covers_all = false;
  bool two_sided;
};

}    // namespace Talus

#endif
