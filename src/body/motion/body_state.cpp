// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/motion/body_state.h"

#include <algorithm>
#include <cmath>

namespace Talus {

Quaternion Quaternion::turn(double angle, const Vector3<double> &axis)
{
  const double s = std::sin(0.5 * angle);
  return {std::cos(0.5 * angle), s * axis.x, s * axis.y, s * axis.z};
}

Quaternion Quaternion::turn(const Vector3<double> &spin, double dt)
{
  const double speed = std::sqrt(dot(spin, spin));
  return speed > 0.0 ? turn(dt * speed, 1.0 / speed * spin) : Quaternion{};
}

Quaternion Quaternion::normalized() const
{
  const double s = 1.0 / std::sqrt(w * w + x * x + y * y + z * z);
  return {s * w, s * x, s * y, s * z};
}

double Quaternion::angle_from(const Quaternion &o) const
{
  const Quaternion difference = *this * Quaternion{o.w, -o.x, -o.y, -o.z};
  const double sine = std::sqrt(difference.x * difference.x + difference.y * difference.y +
                                difference.z * difference.z);
  return 2.0 * std::atan2(sine, std::fabs(difference.w));
}

Quaternion operator*(const Quaternion &a, const Quaternion &b)
{
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z, a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}

Rotation::Rotation(const Quaternion &q) :
    c{{q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z, 2.0 * (q.x * q.y - q.w * q.z),
       2.0 * (q.x * q.z + q.w * q.y)},
      {2.0 * (q.x * q.y + q.w * q.z), q.w * q.w - q.x * q.x + q.y * q.y - q.z * q.z,
       2.0 * (q.y * q.z - q.w * q.x)},
      {2.0 * (q.x * q.z - q.w * q.y), 2.0 * (q.y * q.z + q.w * q.x),
       q.w * q.w - q.x * q.x - q.y * q.y + q.z * q.z}}
{
}

void BodyState::to_array(double *a) const
{
  const double values[size] = {position.x,    position.y,    position.z,    orientation.w,
                               orientation.x, orientation.y, orientation.z, velocity.x,
                               velocity.y,    velocity.z,    spin.x,        spin.y,
                               spin.z};
  std::copy(values, values + size, a);
}

BodyState BodyState::from_array(const double *a)
{
  BodyState s;
  s.position = {a[0], a[1], a[2]};
  s.orientation = {a[3], a[4], a[5], a[6]};
  s.velocity = {a[7], a[8], a[9]};
  s.spin = {a[10], a[11], a[12]};
  return s;
}

void BodyFrame::set(const BodyState &s)
{
  state = s;
  turned = !s.orientation.is_one();
  rotation = Rotation(s.orientation);
}

double largest_displacement(const BodyFrame &from, const BodyFrame &to, double reach)
{
  if (!from.moves && !to.moves) return 0.0;
  const Vector3<double> shift = to.state.position - from.state.position;
  return std::sqrt(dot(shift, shift)) +
         reach * to.state.orientation.angle_from(from.state.orientation);
}

}    // namespace Talus
