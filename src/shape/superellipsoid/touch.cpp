// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/superellipsoid/touch.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

using Vector = Vector3<double>;
using Found = SuperellipsoidTouch::Found;

/* The zero of a slope that rises from below 0 at `low` to above 0 at `high`: secants that keep it enclosed (the
   method of Illinois), and halves where they are slow. */

template <class Slope>
double rising_zero(double low, double high, double at_low, double at_high, Slope slope)
{
  constexpr int most_steps = 80;
  const double enough = 1.0e-14 * (high - low);
  int side = 0;
  for (int step = 0; step < most_steps && high - low > enough; step++) {
    const bool halve = step % 3 == 2;
    const double middle =
        halve ? 0.5 * (low + high) : (low * at_high - high * at_low) / (at_high - at_low);
    const double there = slope(middle);
    if (there == 0.0) return middle;
    if (there < 0.0) {
      low = middle;
      at_low = there;
      if (side < 0 && !halve) at_high *= 0.5;
      side = -1;
    } else {
      high = middle;
      at_high = there;
      if (side > 0 && !halve) at_low *= 0.5;
      side = 1;
    }
  }
  return 0.5 * (low + high);
}

}    // namespace

Found SuperellipsoidTouch::in_space(const CommonNormal &found) const
{
  Found f;
  f.normal = at.direction_in_space(found.normal);
  f.place = at.point_in_space(found.of_a.place);
  f.middle = at.point_in_space(0.5 * (found.of_a.place + found.place_on_b));
  f.overlap = found.overlap;
  f.curvature = found.overlap > 0.0 ? shape.curvature_for_laws(found.of_a) : 0.0;
  return f;
}

Found SuperellipsoidTouch::plane(const Vector &normal, double offset) const
{
  const Superellipsoid::Point lowest = shape.at_normal(-at.direction_in_body(normal));
  Found f;
  f.normal = -normal;
  f.place = at.point_in_space(lowest.place);
  f.overlap = lowest.height - (dot(normal, at.position) - offset);
  f.middle = f.place + 0.5 * f.overlap * normal;
  f.curvature = f.overlap > 0.0 ? shape.curvature_for_laws(lowest) : 0.0;
  return f;
}

Found SuperellipsoidTouch::ball(const Vector &center, double radius) const
{
  return in_space(find_common_normal(shape, at.point_in_body(center), radius));
}

bool SuperellipsoidTouch::is_beyond(const Vector &x, double distance) const
{
  const Vector own = at.point_in_body(x), half = shape.half_axes();
  return std::abs(own.x) >= half.x + distance || std::abs(own.y) >= half.y + distance ||
         std::abs(own.z) >= half.z + distance;
}

bool SuperellipsoidTouch::is_beyond(const Vector &from, const Vector &along, double distance) const
{
  const Vector own = at.point_in_body(from), way = at.direction_in_body(along),
               half = shape.half_axes();
  const double x[3] = {own.x, own.y, own.z}, u[3] = {way.x, way.y, way.z},
               h[3] = {half.x + distance, half.y + distance, half.z + distance};
  double begin = 0.0, end = 1.0;    // of the part of the line that is between all sides
  for (int k = 0; k < 3; k++) {
    if (u[k] == 0.0) {
      if (std::abs(x[k]) >= h[k]) return true;
      continue;
    }
    const double one = (-h[k] - x[k]) / u[k], other = (h[k] - x[k]) / u[k];
    begin = std::max(begin, std::min(one, other));
    end = std::min(end, std::max(one, other));
  }
  if (begin >= end) return true;
  if (distance > 0.0 || !shape.is_ellipsoid()) return false;
  double uu = 0.0, ux = 0.0;    // in units of the half axes
  for (int k = 0; k < 3; k++) {
    uu += u[k] * u[k] / (h[k] * h[k]);
    ux += u[k] * x[k] / (h[k] * h[k]);
  }
  const double t = std::clamp(-ux / uu, 0.0, 1.0);
  return shape.gauge(own + t * way) >= 1.0;
}

SuperellipsoidTouch::AlongLine SuperellipsoidTouch::edge(const Vector &from, const Vector &along,
                                                         double r0, double r1, double slack) const
{
  AlongLine line;
  if (is_beyond(from, along, std::max(r0, r1))) return line;
  const auto look = [&](double t) {
    line.of_ball = from + t * along;
    line.deepest = ball(line.of_ball, r0 + t * (r1 - r0));
    line.touches |= line.deepest.overlap > 0.0;
    return dot(line.deepest.normal, along) - (r1 - r0);    // d(distance)/dt
  };
  const auto within = [&] {
    line.is_within = line.deepest.overlap > 0.0;
    return line;
  };
  const double flat = slack * length(along);
  const double at_low = look(0.0), low = -line.deepest.overlap;
  if (at_low >= 0.0) return at_low <= flat ? within() : line;
  const double at_high = look(1.0), high = -line.deepest.overlap;
  if (at_high <= 0.0) return at_high >= -flat ? within() : line;
  // the distance is above both tangents
  const double crossing = std::clamp((low - high + at_high) / (at_high - at_low), 0.0, 1.0);
  if (low + crossing * at_low >= 0.0) return line;
  look(rising_zero(0.0, 1.0, at_low, at_high, look));
  return within();
}

SuperellipsoidTouch::AlongLine SuperellipsoidTouch::circle(const Circle &rim) const
{
  constexpr int samples = 16;
  constexpr double turn = 6.28318530717958647693;
  AlongLine line;
  const Vector d = at.position - rim.center;
  double first = std::atan2(dot(d, rim.other), dot(d, rim.side));
  const auto gauge = [&](double angle) { return shape.gauge(at.point_in_body(rim.at(angle))); };
  double least = gauge(first);
  const double from = first;
  for (int k = 1; k < samples; k++) {
    const double angle = from + turn * k / samples, here = gauge(angle);
    if (here >= least) continue;
    least = here;
    first = angle;
  }
  const auto look = [&](double angle) {
    line.deepest = ball(rim.at(angle), 0.0);
    line.touches |= line.deepest.overlap > 0.0;
    return dot(line.deepest.normal, rim.at(angle + 0.25 * turn) - rim.center);
  };
  const auto within = [&] {
    line.is_within = line.deepest.overlap > 0.0;
    return line;
  };
  // away from `first` until the slope changes
  const double begin = look(first);
  if (begin == 0.0) return within();
  const double step =
      std::min(0.2, shape.bounding_radius() / rim.radius) * (begin < 0.0 ? 1.0 : -1.0);
  double last = first, slope_last = begin;
  for (int k = 1; k <= 2 * samples; k++) {
    const double next = first + k * step, slope = look(next);
    if (slope * begin <= 0.0) {
      const bool up = step > 0.0;
      look(rising_zero(up ? last : next, up ? next : last, up ? slope_last : slope,
                       up ? slope : slope_last, look));
      return within();
    }
    last = next;
    slope_last = slope;
  }
  return line;
}

ShapeContact shape_contact(const Found &found, double other_curvature, std::uint32_t name)
{
  ShapeContact contact;
  contact.normal = -found.normal;
  contact.position = found.middle;
  contact.overlap = found.overlap;
  contact.weight = 1.0;
  contact.curvature[0] = found.curvature;
  contact.curvature[1] = other_curvature;
  contact.name = name;
  return contact;
}

}    // namespace Talus
