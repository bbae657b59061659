// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "packing/random_packing.h"

#include "packing/sphere_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace Talus {

RandomPacking::RandomPacking(const PackingSpace &space, std::vector<double> radii,
                             std::vector<Vector3<double>> fixed, std::vector<double> fixed_radii) :
    space(space),
    nearest(space.box()), order(radii.size()), x(std::move(fixed)), radius(std::move(fixed_radii)),
    num_fixed(static_cast<int>(x.size()))
{
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return radii[a] > radii[b]; });
  for (const int k : order) radius.push_back(radii[k]);
}

bool RandomPacking::pack(RandomNumbers &random, double limit, int most_steps)
{
  bool fits = true;
  while (fits && x.size() < radius.size()) {
    const double least = 0.5 * radius[x.size()];
    std::size_t end = x.size();
    while (end < radius.size() && radius[end] > least) end++;
    place(static_cast<int>(end), random);
    fits = relax(limit, most_steps);
  }
  return fits;
}

std::vector<Vector3<double>> RandomPacking::places() const
{
  std::vector<Vector3<double>> given(order.size());
  for (std::size_t k = num_fixed; k < x.size(); k++) given[order[k - num_fixed]] = x[k];
  return given;
}

/* ---- a stage -------------------------------------------------------------------------------- */

void RandomPacking::place(int end, RandomNumbers &random)
{
  const int present = static_cast<int>(x.size());
  const double widest = *std::max_element(radius.begin(), radius.end());
  SphereGrid grid(space.box(), widest, 0.0, present);
  for (int n = 0; n < present; n++) grid.add(n, x[n], radius[n]);
  for (int n = present; n < end; n++) x.push_back(find_place(grid, radius[n], random));
}

/* The first one that is free, or of some the one with the least overlap. */

Vector3<double> RandomPacking::find_place(const SphereGrid &grid, double r, RandomNumbers &random)
{
  constexpr int attempts = 20;
  double least = std::numeric_limits<double>::infinity();
  Vector3<double> best{};
  for (int n = 0; n < attempts && least > 0.0; n++) {
    Vector3<double> at;
    do at = space.draw(random);
    while (!space.contains(at));
    const double overlap = overlap_at(grid, at, r, least);
    if (overlap >= least) continue;
    least = overlap;
    best = at;
  }
  return best;
}

/* The largest overlap, or one that is not less than `enough`. */

double RandomPacking::overlap_at(const SphereGrid &grid, const Vector3<double> &at, double r,
                                 double enough)
{
  double worst = 0.0;
  for (int n = 0; n < grid.num_classes() && worst < enough; n++)
    looked += grid.visit_near(n, at, r, [&](int k) {
      const Vector3<double> d = nearest(at - x[k]);
      const double touch = r + radius[k], rsq = dot(d, d);
      if (rsq < touch * touch) worst = std::max(worst, touch - std::sqrt(rsq));
    });
  return worst;
}

bool RandomPacking::relax(double limit, int most_steps)
{
  // those that stay go behind those that move
  const auto moved_first = [this](auto things) {
    things.resize(x.size());
    std::rotate(things.begin(), things.begin() + num_fixed, things.end());
    return things;
  };
  const int movable = static_cast<int>(x.size()) - num_fixed;
  SpherePacking packing(space, moved_first(x), moved_first(radius), movable);
  const bool fits = packing.relax(limit, most_steps - step);
  const std::vector<Vector3<double>> places = packing.places();
  std::copy(places.begin(), places.begin() + movable, x.begin() + num_fixed);
  largest = packing.largest_overlap();
  step += packing.steps();
  looked += packing.work();
  return fits;
}

}    // namespace Talus
