// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The search for contact points of one particle with a mesh, for the parts of collide_mesh().

#ifndef TALUS_SHAPE_CONVEX_MESH_CONTACTS_H
#define TALUS_SHAPE_CONVEX_MESH_CONTACTS_H

#include "shape/convex/collide_mesh.h"
#include "shape/convex/nearest_lines.h"
#include "shape/convex/shared_energy.h"
#include "shape/near_triangles.h"

#include <utility>
#include <vector>

namespace Talus {

/// An edge of the particle.
struct ParticleEdge {
  int number;
  Segment segment;
  int end[2];
};

class MeshContacts {
  using Vector = Vector3<double>;
  using Ridge = MeshFeatures::Ridge;
  using MeshCorner = MeshFeatures::Corner;

 public:
  MeshContacts(const ConvexShape &particle_shape, const Pose &particle_pose, const SolidMesh &mesh,
               double exponent, std::vector<ShapeContact> &found_points) :
      core(particle_shape.core()),
      pose(particle_pose), surface(mesh.shape), features(mesh.features),
      detail(mesh.shape.near_detail()), radius(particle_shape.radius()),
      bound(particle_shape.bounding_radius()), force_exponent(exponent), points(found_points)
  {
  }

  /// Appends the points in ascending order of their names; returns whether there are any.
  bool find();

 private:
  void add_vertices();
  void add_in_front(int v, const Vector &x);
  void add_behind(int v, const Vector &x);
  void add_behind_edges(int v, const Vector &x, const NearTriangle &at,
                        const NearestPoint &nearest);
  void add_vertex_contact(int v, const Vector &x, const Vector &normal, double overlap, int t);
  bool stands_out(const MeshCorner &corner, const Vector &from_center, const Vector &normal,
                  bool overlaps) const;
  void add_corner(const MeshCorner &corner, int t);
  void add_edges(const Ridge &ridge, int t);
  bool turn_outward(const Ridge &ridge, const Vector &at, Vector &normal) const;
  /// The points of two edges that are nearest to each other.
  struct EdgePoint {
    const ParticleEdge *edge;
    Vector of_edge, of_ridge;
  };
  bool share_with_ends(const EdgePoint &at, const Ridge &ridge, double overlap) const;
  Vector plane_normal(int t) const
  {
    const TriangleMesh &mesh = surface.surface();
    return mesh.normal(mesh.plane_of(t));
  }
  bool is_beside(const Ridge &ridge, const Vector &normal) const;
  bool overlaps(const EdgePoint &at, const Ridge &ridge, int t, const Vector &normal) const;
  bool is_nearest(const Ridge &ridge, int t, const Vector &x, double slack, double depth) const;
  const NearTriangle *near_of(int triangle) const;
  double height_over(int triangle, const Vector &x) const;

  // What stands out touches along directions that lead away from one of its faces by more than this
  // (sine): not through a plate.
  static constexpr double through = 1.0e-9;

  const ConvexCore &core;
  const Pose &pose;
  const MeshShape &surface;
  const MeshFeatures &features;
  const MeshDetail &detail;
  const double radius, bound, force_exponent;
  std::vector<ShapeContact> &points;

  // of this thread, used again
  struct Buffers {
    std::vector<NearPart> parts;
    std::vector<NearTriangle> near;
    int of_vertices;                                    // how many contacts, the first
    std::vector<std::pair<int, int>> of_corner;         // vertex of the mesh, contact
    std::vector<const MeshFeatures::Ridge *> ridges;    // and triangles that they belong to
    std::vector<int> of_ridge;
    std::vector<ParticleEdge> edges;
    SharedEnergy energy;
  };
  static Buffers &buffers()
  {
    static thread_local Buffers of_thread;
    return of_thread;
  }
  Buffers &with = buffers();
};

}    // namespace Talus

#endif
