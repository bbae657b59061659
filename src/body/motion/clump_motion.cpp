// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/motion/clump_motion.h"

#include <cmath>

namespace Talus {

Turn operator*(const Turn &a, const Turn &b)
{
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z, a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}

Turn Turn::normalized() const
{
  const double scale = 1.0 / std::sqrt(w * w + x * x + y * y + z * z);
  return {scale * w, scale * x, scale * y, scale * z};
}

PrincipalAxes Turn::axes() const
{
  PrincipalAxes a;
  a.x = {w * w + x * x - y * y - z * z, 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)};
  a.y = {2.0 * (x * y - w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z + w * x)};
  a.z = {2.0 * (x * z + w * y), 2.0 * (y * z - w * x), w * w - x * x - y * y + z * z};
  return a;
}

/* In a usual step a grain turns by less than a degree: five terms of the series have all digits
   below an angle of 4 degrees. */

Turn turn_in(const Vector3<double> &omega, double dt)
{
  const double half = 0.5 * dt, square = half * half * dot(omega, omega);    // of half the angle
  double sine, cosine;                                                       // sine over the angle
  if (square < 1.0e-3) {
    const double a = square;
    sine = 1.0 - a / 6.0 * (1.0 - a / 20.0 * (1.0 - a / 42.0 * (1.0 - a / 72.0)));
    cosine = 1.0 - a / 2.0 * (1.0 - a / 12.0 * (1.0 - a / 30.0 * (1.0 - a / 56.0)));
  } else {
    const double angle = std::sqrt(square);
    sine = std::sin(angle) / angle;
    cosine = std::cos(angle);
  }
  const double scale = half * sine;
  return {cosine, scale * omega.x, scale * omega.y, scale * omega.z};
}

/* ---------------------------------------------------------------------- */

Vector3<double> ClumpState::omega_of(const PrincipalAxes &its_axes) const
{
  const Vector3<double> l = its_axes.to_body(momentum);
  const auto over = [](double value, double moment) {
    return moment == 0.0 ? 0.0 : value / moment;
  };
  return its_axes.to_space({over(l.x, inertia.x), over(l.y, inertia.y), over(l.z, inertia.z)});
}

void ClumpState::kick(double kick, const Vector3<double> &force, const Vector3<double> &torque)
{
  velocity = velocity + (kick / mass) * force;
  momentum = momentum + kick * torque;
}

void ClumpState::drift_extrapolated(double dt)
{
  position = position + dt * velocity;
  // q + h omega q/2
  const auto moved = [](const Turn &q, const Vector3<double> &w, double h) {
    const Turn rate = Turn{0.0, w.x, w.y, w.z} * q;
    const double s = 0.5 * h;
    return Turn{q.w + s * rate.w, q.x + s * rate.x, q.y + s * rate.y, q.z + s * rate.z}
        .normalized();
  };
  const Vector3<double> omega_at_first = omega_now();
  const Turn whole = moved(turn, omega_at_first, dt);
  const Turn half = moved(turn, omega_at_first, 0.5 * dt);
  omega = omega_of(half.axes());
  const Turn halves = moved(half, omega, 0.5 * dt);
  turn = Turn{2.0 * halves.w - whole.w, 2.0 * halves.x - whole.x, 2.0 * halves.y - whole.y,
              2.0 * halves.z - whole.z}
             .normalized();
  axes = turn.axes();
}

void ClumpState::drift_exponential(double dt)
{
  position = position + dt * velocity;
  const Turn half_way = turn_in(omega_now(), 0.5 * dt) * turn;
  turn = (turn_in(omega_of(half_way.normalized().axes()), dt) * turn).normalized();
  axes = turn.axes();
  omega = omega_now();
}

}    // namespace Talus
