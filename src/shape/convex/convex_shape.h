// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The shape of convex particles: a polyhedron, the core, rounded by a radius >= 0 (its Minkowski
// sum with a ball). Immutable: one object serves all particles of a type, on all threads.

#ifndef TALUS_SHAPE_CONVEX_CONVEX_SHAPE_H
#define TALUS_SHAPE_CONVEX_CONVEX_SHAPE_H

#include "shape/convex/convex_core.h"
#include "shape/convex/mass_properties.h"
#include "shape/shape.h"

#include <string>
#include <vector>

namespace Talus {

class ConvexShape final : public Shape {
 public:
  /// A core with edges of these lengths along the axes, its center at the origin.
  static ConvexShape box(const Vector3<double> &edges, double radius);
  /// The convex hull of the vertices, in any order. Faces whose vertices are in one plane to
  /// flatness (over the least width of the hull) are one face; a vertex in a face or an edge
  /// is left out.
  static ConvexShape polyhedron(const std::vector<Vector3<double>> &vertices, double radius);
  /// The content of an STL file whose triangles enclose a convex body; coordinates are multiplied
  /// by `scale`.
  static ConvexShape stl(const std::string &content, double scale, double radius);
  static constexpr double flatness = 1.0e-5;

  // All throw std::runtime_error with a text that says what is wrong, with the number of the vertex
  // or triangle (from 1), and what to do: a radius that is negative or no number, lengths that are
  // not positive, coordinates that are no numbers, less than 4 vertices, a vertex given twice, all
  // in one plane, a vertex inside the hull of the others, an open mesh, a mesh that is not convex.

  /// In the frame in which it is stored: center of mass of the rounded body at the origin,
  /// principal axes along x, y, z, each where it was nearest to: a box stays as it was given.
  const ConvexCore &core() const { return polyhedron_; }
  double radius() const { return rounding; }

  const char *name() const override { return "convex"; }
  /// Of the core.
  const Pose &given_frame() const override { return offset; }

  // of the rounded body
  double volume() const override { return volume_; }
  Eigen::Vector3d principal_moments() const override { return moments; }
  double bounding_radius() const override { return polyhedron_.outer_radius() + rounding; }
  double inscribed_radius() const override { return polyhedron_.inner_radius() + rounding; }
  /// Of the sphere with the same volume.
  double volume_radius() const { return sphere_radius; }
  /// What the laws take for the radius of the surface where it is touched: the rounding radius, or
  /// volume_radius() of a sharp shape. Constant for a shape, so that forces are continuous where a
  /// contact passes from a face to an edge.
  double contact_radius() const override { return rounding > 0.0 ? rounding : sphere_radius; }
  /// Corners of the faces. On another sharp shape they count what the polygon turns there, over a right
  /// angle; those of a rounded one are contacts of their own.
  std::vector<HeldFace> held_faces() const override;

  /// The surface of the core as triangles that face outward, in its frame.
  std::vector<Triangle> core_surface() const;
  /// The same of a sharp shape.
  std::vector<Triangle> surface(int pieces) const override;

  double memory_usage() const override { return polyhedron_.memory_usage() + sizeof(*this); }

 private:
  ConvexShape(const ConvexCore &given, double radius);

  ConvexCore polyhedron_;
  double rounding, volume_, sphere_radius;
  Eigen::Vector3d moments;
  Pose offset;
};

}    // namespace Talus

#endif
