// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Where a large body is and how it moves: one record for prescribed, external, free and servo
// bodies, in memory and in restart files.

#ifndef TALUS_BODY_MOTION_BODY_STATE_H
#define TALUS_BODY_MOTION_BODY_STATE_H

#include "base/linear_algebra.h"

namespace Talus {

class MovingVertices;    // body/shape/moving_vertices.h

/// Rotation by an angular velocity during dt.
Eigen::Quaterniond rotation_by(const Vector3<double> &omega, double dt);

struct BodyState {
  Vector3<double> position{0.0, 0.0, 0.0};                            ///< of the reference point
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();    ///< 1 at the beginning
  Vector3<double> velocity{0.0, 0.0, 0.0};                            ///< of the reference point
  Vector3<double> omega{0.0, 0.0, 0.0};    ///< angular velocity, axes of space

  /// position, orientation (w, x, y, z), velocity, omega: as in the vector of the fix and in
  /// calls of other programs.
  static constexpr int size = 13;
  void to_array(double *a) const;
  static BodyState from_array(const double *a);

  template <class Exchange> void exchange_state(Exchange &x)
  {
    x(position, orientation, velocity, omega);
  }
};

/// Half way between two poses; velocities are not set.
BodyState half_way_between(const BodyState &a, const BodyState &b);

/// Position, rotation and velocities of a body at one time.
struct BodyKinematics {
  Vector3<double> position{0.0, 0.0, 0.0};
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vector3<double> velocity{0.0, 0.0, 0.0}, omega{0.0, 0.0, 0.0};

  void set(const BodyState &state);
  /// In the frame of the body: velocity v of a point x, and an angular velocity, against the body.
  template <class Real>
  Vector3<Real> velocity_seen(const Vector3<Real> &v, const Vector3<Real> &x) const
  {
    const Vector3<Real> of_body =
        in_all_lanes<Real>(velocity) +
        cross(in_all_lanes<Real>(omega), x - in_all_lanes<Real>(position));
    return rotated_back(rotation, v - of_body);
  }
  template <class Real> Vector3<Real> omega_seen(const Vector3<Real> &w) const
  {
    return rotated_back(rotation, w - in_all_lanes<Real>(omega));
  }
};

/// State of a body in one step, as its contacts use it. `moves` false: space and body share one
/// frame, the state is not looked at. Vectors may be those of one contact (Real = double) or of
/// eight (Vec8).
struct BodyFrame {
  bool moves = false;
  BodyState state;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();    ///< from body to space
  bool turned = false;                                       ///< the rotation is not 1
  Vector3<double> origin{0.0, 0.0, 0.0};    ///< the reference point in the frame of the body
  double inverse_mass = 0.0;                ///< 0: infinitely heavy
  /// Only for the work of contacts of first order: what velocity and omega of the state lack of
  /// those at the time of the position, as ParticleRecords::change of particles; axes of space.
  Vector3<double> velocity_change{0.0, 0.0, 0.0}, omega_change{0.0, 0.0, 0.0};
  /// Only for laws of second order: at the time of the velocities of particles, and at that of
  /// positions with velocities that are as far ahead.
  BodyKinematics half_way, present;
  /// Velocity of the surface of a body at rest, like that of a conveyor belt, in the frame of the
  /// body; at each contact only its tangential part counts. `runs`: there is one.
  bool runs = false;
  Vector3<double> surface_velocity{0.0, 0.0, 0.0};
  /// Of a mesh whose vertices move, in space: `moves` is false then. nullptr: the surface is rigid.
  const MovingVertices *vertices = nullptr;

  void set(const BodyState &state);
  template <class Real> Vector3<Real> to_space(const Vector3<Real> &v) const
  {
    return turned ? rotated(rotation, v) : v;
  }
  template <class Real> Vector3<Real> to_body(const Vector3<Real> &v) const
  {
    return turned ? rotated_back(rotation, v) : v;
  }
  template <class Real> Vector3<Real> point_to_body(const Vector3<Real> &x) const
  {
    return moves ? to_body(x - in_all_lanes<Real>(state.position)) + in_all_lanes<Real>(origin) : x;
  }
  Vector3<double> point_to_space(const Vector3<double> &x) const
  {
    return moves ? to_space(x - origin) + state.position : x;
  }
  /// Velocity that a point of space has as a part of the body.
  template <class Real> Vector3<Real> velocity_at(const Vector3<Real> &x) const
  {
    return in_all_lanes<Real>(state.velocity) +
           cross(in_all_lanes<Real>(state.omega), x - in_all_lanes<Real>(state.position));
  }
};

/// How far at most a point moved between two frames of one body, if it was within `reach` of the
/// reference point.
double largest_displacement(const BodyFrame &from, const BodyFrame &to, double reach);

}    // namespace Talus

#endif
