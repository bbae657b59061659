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
//   an edge of each            touch at the nearest points of the two lines, with the weight that
//                              their ends leave, 1 - (overlap of the deepest end)/(overlap)
//
// Weights are never negative: a particle that reaches over an edge falls as soon as its center does.
// Unlike those of two rounded shapes (collide.h) they follow from no energy.
//
// Edges and corners of the mesh are those of its surface, see MeshFeatures: a floor of many
// triangles yields the contacts of a plane. As a sphere, a particle touches a triangle only if its
// center is on a side of it that acts; if both do, it is pushed to the side of its center.

#ifndef TALUS_SHAPE_COLLIDE_MESH_H
#define TALUS_SHAPE_COLLIDE_MESH_H

#include "body/shape/mesh_shape.h"
#include "shape/convex_contact.h"
#include "shape/convex_shape.h"
#include "shape/mesh_features.h"

namespace Talus {

/// A mesh and its features, in the frame of the mesh.
struct SolidMesh {
  const MeshShape &shape;    ///< has been told to look at all of itself
  const MeshFeatures &features;
};

/// Contacts of the body a with the mesh; returns whether there are any. Their `surface` is set.
bool collide_mesh(const ConvexShape &shape, const Pose &pose, const SolidMesh &mesh,
                  ConvexContacts &contacts);

}    // namespace Talus

#endif
