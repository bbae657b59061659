// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/moving_vertices.h"

#include <algorithm>
#include <utility>

namespace Talus {
namespace {

bool differ(const Vector3<double> &a, const Vector3<double> &b)
{
  return a.x != b.x || a.y != b.y || a.z != b.z;
}

}    // namespace

/* ---- the way of vertices --------------------------------------------------------------------- */

MovingVertices::MovingVertices(TriangleMesh &triangle_mesh) : mesh(triangle_mesh)
{
  const Vector3<double> none{0.0, 0.0, 0.0};
  for (int v = 0; v < num_all(); v++) states.push_back({mesh.vertex(v), none, mesh.vertex(v)});
  settled = start = end = now();
  velocity_at_start = velocity_at_end = velocity_before = Places(num_all(), none);
}

MovingVertices::Places MovingVertices::now() const
{
  Places all;
  all.reserve(num_all());
  for (const State &state : states) all.push_back(state.place);
  return all;
}

void MovingVertices::put(int v, const Vector3<double> &x)
{
  states[v].place = x;
  mesh.place(v, x);
}

template <class Value>
MovingVertices::Places MovingVertices::for_all(const Places &own, Value of_image) const
{
  Places all;
  all.reserve(num_all());
  all = own;
  for (int v = num_own(); v < num_all(); v++) all.push_back(of_image(v, own[mesh.own_vertex(v)]));
  return all;
}

MovingVertices::Places MovingVertices::with_images(const Places &own) const
{
  return for_all(own,
                 [this](int v, const Vector3<double> &x) { return x + mesh.shift_of_vertex(v); });
}

void MovingVertices::guide(Places places, const Places *velocities, int number, double dt)
{
  steps = left = number;
  end = std::move(places);
  follows_way = velocities == nullptr;
  if (velocities)
    velocity_at_end = for_all(*velocities, [](int, const Vector3<double> &v) { return v; });
  for (int v = 0; v < num_all(); v++) {
    State &state = states[v];
    start[v] = state.place;
    velocity_at_start[v] = state.velocity;
    if (follows_way)
      velocity_at_end[v] =
          number ? 1.0 / (number * dt) * (end[v] - start[v]) : Vector3<double>{0.0, 0.0, 0.0};
    if (number) continue;
    if (!has_jumped) state.before = state.place;
    put(v, end[v]);
    state.velocity = velocity_at_end[v];
  }
  has_jumped = has_jumped || number == 0;
  rests = 0;
  set_bounds();
  find_moving();
  find_way();
}

void MovingVertices::set_bounds()
{
  Eigen::AlignedBox3d box;
  for (int v = 0; v < num_all(); v++) {
    box.extend(to_eigen(place(v)));
    box.extend(to_eigen(end[v]));
  }
  mesh.set_bounds(box);
}

/* Of the others nothing changes from one step to the next. */

void MovingVertices::find_moving()
{
  moving.clear();
  for (int v = 0; v < num_all(); v++) {
    const State &state = states[v];
    if (differ(state.place, end[v]) || differ(state.velocity, velocity_at_end[v]) ||
        differ(state.place, state.before) || differ(state.velocity, velocity_before[v]) ||
        (follows_way && differ(state.velocity, {0.0, 0.0, 0.0})))
      moving.push_back(v);
  }
}

/* Until the next call each step brings as much as the largest, which is exact where all go the same way. */

void MovingVertices::find_way()
{
  double square = 0.0, of_step = 0.0;
  for (int v = 0; v < num_all(); v++) {
    square = std::max(square, dot(gone(v), gone(v)));
    const Vector3<double> step = end[v] - place(v);
    of_step = std::max(of_step, dot(step, step));
  }
  largest_way = std::sqrt(square);
  largest_step = left ? std::sqrt(of_step) / left : 0.0;
}

bool MovingVertices::advance(bool order_2)
{
  constexpr int at_rest = 2;    // also where the step before is looked at
  const bool jumped = std::exchange(has_jumped, false);
  if (moving.empty() || rests >= at_rest) return false;
  const bool goes = left > 0;
  if (goes) left--;
  if (!goes) rests++;
  const double way = steps ? static_cast<double>(steps - left) / steps : 1.0;
  const bool arrived = left == 0;
  for (const int v : moving) {
    State &state = states[v];
    if (!jumped) state.before = state.place;
    if (order_2) velocity_before[v] = state.velocity;
    if (v >= num_own())
      put(v, place(mesh.own_vertex(v)) + mesh.shift_of_vertex(v));
    else if (goes)
      put(v, arrived ? end[v] : start[v] + way * (end[v] - start[v]));
    if (follows_way)
      state.velocity = goes ? velocity_at_end[v] : Vector3<double>{0.0, 0.0, 0.0};
    else
      state.velocity =
          arrived ? velocity_at_end[v]
                  : velocity_at_start[v] + way * (velocity_at_end[v] - velocity_at_start[v]);
  }
  if (goes) largest_way += (1.0 + 1.0e-9) * largest_step;    // rounding must not hide a triangle
  return true;
}

void MovingVertices::stand_still()
{
  for (int v = 0; v < num_all(); v++) {
    states[v].before = states[v].place;
    velocity_before[v] = states[v].velocity;
  }
}

void MovingVertices::settle()
{
  for (int v = 0; v < num_all(); v++) settled[v] = states[v].place;
  largest_way = 0.0;
}

/* ---- the surface ------------------------------------------------------------------------------ */

template <class Value> Triangle MovingVertices::corners(int t, Value value) const
{
  const int *const v = mesh.corners(t).vertex;
  return {{value(v[0]), value(v[1]), value(v[2])}};
}

Triangle MovingVertices::half_way(int t) const
{
  return corners(t, [this](int v) { return 0.5 * (states[v].before + states[v].place); });
}

namespace {

void set_edges(const Triangle &t, SurfacePoint &at)
{
  at.second = t.corner[0] - t.corner[2];
  at.third = t.corner[1] - t.corner[0];
  const Vector3<double> twice = cross(at.second, at.third);
  at.over_twice_area = 1.0 / length(twice);
  at.normal = at.over_twice_area * twice;
}

/* Differences to the first corner, so that what is the same of all has no rounding. */

SurfaceMotion motion_of(const SurfacePoint &at, const Triangle &x, const Triangle &v)
{
  const Vector3<double> past[2] = {v.corner[1] - v.corner[0], v.corner[2] - v.corner[0]};
  const auto turning = [&at](const Vector3<double> &velocity, const Vector3<double> &opposite) {
    return at.over_twice_area *
           (dot(velocity, at.normal) * opposite - 0.5 * dot(velocity, opposite) * at.normal);
  };
  return {x.corner[0] - at.share[2] * at.second + at.share[1] * at.third,
          v.corner[0] + at.share[1] * past[0] + at.share[2] * past[1],
          turning(past[0], at.second) + turning(past[1], at.third)};
}

}    // namespace

SurfacePoint MovingVertices::point_on(int t, const Vector3<double> &x) const
{
  const Triangle corner = mesh.triangle(t);
  SurfacePoint at;
  at.triangle = t;
  set_edges(corner, at);
  const Vector3<double> from = at.over_twice_area * (x - corner.corner[0]);
  at.share[1] = dot(cross(at.second, from), at.normal);
  at.share[2] = dot(cross(at.third, from), at.normal);
  at.share[0] = 1.0 - at.share[1] - at.share[2];
  return at;
}

SurfaceMotion MovingVertices::motion(const SurfacePoint &at) const
{
  const int t = at.triangle;
  return motion_of(at, corners(t, [this](int v) { return states[v].place; }),
                   corners(t, [this](int v) { return states[v].velocity; }));
}

SurfaceMotion MovingVertices::motion_half_way(const SurfacePoint &now) const
{
  const int t = now.triangle;
  const Triangle middle = half_way(t);
  SurfacePoint at = now;
  set_edges(middle, at);
  return motion_of(at, middle, corners(t, [this](int v) {
                     return 0.5 * (velocity_before[v] + states[v].velocity);
                   }));
}

TriangleTurn MovingVertices::turn(int t) const
{
  return {corners(t, [this](int v) { return states[v].before; }), mesh.triangle(t)};
}

TriangleTurn MovingVertices::turn_since_half_way(int t) const
{
  return {half_way(t), mesh.triangle(t)};
}

void MovingVertices::share_out(const SurfacePoint &at, const Vector3<double> &force,
                               const Vector3<double> &torque, Vector3<double> *on_corners)
{
  const auto couple = [&](const Vector3<double> &opposite) {
    return at.over_twice_area *
           (dot(torque, opposite) * at.normal - 0.5 * dot(torque, at.normal) * opposite);
  };
  on_corners[1] = at.share[1] * force + couple(at.second);
  on_corners[2] = at.share[2] * force + couple(at.third);
  on_corners[0] = force - on_corners[1] - on_corners[2];
}

/* Axes along an edge, across it in the plane, and along the normal; then the turn in the plane that makes
   the stretch symmetric. */

TriangleTurn::TriangleTurn(const Triangle &from, const Triangle &to)
{
  const Vector3<double> a[2] = {from.corner[1] - from.corner[0], to.corner[1] - to.corner[0]},
                        b[2] = {from.corner[2] - from.corner[0], to.corner[2] - to.corner[0]};
  none = !differ(a[0], a[1]) && !differ(b[0], b[1]);
  if (none) return;
  double along_a[2], along_b[2], across_b[2];
  for (int k = 0; k < 2; k++) {
    Vector3<double> *const axis = k ? now : before;
    const Vector3<double> n = cross(a[k], b[k]);
    along_a[k] = length(a[k]);
    axis[0] = 1.0 / along_a[k] * a[k];
    axis[2] = 1.0 / length(n) * n;
    axis[1] = cross(axis[2], axis[0]);
    along_b[k] = dot(b[k], axis[0]);
    across_b[k] = dot(b[k], axis[1]);
  }
  const double stretch = along_a[1] / along_a[0], across = across_b[1] / across_b[0];
  const double shear = (along_b[1] - stretch * along_b[0]) / across_b[0];
  const double size = std::sqrt((stretch + across) * (stretch + across) + shear * shear);
  const double cosine = (stretch + across) / size, sine = -shear / size;
  const Vector3<double> x = now[0], y = now[1];
  now[0] = cosine * x + sine * y;
  now[1] = cosine * y - sine * x;
}

/* ---- restart ----------------------------------------------------------------------------------- */

bool MovingVertices::state_fits() const
{
  const std::size_t count = num_all();
  bool fits = states.size() == count;
  for (const Places *kept : {&start, &end, &velocity_at_start, &velocity_at_end, &velocity_before})
    fits = fits && kept->size() == count;
  return fits;
}

void MovingVertices::state_is_restored()
{
  for (int v = 0; v < num_all(); v++) mesh.place(v, states[v].place);
  set_bounds();
  find_moving();
  find_way();
}

double MovingVertices::memory_usage() const
{
  return static_cast<double>(states.capacity() * sizeof(State) +
                             6 * start.capacity() * sizeof(Vector3<double>) +
                             moving.capacity() * sizeof(int));
}

}    // namespace Talus
