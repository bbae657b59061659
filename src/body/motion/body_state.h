// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Where a large body is and how it moves: one record for prescribed, external, free and servo
// bodies, in memory and in restart files.

#ifndef TALUS_BODY_MOTION_BODY_STATE_H
#define TALUS_BODY_MOTION_BODY_STATE_H

#include "base/vector3.h"

namespace Talus {

/// Components as in LAMMPS: w, x, y, z.
struct Quaternion {
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;

  /// A turn by `angle` (radians) about the unit vector `axis`.
  static Quaternion turn(double angle, const Vector3<double> &axis);
  /// The turn that the angular velocity `spin` makes in the time dt.
  static Quaternion turn(const Vector3<double> &spin, double dt);
  Quaternion normalized() const;
  /// Angle of the turn that leads from `other` to this, 0 ... pi.
  double angle_from(const Quaternion &other) const;
  bool is_one() const { return w == 1.0 && x == 0.0 && y == 0.0 && z == 0.0; }
};

/// First b, then a.
Quaternion operator*(const Quaternion &a, const Quaternion &b);

/// Turns from the frame of the body to that of space, and back.
struct Rotation {
  double c[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};

  Rotation() = default;
  explicit Rotation(const Quaternion &q);
  Vector3<double> to_space(const Vector3<double> &v) const
  {
    return {c[0][0] * v.x + c[0][1] * v.y + c[0][2] * v.z,
            c[1][0] * v.x + c[1][1] * v.y + c[1][2] * v.z,
            c[2][0] * v.x + c[2][1] * v.y + c[2][2] * v.z};
  }
  Vector3<double> to_body(const Vector3<double> &v) const
  {
    return {c[0][0] * v.x + c[1][0] * v.y + c[2][0] * v.z,
            c[0][1] * v.x + c[1][1] * v.y + c[2][1] * v.z,
            c[0][2] * v.x + c[1][2] * v.y + c[2][2] * v.z};
  }
};

struct BodyState {
  Vector3<double> position{0.0, 0.0, 0.0};    ///< of the reference point
  Quaternion orientation;                     ///< 1 at the beginning
  Vector3<double> velocity{0.0, 0.0, 0.0};    ///< of the reference point
  Vector3<double> spin{0.0, 0.0, 0.0};        ///< angular velocity, axes of space

  /// position, orientation, velocity, spin: as in the vector of the fix and in restart files.
  static constexpr int size = 13;
  void to_array(double *a) const;
  static BodyState from_array(const double *a);
};

/// A body as its contacts see it in one step. `moves` false: space and body share one frame, the
/// state is not looked at.
struct BodyFrame {
  bool moves = false;
  BodyState state;
  Rotation rotation;
  bool turned = false;                      ///< the rotation is not 1
  Vector3<double> origin{0.0, 0.0, 0.0};    ///< the reference point in the frame of the body
  double inverse_mass = 0.0;                ///< 0: infinitely heavy

  void set(const BodyState &state);
  Vector3<double> to_space(const Vector3<double> &v) const
  {
    return turned ? rotation.to_space(v) : v;
  }
  Vector3<double> to_body(const Vector3<double> &v) const
  {
    return turned ? rotation.to_body(v) : v;
  }
  Vector3<double> point_to_body(const Vector3<double> &x) const
  {
    return moves ? to_body(x - state.position) + origin : x;
  }
  Vector3<double> point_to_space(const Vector3<double> &x) const
  {
    return moves ? to_space(x - origin) + state.position : x;
  }
  /// Velocity that a point of space has as a part of the body.
  Vector3<double> velocity_at(const Vector3<double> &x) const
  {
    return state.velocity + cross(state.spin, x - state.position);
  }
};

/// How far at most a point moved between two frames of one body, if it was within `reach` of the
/// reference point.
double largest_displacement(const BodyFrame &from, const BodyFrame &to, double reach);

}    // namespace Talus

#endif
