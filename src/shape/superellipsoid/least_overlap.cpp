// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/superellipsoid/least_overlap.h"

#include "shape/superellipsoid/common_normal_search.h"

#include <algorithm>

namespace Talus {
namespace {

using Vector = Vector3<double>;
using Pair = OtherSuperellipsoid<double>;
using PairSearch = CommonNormalSearch<Pair>;
using EightPairs = OtherSuperellipsoid<Vec8>;
using EightSearch = CommonNormalSearch<EightPairs>;

// overlaps over the smaller inscribed radius for which f has one minimum near by
constexpr double shallow = 0.1;

SeenPose<double> seen_pose(const Pose &pose)
{
  SeenPose<double> seen;
  seen.position = pose.position;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) seen.rotation[i][j] = pose.rotation(i, j);
  return seen;
}

double size_of_both(const Superellipsoid &a, const Superellipsoid &b)
{
  return std::max(a.bounding_radius(), b.bounding_radius());
}

CommonNormal result(const PairSearch::State &x, const Pair &b, const Superellipsoid &shape_b)
{
  CommonNormal found{x.normal, x.overlap, x.of_a, b.center() - x.of_b.place, 0.0};
  if (x.overlap > 0.0) found.curvature_of_b = shape_b.curvature_for_laws(x.of_b.own);
  return found;
}

/// What touches has a point between the surfaces that is inside both, and is not deep.
template <class Other, class State>
auto is_proven(const SuperellipsoidSurface &a, const Other &b, const State &x, double deep)
{
  using Real = typename Other::Real;
  const Real one = splat<Real>(1.0), half = splat<Real>(0.5);
  const auto middle = half * (x.of_a.place + (b.center() - x.of_b.place));
  const auto in_b = b.seen.direction_in_b(middle - b.center());
  return (x.overlap < splat<Real>(deep)) & (a.gauge(middle) < one) & (b.shape.gauge(in_b) < one);
}

double deep_overlap(const Superellipsoid &a, const Superellipsoid &b)
{
  return shallow * std::min(a.inscribed_radius(), b.inscribed_radius());
}

}    // namespace

/* ---- two superellipsoids ---------------------------------------------------------------------- */

double overlap_along(const Superellipsoid &a, const Superellipsoid &b, const Pose &seen,
                     const Vector &normal)
{
  return a.at_normal(normal).height + b.at_normal(seen.direction_in_body(normal)).height -
         dot(normal, seen.position);
}

CommonNormal find_common_normal(const Superellipsoid &a, const Superellipsoid &b, const Pose &pose)
{
  const SeenPose<double> seen = seen_pose(pose);
  const Pair other(b.formulas(), seen);
  const PairSearch search(a.formulas(), other, size_of_both(a, b));
  const PairSearch::State first =
      search.at_normal(first_normal(a.formulas(), b.formulas(), seen, a.nearest_pole().normal));
  const PairSearch::State x = search.descend(first, PairSearch::Goal::LEAST_OVERLAP, true, true);
  if (x.overlap < 0.0 || is_proven(a.formulas(), other, x, deep_overlap(a, b)))
    return result(x, other, b);
  if (!(first.ratio > 0.0)) return result(x, other, b);    // the same center
  PairSearch::State touching = search.descend(first, PairSearch::Goal::LARGEST_RATIO, true, true);
  touching = search.descend(touching, PairSearch::Goal::LEAST_OVERLAP, true, true);
  const bool is_deep = !(x.overlap < deep_overlap(a, b));
  return result(touching.overlap < x.overlap || touching.overlap < 0.0 || is_deep ? touching : x,
                other, b);
}

/* ---- eight pairs ------------------------------------------------------------------------------ */

namespace {

struct Columns {    // of eight poses, or of what is found
  alignas(64) double value[12][lanes];
  Vec8 operator[](int k) const { return load8(value[k]); }
};

SeenPose<Vec8> seen_poses(const Pose *poses, int count)
{
  Columns columns;
  for (int lane = 0; lane < lanes; lane++) {
    const Pose &pose = poses[std::min(lane, count - 1)];
    for (int k = 0; k < 9; k++) columns.value[k][lane] = pose.rotation(k / 3, k % 3);
    columns.value[9][lane] = pose.position.x;
    columns.value[10][lane] = pose.position.y;
    columns.value[11][lane] = pose.position.z;
  }
  SeenPose<Vec8> seen;
  for (int k = 0; k < 9; k++) seen.rotation[k / 3][k % 3] = columns[k];
  seen.position = {columns[9], columns[10], columns[11]};
  return seen;
}

Vector lane_of(const Vector3<Vec8> &v, int k)
{
  return {v.x[k], v.y[k], v.z[k]};
}

PointWithNormal<double> lane_of(const PointWithNormal<Vec8> &p, int k)
{
  return {
      lane_of(p.place, k), lane_of(p.normal, k), p.height[k], p.xx[k], p.yy[k], p.zz[k], p.xy[k]};
}

}    // namespace

unsigned apart_along(const Superellipsoid &a, const Superellipsoid &b, const Pose *poses,
                     const Vector *normals, int count)
{
  const SeenPose<Vec8> seen = seen_poses(poses, count);
  Columns columns;
  for (int lane = 0; lane < lanes; lane++) {
    const Vector &n = normals[std::min(lane, count - 1)];
    columns.value[0][lane] = n.x;
    columns.value[1][lane] = n.y;
    columns.value[2][lane] = n.z;
  }
  const Vector3<Vec8> n{columns[0], columns[1], columns[2]};
  const Vec8 overlap = a.formulas().at_normal(n).height +
                       b.formulas().at_normal(seen.direction_in_b(n)).height -
                       dot(n, seen.position);
  const double rounding = 1.0e-12 * (a.bounding_radius() + b.bounding_radius());
  return less_bits(overlap, splat<Vec8>(-rounding)) & ((1U << count) - 1U);
}

void find_common_normals(const Superellipsoid &a, const Superellipsoid &b, const Pose *poses,
                         int count, CommonNormal *found)
{
  const SeenPose<Vec8> seen = seen_poses(poses, count);
  const EightPairs others(b.formulas(), seen);
  const EightSearch search(a.formulas(), others, size_of_both(a, b));
  const Vec8 zero = splat<Vec8>(0.0), one = splat<Vec8>(1.0);
  const EightSearch::State x = search.descend(
      search.at_normal(first_normal(a.formulas(), b.formulas(), seen, a.nearest_pole().normal)),
      EightSearch::Goal::LEAST_OVERLAP, true, zero < one);
  const auto proven = (x.overlap < zero) | is_proven(a.formulas(), others, x, deep_overlap(a, b));
  const unsigned done = less_bits(select(proven, zero, one), splat<Vec8>(0.5));
  for (int k = 0; k < count; k++) {
    if (!(done >> k & 1U)) {
      found[k] = find_common_normal(a, b, poses[k]);
      continue;
    }
    const Vector of_b = lane_of(x.of_b.place, k);
    found[k] = {lane_of(x.normal, k), x.overlap[k], lane_of(x.of_a, k), poses[k].position - of_b,
                0.0};
    if (found[k].overlap > 0.0)
      found[k].curvature_of_b = b.curvature_for_laws(lane_of(x.of_b.own, k));
  }
}

/* ---- a ball ----------------------------------------------------------------------------------- */

CommonNormal find_common_normal(const Superellipsoid &a, const Vector &center, double radius)
{
  using BallSearch = CommonNormalSearch<OtherBall>;
  const OtherBall ball(center, radius);
  const BallSearch search(a.formulas(), ball, a.bounding_radius());
  const double inner = a.inscribed_radius();
  const bool at_center = !(dot(center, center) > 1.0e-24 * inner * inner);
  const BallSearch::State x =
      search.descend(search.at(at_center ? a.nearest_pole() : a.on_ray(center)),
                     BallSearch::Goal::LEAST_OVERLAP, false, true);
  return {x.normal, x.overlap, x.of_a, center - x.of_b.place, 0.0};
}

}    // namespace Talus
