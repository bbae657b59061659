// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPE_POSE_H
#define TALUS_SHAPE_POSE_H

#include "base/linear_algebra.h"

namespace Talus {

/// Where a body is: a point x of its frame is at rotation * x + position in space. Frames of shapes
/// have their origin at the center of mass and their axes along the principal axes.
struct Pose {
  Vector3<double> position{0.0, 0.0, 0.0};
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();

  Pose() = default;
  /// `orientation`: of unit length.
  Pose(const Vector3<double> &x, const Eigen::Quaterniond &orientation) :
      position(x), rotation(orientation.toRotationMatrix())
  {
  }

  Vector3<double> point_in_space(const Vector3<double> &x) const
  {
    return rotated(rotation, x) + position;
  }
  Vector3<double> point_in_body(const Vector3<double> &x) const
  {
    return rotated_back(rotation, x - position);
  }
  Vector3<double> direction_in_space(const Vector3<double> &d) const
  {
    return rotated(rotation, d);
  }
  Vector3<double> direction_in_body(const Vector3<double> &d) const
  {
    return rotated_back(rotation, d);
  }
};

/// Of b as a sees it: maps the frame of b to that of a.
inline Pose relative_pose(const Pose &a, const Pose &b)
{
  Pose seen;
  seen.position = a.point_in_body(b.position);
  seen.rotation = a.rotation.transpose() * b.rotation;
  return seen;
}

}    // namespace Talus

#endif
