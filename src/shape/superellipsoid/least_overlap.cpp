// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/superellipsoid/least_overlap.h"

#include "shape/superellipsoid/common_normal_search.h"

#include <algorithm>

namespace Talus {
namespace {

using Vector = Vector3<double>;
using Pair = OtherSuperellipsoid<double>;
using PairSearch = CommonNormalSearch<Pair>;

SeenPose<double> seen_pose(const Pose &pose)
{
  SeenPose<double> seen;
  seen.position = pose.position;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) seen.rotation[i][j] = pose.rotation(i, j);
  return seen;
}

CommonNormal result(const PairSearch::State &x, const Pair &b, const Superellipsoid &shape_b)
{
  CommonNormal found{x.normal, x.overlap, x.of_a, b.center() - x.of_b.place, 0.0};
  if (x.overlap > 0.0) found.curvature_of_b = shape_b.curvature_for_laws(x.of_b.own);
  return found;
}

}    // namespace

/* ---- two superellipsoids ---------------------------------------------------------------------- */

double deep_overlap(const Superellipsoid &a, const Superellipsoid &b)
{
  return 0.1 * std::min(a.inscribed_radius(), b.inscribed_radius());
}

double size_of_both(const Superellipsoid &a, const Superellipsoid &b)
{
  return std::max(a.bounding_radius(), b.bounding_radius());
}

CommonNormal find_common_normal(const Superellipsoid &a, const Superellipsoid &b, const Pose &pose,
                                const Vector &start)
{
  const SeenPose<double> seen = seen_pose(pose);
  const Pair other(b.formulas(), seen);
  const PairSearch search(a.formulas(), other, size_of_both(a, b));
  const auto is_shown = [&](const PairSearch::State &x) {
    return x.overlap < 0.0 || is_proven(a.formulas(), other, x, deep_overlap(a, b));
  };
  if (dot(start, start) > 0.0) {
    const PairSearch::State x =
        search.descend(search.at_normal(start), PairSearch::Goal::LEAST_OVERLAP, true, true);
    if (is_shown(x)) return result(x, other, b);
  }
  const PairSearch::State first =
      search.at_normal(first_normal(a.formulas(), b.formulas(), seen, a.nearest_pole().normal));
  const PairSearch::State x = search.descend(first, PairSearch::Goal::LEAST_OVERLAP, true, true);
  if (is_shown(x)) return result(x, other, b);
  if (!(first.ratio > 0.0)) return result(x, other, b);    // the same center
  PairSearch::State touching = search.descend(first, PairSearch::Goal::LARGEST_RATIO, true, true);
  touching = search.descend(touching, PairSearch::Goal::LEAST_OVERLAP, true, true);
  const bool is_deep = !(x.overlap < deep_overlap(a, b));
  return result(touching.overlap < x.overlap || touching.overlap < 0.0 || is_deep ? touching : x,
                other, b);
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
