// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "packing/sphere_packing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace Talus {

SpherePacking::SpherePacking(const PackingSpace &space, std::vector<Vector3<double>> places,
                             std::vector<double> radii, int fixed_from) :
    space(space),
    nearest(space.box()), x(std::move(places)), v(x.size()), f(x.size()), radius(std::move(radii)),
    mass(x.size()), contacts(x.size()), movable(fixed_from)
{
  double sum = 0.0;
  for (int i = 0; i < movable; i++) sum += radius[i];
  const double mean_radius = movable ? sum / movable : 0.0;
  // with less, pairs are searched for more often; with more, they are many
  skin = 0.7 * mean_radius;
  sort(mean_radius);
}

/* Spheres that are near to each other stand near to each other in memory, where all of them do not
   fit into a cache. */

void SpherePacking::sort(double mean_radius)
{
  constexpr int fit_into_a_cache = 20000;
  number.resize(movable);
  std::iota(number.begin(), number.end(), 0);
  if (movable < fit_into_a_cache) return;
  const double width = 8.0 * mean_radius;    // of cells with some ten spheres of the mean size
  const auto cell = [&](int i) {
    const auto at = [width](double place, double low) {
      return static_cast<long long>(std::floor((place - low) / width));
    };
    return std::array<long long, 3>{at(x[i].z, space.lo.z), at(x[i].y, space.lo.y),
                                    at(x[i].x, space.lo.x)};
  };
  std::vector<std::array<long long, 3>> cells(movable);
  for (int i = 0; i < movable; i++) cells[i] = cell(i);
  std::sort(number.begin(), number.end(),
            [&](int a, int b) { return cells[a] != cells[b] ? cells[a] < cells[b] : a < b; });
  const std::vector<Vector3<double>> places = x;
  const std::vector<double> radii = radius;
  for (int i = 0; i < movable; i++) {
    x[i] = places[number[i]];
    radius[i] = radii[number[i]];
  }
}

std::vector<Vector3<double>> SpherePacking::places() const
{
  std::vector<Vector3<double>> given = x;
  for (int i = 0; i < movable; i++) given[number[i]] = x[i];
  return given;
}

/* ---- pairs ---------------------------------------------------------------------------------- */

/* A sphere looks for those of its own size class, with higher numbers, and for all that are larger:
   each pair is found once. */

void SpherePacking::find_pairs()
{
  const int count = static_cast<int>(x.size());
  const double widest = radius.empty() ? 0.0 : *std::max_element(radius.begin(), radius.end());
  SphereGrid grid(space.box(), widest, skin, count);
  for (int i = count - 1; i >= 0; i--) grid.add(i, x[i], radius[i]);
  pairs.clear();
  for (int i = 0; i < count; i++) {
    const int own = grid.class_of(radius[i]);
    for (int n = 0; n <= own; n++)
      looked += grid.visit_near(n, x[i], radius[i], [&](int j) {
        if ((n == own && j <= i) || (i >= movable && j >= movable)) return;
        const Vector3<double> d = nearest(x[i] - x[j]);
        const double near = radius[i] + radius[j] + skin;
        if (dot(d, d) < near * near) pairs.push_back({std::min(i, j), std::max(i, j)});
      });
  }
  x_of_list = x;
  std::fill(mass.begin(), mass.end(), 1.0);
}

/* ---- overlaps ------------------------------------------------------------------------------- */

/* Masses are those of the most contacts since pairs were found: stable, and not tossed about. */

void SpherePacking::compute_forces()
{
  constexpr double contacts_per_mass = 6.0;
  std::fill(f.begin(), f.end(), Vector3<double>{0.0, 0.0, 0.0});
  std::fill(contacts.begin(), contacts.end(), 0);
  largest = 0.0;
  looked += static_cast<long>(pairs.size());
  for (const auto &[i, j] : pairs) {
    const Vector3<double> d = nearest(x[i] - x[j]);
    const double touch = radius[i] + radius[j], rsq = dot(d, d);
    if (rsq >= touch * touch) continue;
    const double r = std::sqrt(rsq), overlap = touch - r;
    largest = std::max(largest, overlap / std::min(radius[i], radius[j]));
    const Vector3<double> push = r > 0.0 ? (overlap / r) * d : Vector3<double>{overlap, 0.0, 0.0};
    f[i] = f[i] + push;
    f[j] = f[j] - push;
    contacts[i]++;
    contacts[j]++;
  }
  for (int i = 0; i < movable; i++) {
    walls.clear();
    space.find_walls(x[i], radius[i], walls);
    for (const auto &[normal, overlap] : walls) {
      largest = std::max(largest, overlap / radius[i]);
      f[i] = f[i] + overlap * normal;
    }
    mass[i] = std::max(mass[i], contacts[i] / contacts_per_mass);
  }
}

/* ---- FIRE ----------------------------------------------------------------------------------- */

void SpherePacking::move()
{
  constexpr double largest_dt = 0.6, grow = 1.1, shrink = 0.5, least_mixing = 0.99;
  double power = 0.0, speed = 0.0, force = 0.0;
  for (int i = 0; i < movable; i++) {
    power += dot(f[i], v[i]);
    speed += mass[i] * dot(v[i], v[i]);
    force += dot(f[i], f[i]) / mass[i];
  }
  if (power > 0.0) {
    const double share = force > 0.0 ? mixing * std::sqrt(speed / force) : 0.0;
    for (int i = 0; i < movable; i++) v[i] = (1.0 - mixing) * v[i] + (share / mass[i]) * f[i];
    if (++downhill > 5) {
      dt = std::min(dt * grow, largest_dt);
      mixing *= least_mixing;
    }
  } else {
    std::fill(v.begin(), v.end(), Vector3<double>{0.0, 0.0, 0.0});
    dt = std::max(dt * shrink, 0.01);
    mixing = 0.1;
    downhill = 0;
  }

  double farthest = 0.0;
  for (int i = 0; i < movable; i++) {
    v[i] = v[i] + (dt / mass[i]) * f[i];
    const double speed_of_i = length(v[i]), most = 0.25 * radius[i] / dt;
    if (speed_of_i > most) v[i] = (most / speed_of_i) * v[i];
    Vector3<double> to = x[i] + dt * v[i];
    double *c[3] = {&to.x, &to.y, &to.z};
    const double low[3] = {space.lo.x, space.lo.y, space.lo.z};
    const double high[3] = {space.hi.x, space.hi.y, space.hi.z};
    for (int d = 0; d < 3; d++) {
      if (!space.periodic[d]) continue;
      if (*c[d] < low[d]) *c[d] += high[d] - low[d];
      if (*c[d] >= high[d]) *c[d] -= high[d] - low[d];
    }
    if (space.contains(to))
      x[i] = to;
    else
      v[i] = {0.0, 0.0, 0.0};
    const Vector3<double> moved = nearest(x[i] - x_of_list[i]);
    farthest = std::max(farthest, dot(moved, moved));
  }
  if (4.0 * farthest > skin * skin) find_pairs();
}

bool SpherePacking::relax(double limit, int most_steps)
{
  constexpr int window = 2000;
  double before = 0.0;
  find_pairs();
  compute_forces();
  for (step = 0; largest > limit && step < most_steps; step++) {
    if (step % window == 0) {
      if (step && largest > 0.9 * before) break;
      before = largest;
    }
    move();
    compute_forces();
  }
  return largest <= limit;
}

}    // namespace Talus
