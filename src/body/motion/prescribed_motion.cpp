// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/motion/prescribed_motion.h"

#include <cmath>

namespace Talus {
namespace {
const double two_pi = 2.0 * std::acos(-1.0);
}

PrescribedMotion::PrescribedMotion(Kind k, const Vector3<double> &v, double r,
                                   const Vector3<double> &p) :
    kind(k),
    vector(v), rate(r), point(p)
{
}

PrescribedMotion PrescribedMotion::linear(const Vector3<double> &velocity)
{
  return {Kind::LINEAR, velocity, 0.0, {0.0, 0.0, 0.0}};
}

PrescribedMotion PrescribedMotion::wiggle(const Vector3<double> &amplitude, double period)
{
  return {Kind::WIGGLE, amplitude, two_pi / period, {0.0, 0.0, 0.0}};
}

PrescribedMotion PrescribedMotion::rotate(const Vector3<double> &point, const Vector3<double> &axis,
                                          double period)
{
  return {Kind::ROTATE, axis, two_pi / period, point};
}

BodyState PrescribedMotion::at(double time, const Vector3<double> &start) const
{
  BodyState state;
  switch (kind) {
  case Kind::LINEAR:
    state.position = start + time * vector;
    state.velocity = vector;
    break;
  case Kind::WIGGLE:
    state.position = start + std::sin(rate * time) * vector;
    state.velocity = rate * std::cos(rate * time) * vector;
    break;
  case Kind::ROTATE:
    state.orientation = Eigen::AngleAxisd(rate * time, to_eigen(vector));
    state.omega = rate * vector;
    state.position = point + rotated(state.orientation.toRotationMatrix(), start - point);
    state.velocity = cross(state.omega, state.position - point);
    break;
  }
  return state;
}

double MotionClock::read(std::int64_t now, double dt_now)
{
  if (dt == 0.0) dt = dt_now;
  if (dt_now != dt && now > step) {
    time += static_cast<double>(now - 1 - step) * dt;
    step = now - 1;
    dt = dt_now;
  }
  return time + static_cast<double>(now - step) * dt;
}

}    // namespace Talus
