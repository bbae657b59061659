// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Narrow phase of convex bodies: contact points of a pair.
//
// Rounded bodies (at least one of both has a radius) whose cores are apart touch where parts of the
// cores are nearer than R = r_a + r_b, as sphero-polyhedra do (S. A. Galindo-Torres, Comput. Meth.
// Appl. Mech. Eng. 265, 10, 2013): each vertex of a core with the nearest point of the other core,
// and each pair of edges that are nearest to each other inside of both. A contact is one of two
// spheres at the nearest points; overlaps are continuous functions of the poses, and so are their
// derivatives. Forces follow from an energy, so that elastic impacts keep the sum: it is
//
//   sum over vertices of phi(o_v) + sum over pairs of edges of
//   phi(o_e) prod over the four ends k of (1 - 3 p_k^2 + 2 p_k^3), p_k = phi(o_k)/phi(o_e),
//
// phi(o) ~ o^(force_exponent + 1). So an edge contact fades that runs into a vertex, or whose ends
// are as deep (parallel edges), and nothing jumps. The derivatives by the overlaps, over phi', are
// the weights: 1 of a contact that is alone; a vertex at which an edge contact is about to end may
// have less than 0, and the edge then has more than 1.
//
// Where the cores overlap, or both bodies are sharp, the direction of least depth is found among
// the normals of faces and the cross products of edges (theorem of the separating axis). The faces
// that look along it most are projected along it; the contacts are the corners of the polygon that
// they have in common, each with its own depth, so that a flat cube does not rock. The weight of a
// corner is the angle by which the polygon turns there, over a right angle: 1 for those of a
// square, 4 for all of them, whatever their number; but all together bear as much as the deepest
// of them would with the weight 1.
//
// All numbers are computed in the frame of a from the pose of b relative to it, by the same code
// on all instruction sets. Functions are thread-safe; they use buffers of their thread.

#ifndef TALUS_SHAPE_COLLIDE_H
#define TALUS_SHAPE_COLLIDE_H

#include "shape/convex_contact.h"
#include "shape/convex_shape.h"

namespace Talus {

class Frustum;

enum class NarrowPhase {
  FEATURES,    ///< as above
  MPR          ///< one point per pair, by Minkowski Portal Refinement
};

/// Contacts of two convex bodies; returns whether there are any. The direction is read and written.
/// `force_exponent`: the elastic force of a contact grows as overlap^force_exponent (1: linear,
/// 3/2: hertz), which weights depend on.
bool collide(const ConvexShape &a, const Pose &pose_a, const ConvexShape &b, const Pose &pose_b,
             SeparatingDirection &direction, ConvexContacts &contacts,
             NarrowPhase method = NarrowPhase::FEATURES, double force_exponent = 1.0);

/// Contacts with what is not convex bodies. The body is a, and the other b: normals point to the
/// body. At most one contact with a sphere, at the point of the core that is nearest to its center;
/// a center inside the core is pushed out through the nearest face.
bool collide_sphere(const ConvexShape &shape, const Pose &pose, const Vector3<double> &center,
                    double radius, ConvexContacts &contacts);

/// Every vertex of the core below the plane normal . x = offset, or nearer than the radius: the
/// body is above it.
bool collide_plane(const ConvexShape &shape, const Pose &pose, const Vector3<double> &normal,
                   double offset, ConvexContacts &contacts);

/// Inside of a vessel, a body whose walls are flat or curved inward, such as a drum or a cone: every
/// vertex of the core that is nearer to a wall than the radius, or beyond. `vessel` must find the
/// walls near a sphere of any radius (LargeBodyShape::find_contacts()).
bool collide_vessel(const ConvexShape &shape, const Pose &pose, const LargeBodyShape &vessel,
                    ConvexContacts &contacts);

/// Outside of a cylinder or cone. Every vertex of the core that is nearer to it than the radius, or
/// inside; every edge whose nearest point is between its ends, with the weight that these leave;
/// and the rims of caps: at twelve places, and in between where they are deepest behind a face.
bool collide_round(const ConvexShape &shape, const Pose &pose, const Frustum &body,
                   ConvexContacts &contacts);

/// Sharp contacts: corners of the common polygon that are nearer to each other than this are one,
/// and those that are nearer to a vertex are named by it.
double merging_length(const ConvexShape &a, const ConvexShape &b);

}    // namespace Talus

#endif
