// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BODY_MESH_SHAPE_H
#define TALUS_BODY_MESH_SHAPE_H

#include "body/box_tree.h"
#include "body/large_body_shape.h"
#include "body/triangle_mesh.h"

namespace Talus {

/// A surface of triangles.
///
/// A sphere touches the surface wherever the distance from its centre has a local minimum that is
/// smaller than its radius. This depends on the surface alone, not on how it is cut into triangles:
/// an edge or a corner between triangles of one plane is no such point, a foot on a face is one. On
/// surfaces that are curved inward like a basin, cut into flat facets, several facets of one smooth
/// patch are near: of contacts in one patch whose normals differ by less than
/// TriangleMesh::smooth_angle only the deepest counts, so that the force stays continuous when the
/// sphere goes from facet to facet.
///
/// One-sided, only spheres whose centre is on the side of the normals are touched.
class MeshShape : public LargeBodyShape {
 public:
  MeshShape(TriangleMesh mesh, bool two_sided);

  const TriangleMesh &surface() const { return mesh; }
  double memory_usage() const { return mesh.memory_usage() + tree.memory_usage(); }

  bool touches(const Vector3<double> &centre, double radius,
               SurfaceContact &contact) const override;
  double distance_bound(const Vector3<double> &centre) const override;
  Vector3<double> reference_point() const override { return mesh.centre(); }
  bool one_contact() const override { return false; }
  int find_contacts(const Vector3<double> &centre, double radius, NearParts parts,
                    SurfaceContact *found) const override;
  bool is_near(const Vector3<double> &centre, double reach,
               std::vector<NearPart> &parts) const override;
  void call_ahead(int part) const override { mesh.call_ahead(part); }
  void tessellate(const Bounds &visible, std::vector<Triangle> &triangles) const override;

 private:
  bool contact_with(int t, const Vector3<double> &centre, double radius,
                    SurfaceContact &contact) const;
  bool same_contact(const SurfaceContact &a, const SurfaceContact &b, double radius) const;
  int merge(SurfaceContact *raw, int count, double radius, SurfaceContact *found) const;

  TriangleMesh mesh;
  BoxTree tree;
  bool two_sided;
};

}    // namespace Talus

#endif
