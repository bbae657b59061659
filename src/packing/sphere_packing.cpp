// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "packing/sphere_packing.h"

#include <algorithm>
#include <cmath>

namespace Talus {

SpherePacking::SpherePacking(const PackingSpace &space, std::vector<Vector3<double>> places,
                             std::vector<double> radii, int fixed_from) :
    space(space),
    x(std::move(places)), v(x.size()), f(x.size()), radius(std::move(radii)), movable(fixed_from)
{
  const double length[3] = {space.hi.x - space.lo.x, space.hi.y - space.lo.y,
                            space.hi.z - space.lo.z};
  double sum = 0.0;
  for (int d = 0; d < 3; d++) {
    period[d] = space.periodic[d] ? length[d] : 0.0;
    half[d] = 0.5 * period[d];
  }
  for (int i = 0; i < movable; i++) sum += radius[i];
  skin = movable ? 0.3 * sum / movable : 0.0;
}

/* Of two points in the box, the nearest images. */

Vector3<double> SpherePacking::nearest(Vector3<double> d) const
{
  double *c[3] = {&d.x, &d.y, &d.z};
  for (int k = 0; k < 3; k++) {
    if (*c[k] > half[k])
      *c[k] -= period[k];
    else if (*c[k] < -half[k])
      *c[k] += period[k];
  }
  return d;
}

/* ---- pairs: cells as wide as the largest reach ---------------------------------------------- */

void SpherePacking::find_pairs()
{
  const int count = static_cast<int>(x.size());
  const double widest = radius.empty() ? 0.0 : *std::max_element(radius.begin(), radius.end());
  const double reach = 2.0 * widest + skin;
  const double low[3] = {space.lo.x, space.lo.y, space.lo.z};
  const double high[3] = {space.hi.x, space.hi.y, space.hi.z};
  int cells[3];
  double per_length[3];
  for (int d = 0; d < 3; d++) {
    cells[d] = std::clamp(static_cast<int>((high[d] - low[d]) / reach), 1, 1024);
    per_length[d] = cells[d] / (high[d] - low[d]);
  }
  const auto cell_of = [&](const Vector3<double> &p, int d) {
    const double at = d == 0 ? p.x : d == 1 ? p.y : p.z;
    return std::clamp(static_cast<int>((at - low[d]) * per_length[d]), 0, cells[d] - 1);
  };
  std::vector<int> first(static_cast<std::size_t>(cells[0]) * cells[1] * cells[2], -1), next(count);
  const auto number = [&](int a, int b, int c) {
    return (static_cast<std::size_t>(c) * cells[1] + b) * cells[0] + a;
  };
  for (int i = count - 1; i >= 0; i--) {
    int &head = first[number(cell_of(x[i], 0), cell_of(x[i], 1), cell_of(x[i], 2))];
    next[i] = head;
    head = i;
  }

  pairs.clear();
  for (int i = 0; i < movable; i++) {
    int from[3], to[3];
    for (int d = 0; d < 3; d++) {
      const int c = cell_of(x[i], d);
      // with less than three cells, neighbors on both sides are the same
      const bool all = space.periodic[d] && cells[d] < 3;
      from[d] = all ? 0 : space.periodic[d] ? c - 1 : std::max(0, c - 1);
      to[d] = all ? cells[d] - 1 : space.periodic[d] ? c + 1 : std::min(cells[d] - 1, c + 1);
    }
    const auto wrap = [&](int c, int d) { return (c + cells[d]) % cells[d]; };
    for (int c = from[2]; c <= to[2]; c++)
      for (int b = from[1]; b <= to[1]; b++)
        for (int a = from[0]; a <= to[0]; a++)
          for (int j = first[number(wrap(a, 0), wrap(b, 1), wrap(c, 2))]; j >= 0; j = next[j]) {
            if (j <= i) continue;
            const Vector3<double> d = nearest(x[i] - x[j]);
            const double near = radius[i] + radius[j] + skin;
            if (dot(d, d) < near * near) pairs.push_back({i, j});
          }
  }
  x_of_list = x;
}

/* ---- overlaps ------------------------------------------------------------------------------- */

void SpherePacking::compute_forces()
{
  std::fill(f.begin(), f.end(), Vector3<double>{0.0, 0.0, 0.0});
  largest = 0.0;
  for (const Pair &pair : pairs) {
    const Vector3<double> d = nearest(x[pair.i] - x[pair.j]);
    const double touch = radius[pair.i] + radius[pair.j], rsq = dot(d, d);
    if (rsq >= touch * touch) continue;
    const double r = std::sqrt(rsq), overlap = touch - r;
    largest = std::max(largest, overlap / std::min(radius[pair.i], radius[pair.j]));
    const Vector3<double> push = r > 0.0 ? (overlap / r) * d : Vector3<double>{overlap, 0.0, 0.0};
    f[pair.i] = f[pair.i] + push;
    if (pair.j < movable) f[pair.j] = f[pair.j] - push;
  }
  for (int i = 0; i < movable; i++) {
    walls.clear();
    space.find_walls(x[i], radius[i], walls);
    for (const auto &[normal, overlap] : walls) {
      largest = std::max(largest, overlap / radius[i]);
      f[i] = f[i] + overlap * normal;
    }
  }
}

/* ---- FIRE ----------------------------------------------------------------------------------- */

void SpherePacking::move()
{
  constexpr double largest_dt = 0.6, grow = 1.1, shrink = 0.5, least_mixing = 0.99;
  double power = 0.0, speed = 0.0, force = 0.0;
  for (int i = 0; i < movable; i++) {
    power += dot(f[i], v[i]);
    speed += dot(v[i], v[i]);
    force += dot(f[i], f[i]);
  }
  if (power > 0.0) {
    const double share = force > 0.0 ? mixing * std::sqrt(speed / force) : 0.0;
    for (int i = 0; i < movable; i++) v[i] = (1.0 - mixing) * v[i] + share * f[i];
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
    v[i] = v[i] + dt * f[i];
    const double speed_of_i = length(v[i]), most = 0.25 * radius[i] / dt;
    if (speed_of_i > most) v[i] = (most / speed_of_i) * v[i];
    Vector3<double> to = x[i] + dt * v[i];
    double *c[3] = {&to.x, &to.y, &to.z};
    const double low[3] = {space.lo.x, space.lo.y, space.lo.z};
    for (int d = 0; d < 3; d++) {
      if (!space.periodic[d]) continue;
      if (*c[d] < low[d]) *c[d] += period[d];
      if (*c[d] >= low[d] + period[d]) *c[d] -= period[d];
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
