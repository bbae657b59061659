// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The shape of particles. Derive from this class to add one, say in the table of collisions.h what
// it touches, and how it is read from a script in shape/contact/shape_list.h; all else, such as laws,
// motion, ranks, restart files and pictures, is that of all shapes. shape/convex is one, and
// tests/added_shape another.
//
// Everything is in the frame of the shape, whose origin is the center of mass and whose axes are the
// principal ones; lengths are in the units of the script. Immutable: one object serves all particles
// of a type, on all threads.

#ifndef TALUS_SHAPE_SHAPE_H
#define TALUS_SHAPE_SHAPE_H

#include "base/linear_algebra.h"
#include "body/shape/large_body_shape.h"
#include "shape/geometry.h"
#include "shape/pose.h"

#include <vector>

namespace Talus {

/// Points of a surface at which others may touch it at the same time: the corners of a face, or one
/// point of a round surface.
struct HeldFace {
  struct Point {
    Vector3<double> arm;    ///< from the center of mass
    double weight;          ///< what it counts for the face of another shape; 1 for a large body
  };
  Vector3<double> normal;    ///< outward, a unit vector
  std::vector<Point> points;
};

class Shape : public Geometry {
 public:
  /// For messages: the word by which scripts know it.
  virtual const char *name() const = 0;

  /// Of the sphere around the origin that contains the shape, and of the largest one about the origin
  /// inside it (length).
  virtual double bounding_radius() const = 0;
  virtual double inscribed_radius() const = 0;
  virtual double volume() const = 0;
  /// About x, y, z for density 1 (length^5): multiply by mass/volume.
  virtual Eigen::Vector3d principal_moments() const = 0;
  /// Maps this frame to that in which the script gives the shape.
  virtual const Pose &given_frame() const
  {
    static const Pose same;
    return same;
  }

  /// For estimates of the time step: the radius of the surface (length) as its contacts tell the laws,
  /// see ShapeContact::curvature, of several the smallest; and where it may be held at the same time.
  virtual double contact_radius() const = 0;
  virtual std::vector<HeldFace> held_faces() const = 0;

  /// For pictures: the surface as triangles that face outward, arcs being divided into about that many
  /// pieces (>= 1) per right angle.
  virtual std::vector<Triangle> surface(int pieces) const = 0;

  virtual double memory_usage() const = 0;    ///< bytes
};

}    // namespace Talus

#endif
