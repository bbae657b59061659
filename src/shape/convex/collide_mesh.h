// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact points of a convex particle, sharp or rounded, with a mesh. Three kinds, each with the
// same formulas whether cores are apart or overlap, the overlap being the sum of the rounding
// radius and the depth of the core:
//
//   a vertex of the particle   touches what a sphere of the rounding radius about it touches (see
//                              MeshShape); one behind the surface is pushed out through the nearest
//                              triangle, or through all those of the valley in which it is
//   a corner of the mesh       touches the nearest point of the core
//   an edge of each            touch at the nearest points of the two lines, and share the energy
//                              with the contacts of their ends, see shared_energy.h: with those of
//                              the particle as far as the edge of the mesh is not in front of what
//                              they touch, for then this is another part of the surface
//
// So the contacts of a rounded particle with a convex mesh are those with a convex body, weights
// included.
//
// Edges and corners of the mesh are those of its surface, see MeshFeatures: a floor of many
// triangles yields the contacts of a plane. As a sphere, a particle touches a triangle only if its
// center is on a side of it that acts; if both do, it is pushed to the side of its center.

#ifndef TALUS_SHAPE_CONVEX_COLLIDE_MESH_H
#define TALUS_SHAPE_CONVEX_COLLIDE_MESH_H

#include "body/shape/mesh_shape.h"
#include "shape/convex/convex_shape.h"
#include "shape/mesh_features.h"
#include "shape/shape_contact.h"

namespace Talus {

/// A mesh and its features, in the frame of the mesh.
struct SolidMesh {
  const MeshShape &shape;    ///< has been told to look at all of itself
  const MeshFeatures &features;
};

/// Contacts of the body a with the mesh; returns whether there are any. Their `surface` is set.
/// `force_exponent`: see collide().
bool collide_mesh(const ConvexShape &shape, const Pose &pose, const SolidMesh &mesh,
                  ShapeContacts &contacts, double force_exponent = 1.0);

}    // namespace Talus

#endif
