// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Volume, center and inertia of polyhedra, sharp or rounded: closed formulas, exact to rounding.

#ifndef TALUS_SHAPE_CONVEX_MASS_PROPERTIES_H
#define TALUS_SHAPE_CONVEX_MASS_PROPERTIES_H

#include "base/linear_algebra.h"
#include "shape/convex/convex_core.h"

namespace Talus {

/// Integrals over a body of density 1.
struct MassProperties {
  double volume = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  /// Integral of (x - center)(x - center)^T.
  Eigen::Matrix3d second_moment = Eigen::Matrix3d::Zero();

  /// About the center; of density 1: mass / volume times this for a body of that mass.
  Eigen::Matrix3d inertia() const
  {
    return second_moment.trace() * Eigen::Matrix3d::Identity() - second_moment;
  }
};

/// Of the Minkowski sum of the core with a ball of that radius >= 0. It consists of the core (as
/// signed tetrahedra), a prism on each face, a sector of a cylinder along each edge, and a sector
/// of the ball at each vertex, whose moments follow from the theorem of Gauss on the sphere.
MassProperties mass_properties(const ConvexCore &core, double radius);

/// Axes and moments: `axes` is a rotation whose columns are the principal axes, each beside that of
/// the frame to which it is nearest. Where moments are equal (to 1e-9) the axes of the frame are
/// kept as far as they can: the frame of a box stays as it was.
struct PrincipalFrame {
  Eigen::Matrix3d axes;
  Eigen::Vector3d moments;
};
PrincipalFrame principal_axes(const Eigen::Matrix3d &inertia);

}    // namespace Talus

#endif
