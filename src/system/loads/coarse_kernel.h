// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The smoothing function of coarse-grained fields (Goldhirsch, Granular Matter 12, 239, 2010) and
// where it is to be evaluated on a grid.
//
//   phi(r) = (1 - (r/W)^2)^2, r < W, up to a factor
//
// has finite reach, a continuous gradient, and its integral along a line is a polynomial, so that
// contacts are smeared along their lines without an error of quadrature.
//
// The factor is such that the values at all points of the grid, also those outside the box, times
// the volume of a cell add up to 1: for each particle, each line and each ball by itself. So sums over the
// grid are exact. For W much larger than a cell it is the 105/(32 pi W^3) of the continuum. Where cells
// end at some border, those inside get all.
//
// Along directions of which the mean is taken there is one cell, and r is the distance in the others: profiles over one
// coordinate or two.

#ifndef TALUS_SYSTEM_LOADS_COARSE_KERNEL_H
#define TALUS_SYSTEM_LOADS_COARSE_KERNEL_H

#include "base/vector3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace Talus {

class CoarseKernel {
 public:
  struct Share {
    int cell[3];      ///< indices, perhaps outside the grid
    double weight;    ///< 1/volume
  };

  /// Indices of the first cell and the last one of each direction, where there is an end.
  struct Ends {
    int first[3], last[3];
  };
  static constexpr int endless = std::numeric_limits<int>::max();
  static constexpr Ends no_ends{{-endless, -endless, -endless}, {endless, endless, endless}};

  /// Centers of cells are at origin + (index + 1/2) edge. At least as wide as each edge, but for those of directions of which
  /// the mean is taken.
  CoarseKernel(const Vector3<double> &origin, const Vector3<double> &edge, double width,
               const Ends &given = no_ends, const std::array<bool, 3> &mean_of = {}) :
      origin{origin.x, origin.y, origin.z},
      edge{edge.x, edge.y, edge.z}, width(width),
      ends(given), counts{mean_of[0] ? 0.0 : 1.0, mean_of[1] ? 0.0 : 1.0, mean_of[2] ? 0.0 : 1.0}
  {
  }

  const std::vector<Share> &of_point(const Vector3<double> &x) { return of_line(x, x); }

  /// The mean of phi along the line from a to b, which is between the ends. Valid until the next call.
  const std::vector<Share> &of_line(const Vector3<double> &a, const Vector3<double> &b)
  {
    const Vector3<double> along = seen(b - a);
    return spread(a, b, width, [&](const Vector3<double> &center) {
      return mean_along(seen(a - center), along);
    });
  }

  /// The mean of phi over a ball.
  const std::vector<Share> &of_ball(const Vector3<double> &x, double radius)
  {
    return spread(x, x, radius + width, [&](const Vector3<double> &center) {
      const Vector3<double> between = seen(x - center);
      return within(std::sqrt(dot(between, between)), radius);
    });
  }

  /// Integral over s = 0 ... 1 of phi(|from + s along|), without the factor.
  double mean_along(const Vector3<double> &from, const Vector3<double> &along) const
  {
    // |from + s along|^2 = c + 2 b s + a s^2
    const double a = dot(along, along), b = dot(from, along), c = dot(from, from),
                 w = width * width;
    if (a == 0.0) return phi(c, w);
    const double discriminant = b * b - a * (c - w);
    if (!(discriminant > 0.0)) return 0.0;
    const double root = std::sqrt(discriminant);
    const double begin = std::max(0.0, (-b - root) / a), end = std::min(1.0, (-b + root) / a);
    if (!(end > begin)) return 0.0;
    // Gauss-Legendre with three points: exact up to degree five
    const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
    const double off = half * 0.77459666924148337704;
    const auto at = [&](double s) { return phi(c + s * (2.0 * b + s * a), w); };
    return half * (5.0 * at(middle - off) + 8.0 * at(middle) + 5.0 * at(middle + off)) / 9.0;
  }

  /// Integral of phi over a ball whose center is at this distance, over pi, without the factor: over spheres around the
  /// point, of which 4 pi r^2 is in the ball, or pi r/d (R^2 - (r - d)^2) of those that cross its surface.
  double within_ball(double distance, double radius) const
  {
    const double w = width * width, inner = radius - distance, outer = radius + distance;
    double sum = 0.0;
    if (inner > 0.0)
      sum += integral(0.0, std::min(inner, width),
                      [&](double r) { return 4.0 * r * r * phi(r * r, w); });
    const double begin = std::fabs(inner), end = std::min(outer, width);
    if (distance > 0.0 && end > begin)
      sum += integral(begin, end, [&](double r) {
        return r * (inner + r) * ((outer - r) / distance) * phi(r * r, w);
      });
    return sum;
  }

  /// The same where the distance is along one coordinate: over discs.
  double within_discs(double distance, double radius) const
  {
    const double w = width * width;
    const auto of_disc = [&](double s) {
      const double off = distance - s;
      return (radius + s) * (radius - s) * phi(off * off, w);
    };
    const double begin = std::max(-radius, distance - width),
                 end = std::min(radius, distance + width);
    return end > begin ? integral(begin, end, of_disc) : 0.0;
  }

  /// And in a plane: over chords of the ball, in rings around its axis, by Gauss-Legendre in the square of their radius;
  /// what the sum over directions and rings lacks is below 0.002 of the ball where W is not less than the radius.
  double within_chords(double distance, double radius) const
  {
    constexpr int directions = 16;
    constexpr double half_turn = 3.14159265358979323846;
    const double w = width * width;
    double sum = 0.0;
    for (int k = 0; k < directions; k++) {
      const double cosine = std::cos(half_turn * (k + 0.5) / directions);
      const auto of_ring =
          [&](double t) {    // of half the height of the chord over the radius: t; d(area) ~ t dt
            const double ring = radius * std::sqrt(std::max(0.0, 1.0 - t * t));
            return t * t * phi(distance * distance + ring * (ring - 2.0 * distance * cosine), w);
          };
      sum += integral(0.0, 0.5, of_ring) + integral(0.5, 1.0, of_ring);
    }
    return 4.0 * radius * radius * radius / directions * sum;
  }

 private:
  Vector3<double> seen(const Vector3<double> &v) const
  {
    return {counts[0] * v.x, counts[1] * v.y, counts[2] * v.z};
  }

  double within(double distance, double radius) const
  {
    const double dimensions = counts[0] + counts[1] + counts[2];
    if (dimensions == 3.0) return within_ball(distance, radius);
    if (dimensions == 2.0) return within_chords(distance, radius);
    return dimensions == 1.0 ? within_discs(distance, radius) : 1.0;
  }

  /// Gauss-Legendre with four points: exact up to degree seven.
  template <class Function> static double integral(double begin, double end, Function f)
  {
    constexpr double near = 0.33998104358485626480, far = 0.86113631159405257522,
                     of_near = 0.65214515486254614263, of_far = 0.34785484513745385737;
    const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
    return half * (of_near * (f(middle - near * half) + f(middle + near * half)) +
                   of_far * (f(middle - far * half) + f(middle + far * half)));
  }

  /// Of all points within `reach` of a line.
  template <class Weight>
  const std::vector<Share> &spread(const Vector3<double> &a, const Vector3<double> &b, double reach,
                                   Weight weight_at)
  {
    const double from[3] = {a.x, a.y, a.z}, to[3] = {b.x, b.y, b.z};
    int lo[3], hi[3];
    for (int d = 0; d < 3; d++) {
      const auto index = [&](double place) { return (place - origin[d]) / edge[d] - 0.5; };
      lo[d] = static_cast<int>(std::ceil(index(std::min(from[d], to[d]) - reach)));
      hi[d] = static_cast<int>(std::floor(index(std::max(from[d], to[d]) + reach)));
      lo[d] = counts[d] == 0.0 ? 0 : std::max(lo[d], ends.first[d]);
      hi[d] = counts[d] == 0.0 ? 0 : std::min(hi[d], ends.last[d]);
    }
    shares.clear();
    double sum = 0.0;
    for (int z = lo[2]; z <= hi[2]; z++)
      for (int y = lo[1]; y <= hi[1]; y++)
        for (int x = lo[0]; x <= hi[0]; x++) {
          const Vector3<double> center{origin[0] + (x + 0.5) * edge[0],
                                       origin[1] + (y + 0.5) * edge[1],
                                       origin[2] + (z + 0.5) * edge[2]};
          const double weight = weight_at(center);
          if (weight > 0.0) {
            shares.push_back({{x, y, z}, weight});
            sum += weight;
          }
        }
    const double factor = 1.0 / (sum * edge[0] * edge[1] * edge[2]);
    for (Share &share : shares) share.weight *= factor;
    return shares;
  }

  static double phi(double rsq, double w)
  {
    const double one = std::max(0.0, 1.0 - rsq / w);
    return one * one;
  }

  double origin[3], edge[3], width;
  Ends ends;
  double counts[3];    // 0: of this direction the mean is taken
  std::vector<Share> shares;
};

}    // namespace Talus

#endif
