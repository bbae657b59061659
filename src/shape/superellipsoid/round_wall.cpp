// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/superellipsoid/round_wall.h"

#include <algorithm>
#include <cmath>

namespace Talus {

using Vector = Vector3<double>;

RoundWall::RoundWall(const Placed<Superellipsoid> &placed, const InwardWall &of_body) :
    shape(placed), wall(of_body), size(placed.geometry.bounding_radius())
{
  const Vector d = shape.pose.position - wall.point;
  along = dot(d, wall.axis);
  const Vector flat = d - along * wall.axis;
  from_axis = length(flat);
  away = from_axis > 0.0 ? (1.0 / from_axis) * flat : wall.side;
  around = cross(wall.axis, away);
  own[0] = shape.pose.direction_in_body(away);
  own[1] = shape.pose.direction_in_body(around);
  own[2] = shape.pose.direction_in_body(wall.axis);
}

Vector RoundWall::normal_at(const Direction &at) const
{
  return wall.normal_away * (at.c * away + at.s * around) + wall.normal_along * wall.axis;
}

/* Places that are touched are seen from the axis in the directions of the shape, and the sphere around it goes beyond the
   plane there. Above 1: none. */

double RoundWall::least_cosine() const
{
  const double needed = wall.radius * wall.normal_away - along * wall.normal_along - size;
  const double most = from_axis * wall.normal_away;
  if (needed >= most) return 2.0;
  const double beyond = needed > -most ? needed / most : -1.0;
  if (!(from_axis > size)) return beyond;
  const double sine = size / from_axis;
  return std::max(beyond, std::sqrt((1.0 - sine) * (1.0 + sine)));
}

RoundWall::Sample RoundWall::sample(const Direction &at) const
{
  const Vector tangent = at.c * own[1] - at.s * own[0];
  const Vector normal =
      wall.normal_away * (at.c * own[0] + at.s * own[1]) + wall.normal_along * own[2];
  const Superellipsoid::Point point = shape.geometry.at_normal(normal);
  return {at,
          wall.normal_away * (at.c * from_axis - wall.radius) + wall.normal_along * along +
              point.height,
          dot(tangent, point.place) - at.s * from_axis, bend(point, tangent, at)};
}

/* While the normal turns by n' the point goes by B^-1 n' in the tangent plane, see PointWithNormal. */

double RoundWall::bend(const Superellipsoid::Point &point, const Vector &tangent,
                       const Direction &at) const
{
  const Vector other = cross(point.normal, tangent);
  const double tt = point.curvature(tangent, tangent), mixed = point.curvature(tangent, other),
               oo = point.curvature(other, other);
  const double from_the_axis = at.c * from_axis + dot(at.c * own[0] + at.s * own[1], point.place);
  return wall.normal_away * oo / (tt * oo - mixed * mixed) - from_the_axis;
}

/* Between two directions that are at most 90 degrees apart; beside these, where the slope may vanish in a minimum. */

void RoundWall::sample(const Direction &from, const Direction &to, Samples &samples) const
{
  constexpr double beside = 1.0e-3;
  alignas(64) double cosine[lanes], sine[lanes];
  for (int k = 0; k < lanes; k++) {
    const double part = std::clamp(static_cast<double>(k) / (lanes - 1), beside, 1.0 - beside);
    const double x = from.c + part * (to.c - from.c), y = from.s + part * (to.s - from.s);
    const double inverse = 1.0 / std::sqrt(x * x + y * y);
    cosine[k] = inverse * x;
    sine[k] = inverse * y;
  }
  const Vec8 c = load8(cosine), s = load8(sine);
  const auto turned = [&](double Vector::*d) {
    return splat<Vec8>(wall.normal_away) *
               (c * splat<Vec8>(own[0].*d) + s * splat<Vec8>(own[1].*d)) +
           splat<Vec8>(wall.normal_along * own[2].*d);
  };
  const Vector3<Vec8> normal{turned(&Vector::x), turned(&Vector::y), turned(&Vector::z)};
  const PointWithNormal<Vec8> point = shape.geometry.formulas().at_normal(normal);
  const auto slope = [&](double Vector::*d, Vec8 place) {
    return (c * splat<Vec8>(own[1].*d) - s * splat<Vec8>(own[0].*d)) * place;
  };
  const Vec8 slopes = slope(&Vector::x, point.place.x) + slope(&Vector::y, point.place.y) +
                      slope(&Vector::z, point.place.z) - s * splat<Vec8>(from_axis);
  const double middle = wall.normal_along * along - wall.normal_away * wall.radius;
  const Vec8 beyond =
      c * splat<Vec8>(wall.normal_away * from_axis) + point.height + splat<Vec8>(middle);
  for (int k = 0; k < lanes; k++) samples[k] = {{cosine[k], sine[k]}, beyond[k], slopes[k]};
}

/* The support function of the shape as seen from the axis is sublinear: between two directions it is below the greater value
   over the cosine of half of their angle. */

bool RoundWall::may_touch_between(const Sample &one, const Sample &next) const
{
  const double cosine = one.at.c * next.at.c + one.at.s * next.at.s;
  const double over_half = 1.0 / std::sqrt(0.5 * (1.0 + cosine));
  const double most =
      from_axis + size + 2.0 * std::fabs(wall.normal_along) * (std::fabs(along) + size);
  return std::max(one.beyond, next.beyond) + (over_half - 1.0) * most > 0.0;
}

/* Ascends with the angle from -180 to 180 degrees. */

double RoundWall::order(const Direction &at)
{
  return std::signbit(at.s) ? at.c - 1.0 : 1.0 - at.c;
}

/* Where a component of the normal changes its sign in the frame of the shape, and enough besides that no part of the circle
   between two is above 90 degrees; in ascending order of the angle from -180 to 180 degrees. */

int RoundWall::cuts(const Arc &arc, Direction *cut) const
{
  int count = 0;
  const auto add = [&](const Direction &at) {
    if (order(at) > order(arc.begin) && order(at) < order(arc.end)) cut[count++] = at;
  };
  for (const auto d : {&Vector::x, &Vector::y, &Vector::z}) {
    const double a = wall.normal_away * own[0].*d, b = wall.normal_away * own[1].*d,
                 constant = wall.normal_along * own[2].*d, square = a * a + b * b;
    const double rest = square - constant * constant;
    if (!(rest > 0.0)) continue;
    const double root = std::sqrt(rest);
    add({(-constant * a - b * root) / square, (-constant * b + a * root) / square});
    add({(-constant * a + b * root) / square, (-constant * b - a * root) / square});
  }
  if (arc.is_wide) {
    add({1.0, 0.0});
    add({0.0, 1.0});
    add({0.0, -1.0});
  }
  std::sort(cut, cut + count, [&](const Direction &one, const Direction &other) {
    return order(one) < order(other);
  });
  return count;
}

/* Between a slope that is positive and one that is not: Newton's method where it stays between the two, else false position as
   modified in M. Dowell, P. Jarratt, BIT 11, 168 (1971) ("Illinois"), and halves where that is slow. */

RoundWall::Direction RoundWall::maximum_between(Sample low, Sample high) const
{
  constexpr int most = 200;
  const auto sine = [](const Direction &a, const Direction &b) { return a.c * b.s - a.s * b.c; };
  const auto unit = [](double x, double y) {
    const double inverse = 1.0 / std::sqrt(x * x + y * y);
    return Direction{inverse * x, inverse * y};
  };
  double width = sine(low.at, high.at), of_low = low.slope, of_high = high.slope;
  int kept = 0;    // the end that has stayed: > 0 the low one, < 0 the high one
  Sample last = low;
  for (int k = 0; k < most && of_high < 0.0; k++) {
    const double turn = -last.slope / last.bend;
    Direction at = unit(last.at.c - turn * last.at.s, last.at.s + turn * last.at.c);
    const bool is_between = sine(low.at, at) > 0.0 && sine(at, high.at) > 0.0;
    if (last.bend < 0.0 && std::fabs(turn) < 4.0e-16) break;
    if (!(last.bend < 0.0 && is_between)) {
      double part = of_low / (of_low - of_high);
      if (k % 4 == 3 && sine(low.at, high.at) > 0.25 * width) part = 0.5;
      at = unit(low.at.c + part * (high.at.c - low.at.c), low.at.s + part * (high.at.s - low.at.s));
      if (!(sine(low.at, at) > 0.0 && sine(at, high.at) > 0.0)) break;
    }
    if (k % 4 == 3) width = sine(low.at, high.at);
    last = sample(at);
    if (last.slope > 0.0) {
      low = last;
      of_low = last.slope;
      if (kept < 0) of_high *= 0.5;
      kept = -1;
    } else {
      high = last;
      of_high = last.slope;
      if (kept > 0) of_low *= 0.5;
      kept = 1;
    }
  }
  return low.slope < -high.slope ? low.at : high.at;
}

/* What of the arc may be behind the wall, by samples of all of it: its ends are not. false: nothing. */

bool RoundWall::narrow_down(Arc &arc, Samples &samples) const
{
  sample(arc.begin, arc.end, samples);
  int first = lanes, last = 0;
  for (int k = 1; k < lanes; k++)
    if (may_touch_between(samples[k - 1], samples[k])) {
      first = std::min(first, k - 1);
      last = k;
    }
  if (first > 0 && last) arc.begin = samples[first].at;
  if (last && last < lanes - 1) arc.end = samples[last].at;
  return last > 0;
}

int RoundWall::find(Vector (&normal)[most_places]) const
{
  const double least = least_cosine();
  if (least > 1.0) return 0;
  const double sine = std::sqrt((1.0 - least) * (1.0 + least));
  Arc arc{
      {least, -sine}, {least, sine}, least < 0.71};    // at most a quarter of the circle is narrow
  Samples samples;
  if (!arc.is_wide && !narrow_down(arc, samples)) return 0;
  Direction end[most_cuts + 2] = {arc.begin};    // of the parts
  const int num_cuts = cuts(arc, end + 1);
  end[num_cuts + 1] = arc.end;
  int count = 0;
  Sample before{};
  for (int part = 0; part <= num_cuts; part++) {
    if (num_cuts || arc.is_wide) sample(end[part], end[part + 1], samples);
    for (int k = 0; k < lanes; k++) {
      const Sample &next = samples[k];
      const bool is_maximum = (part || k) && before.slope > 0.0 && next.slope <= 0.0;
      if (is_maximum && may_touch_between(before, next) && count < most_places)
        normal[count++] = normal_at(maximum_between(before, next));
      before = next;
    }
  }
  return count;
}

}    // namespace Talus
