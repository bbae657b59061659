// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Narrow phase of convex bodies: contact points of a pair.
//
// Rounded bodies (at least one of both has a radius) whose cores are apart touch where parts of the
// cores are nearer than R = r_a + r_b, as sphero-polyhedra do (S. A. Galindo-Torres, Comput. Meth.
// Appl. Mech. Eng. 265, 10, 2013): each vertex of a core with the nearest point of the other core,
// and each pair of edges that are nearest to each other inside of both. A contact is one of two
// spheres at the nearest points; overlaps are continuous functions of the poses, and so are their
// derivatives but where an edge contact begins beside its end. Forces follow from an energy, so that
// elastic impacts keep the sum: phi(o) of each vertex, and of each pair of edges phi(o) times what
// the contacts of its four ends leave, see shared_energy.h. So an edge contact fades that runs into
// a vertex, or whose ends are as deep (parallel edges), and nothing jumps. A vertex beside edge
// contacts has less weight than 1, down to -1/9 for one, and the edge has more.
//
// Where the cores overlap, or both bodies are sharp, the direction of least depth is found among
// the normals of faces and the cross products of edges (theorem of the separating axis). The energy
// is phi(o + R) of one overlap o of both bodies, see mean_overlap.h: as large as the depth where a
// corner is in a face or two edges cross, and larger along an edge or a face. Force and torque are
// its derivatives, one force along an axis. It is shared by the corners of the polygon that the two
// faces have in common, all with the least depth as their overlap, so that a flat cube has friction
// and damping at each of its corners; weights make up for the difference between o and the depth.
// The energy is continuous where the direction jumps, forces are not.
//
// All numbers are computed in the frame of a from the pose of b relative to it, by the same code
// on all instruction sets. Functions are thread-safe; they use buffers of their thread.

#ifndef TALUS_SHAPE_CONVEX_COLLIDE_H
#define TALUS_SHAPE_CONVEX_COLLIDE_H

#include "shape/collisions.h"
#include "shape/convex/convex_shape.h"

namespace Talus {

class Frustum;

/// MPR is that of libccd; false if Talus was built without it. Then MPR must not be asked for.
bool has_mpr();

/// Contacts of two convex bodies; returns whether there are any. The direction is read and written.
/// `force_exponent`: the elastic force of a contact grows as overlap^force_exponent (1: linear,
/// 3/2: hertz), which weights depend on.
bool collide(const ConvexShape &a, const Pose &pose_a, const ConvexShape &b, const Pose &pose_b,
             SeparatingDirection &direction, ShapeContacts &contacts,
             NarrowPhase method = NarrowPhase::FEATURES, double force_exponent = 1.0);

/// Contacts with what is not convex bodies. The body is a, and the other b: normals point to the
/// body. At most one contact with a sphere, at the point of the core that is nearest to its center;
/// a center inside the core is pushed out through the nearest face.
bool collide_sphere(const ConvexShape &shape, const Pose &pose, const Vector3<double> &center,
                    double radius, ShapeContacts &contacts);

/// Every vertex of the core below the plane normal . x = offset, or nearer than the radius: the
/// body is above it.
bool collide_plane(const ConvexShape &shape, const Pose &pose, const Vector3<double> &normal,
                   double offset, ShapeContacts &contacts);

/// Inside of a vessel, a body whose walls are flat or curved inward, such as a drum or a cone: every
/// vertex of the core that is nearer to a wall than the radius, or beyond. `vessel` must find the
/// walls near a sphere of any radius (LargeBodyShape::find_contacts()).
bool collide_vessel(const ConvexShape &shape, const Pose &pose, const LargeBodyShape &vessel,
                    ShapeContacts &contacts);

/// Outside of a cylinder or cone. Every vertex of the core that is nearer to it than the radius, or
/// inside; every edge whose nearest point is between its ends; and the rims of caps: at twelve
/// places, and in between where they are deepest behind a face. An edge shares its energy with its
/// ends, and the last ones with the two places and the vertices and edges of the face. Forces are
/// minus the gradient of that energy, also of an edge that is deepest where a cap and the mantle are
/// as near: along the mean of both normals that is perpendicular to it.
bool collide_round(const ConvexShape &shape, const Pose &pose, const Frustum &body,
                   ShapeContacts &contacts, double force_exponent = 1.0);

/// Sharp contacts: corners of the common polygon that are nearer to a vertex than this are named by
/// it.
double merging_length(const ConvexShape &a, const ConvexShape &b);

}    // namespace Talus

#endif
