// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/motion/body_state.h"

#include <algorithm>

namespace Talus {

Eigen::Quaterniond rotation_by(const Vector3<double> &omega, double dt)
{
  const double speed = length(omega);
  if (!(speed > 0.0)) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(dt * speed, to_eigen(1.0 / speed * omega)));
}

void BodyState::to_array(double *a) const
{
  const Eigen::Quaterniond &q = orientation;
  const double values[size] = {position.x, position.y, position.z, q.w(),   q.x(),   q.y(),  q.z(),
                               velocity.x, velocity.y, velocity.z, omega.x, omega.y, omega.z};
  std::copy(values, values + size, a);
}

BodyState BodyState::from_array(const double *a)
{
  BodyState s;
  s.position = {a[0], a[1], a[2]};
  s.orientation = {a[3], a[4], a[5], a[6]};
  s.velocity = {a[7], a[8], a[9]};
  s.omega = {a[10], a[11], a[12]};
  return s;
}

BodyState half_way_between(const BodyState &a, const BodyState &b)
{
  BodyState s;
  s.position = 0.5 * (a.position + b.position);
  s.orientation = a.orientation.slerp(0.5, b.orientation).normalized();
  return s;
}

void BodyKinematics::set(const BodyState &s)
{
  position = s.position;
  rotation = s.orientation.toRotationMatrix();
  velocity = s.velocity;
  omega = s.omega;
}

void BodyFrame::set(const BodyState &s)
{
  state = s;
  turned = s.orientation.coeffs() != Eigen::Quaterniond::Identity().coeffs();
  rotation = s.orientation.toRotationMatrix();
}

double largest_displacement(const BodyFrame &from, const BodyFrame &to, double reach)
{
  if (!from.moves && !to.moves) return 0.0;
  return length(to.state.position - from.state.position) +
         reach * to.state.orientation.angularDistance(from.state.orientation);
}

}    // namespace Talus
