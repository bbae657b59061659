// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BODY_SHAPE_MESH_SHAPE_H
#define TALUS_BODY_SHAPE_MESH_SHAPE_H

#include "body/shape/large_body_shape.h"
#include "body/shape/mesh_check.h"
#include "body/shape/mesh_detail.h"
#include "body/shape/moving_vertices.h"
#include "body/shape/triangle_mesh.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace Talus {

/// On which side of a mesh spheres are touched: where the normals point, on the other side, on
/// both; or on both until somebody has found out which is meant.
enum class MeshSide { NORMALS, BACKS, BOTH, UNDECIDED };

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
/// All ranks hold the whole surface, but only what MeshDetail has of it is large: this is computed
/// only near the particles of a rank, and again when they or the body have moved further.
///
/// A sphere is touched if its center is on a side that acts, and nothing of the surface lies
/// between if both do: through a thin plate it does not feel the other face.
class MeshShape : public LargeBodyShape {
 public:
  /// `focused`: nothing is found before focus() has said where.
  MeshShape(TriangleMesh mesh, MeshSide side, bool focused = false);

  MeshShape(const MeshShape &) = delete;    // the detail knows the mesh by its address
  MeshShape &operator=(const MeshShape &) = delete;

  const TriangleMesh &surface() const { return mesh; }
  MeshSide side() const { return acting; }
  /// Between two steps.
  void set_side(MeshSide side) { acting = side; }
  /// Of a closed mesh that has been oriented: the side that is inside, or outside.
  MeshSide side_within(bool inside) const
  {
    return inside == mesh.faces_outward() ? MeshSide::BACKS : MeshSide::NORMALS;
  }
  /// Spheres may go from facet to facet of a hollow, see TriangleMesh::hollow_in_front(); or may once vertices
  /// have moved.
  bool has_jumps() const
  {
    return vertices || (acting != MeshSide::BACKS && mesh.hollow_in_front()) ||
           (acting != MeshSide::NORMALS && mesh.hollow_behind());
  }
  /// For messages: the file.
  const std::string &name() const { return file; }
  void set_name(const std::string &name) { file = name; }

  // ---- vertices that move

  /// They may from now on. Before anything is asked of the mesh; it is not focused then.
  void let_vertices_move();
  /// nullptr: they do not.
  const MovingVertices *moving() const { return vertices.get(); }
  MovingVertices *moving() { return vertices.get(); }
  /// Moves them as MovingVertices::guide() says, in a step of at most `way` (length). Returns "", or for
  /// people, why not.
  std::string guide(const MovingVertices::Places &places, const MovingVertices::Places *velocities,
                    int steps, double dt, double way);
  /// The state of its vertices is that of a restart file or snapshot.
  void vertices_are_restored();
  /// Of one step; see MovingVertices.
  void advance(bool order_2);
  /// Before parts are listed, so that is_near() finds fast what is near now. `with_planes`: from now on triangles
  /// that lie in one plane are known to, as particles with a shape need it.
  void settle(bool with_planes);
  /// Counts changes of the surface.
  std::int64_t num_changes() const { return changes; }

  /// What is called the part of a contact with a triangle: of a mesh at rest an image is its own one.
  int part_of(int triangle) const { return vertices ? triangle : mesh.own(triangle); }

  /// What parts are, after focus().
  const MeshDetail &near_detail() const { return *detail; }
  /// Triangles that may be found here.
  int size_of_detail() const { return detail ? detail->size() : 0; }
  double memory_usage() const;

  bool touches(const Vector3<double> &center, double radius,
               SurfaceContact &contact) const override;
  double distance_bound(const Vector3<double> &center) const override;
  Vector3<double> reference_point() const override { return mesh.center(); }
  double extent_from(const Vector3<double> &point) const override;
  bool is_flat() const override { return true; }
  MeshShape *as_mesh() override { return this; }
  int most_contacts() const override { return max_contacts; }
  int find_contacts(const Vector3<double> &center, double radius, NearParts parts,
                    SurfaceContact *found) const override;
  bool is_near(const Vector3<double> &center, double reach,
               std::vector<NearPart> &parts) const override;
  FlatPlace flat_place(const Vector3<double> &center, double reach, int part) const override;
  unsigned touches_flat(const EightSpheres &spheres, const EightFlatPlaces &places,
                        EightContacts &contacts, unsigned &told) const override;
  Passage passage(const Vector3<double> &from, const Vector3<double> &to,
                  NearParts parts) const override;
  int idle_part(const Vector3<double> &center, double radius, NearParts parts) const override;
  void prefetch(int part) const override { detail->prefetch(part); }
  bool wants_focus() const override { return !covers_all; }
  bool focus(const Eigen::AlignedBox3d &bounds) override;
  void tessellate(const Eigen::AlignedBox3d &visible,
                  std::vector<Triangle> &triangles) const override;
  void visit_surfaces(SurfaceVisitor &visitor) const override;

 private:
  void look_at(const Eigen::AlignedBox3d &bounds);
  bool contact_with(int t, const Vector3<double> &center, double radius, SurfaceContact &contact,
                    double &face_height) const;
  template <class Take>
  void each_minimum(const Vector3<double> &center, double radius, NearParts parts, Take take) const;
  int find_many(const Vector3<double> &center, double radius, NearParts parts,
                SurfaceContact *found) const;
  bool same_contact(const SurfaceContact &a, const SurfaceContact &b, double radius) const;
  int merge(SurfaceContact *raw, int count, const Vector3<double> &center, double radius,
            NearParts parts, SurfaceContact *found) const;
  bool is_hidden(const SurfaceContact &contact, const Vector3<double> &center, double radius,
                 NearParts parts) const;
  bool acts_at(double height) const;

  double farther(double reach) const { return vertices ? reach + vertices->way() : reach; }
  void find_planes();

  TriangleMesh mesh;
  std::unique_ptr<MovingVertices> vertices;    // if they move
  std::unique_ptr<MeshCheck> check;            // the same
  bool keeps_planes = false;                   // of more than one triangle, in each step
  std::int64_t changes = 0;
  std::unique_ptr<MeshDetail> detail;
  Eigen::AlignedBox3d cover;
  bool covers_all = false;
  MeshSide acting;
  std::string file = "?";
};

}    // namespace Talus

#endif
