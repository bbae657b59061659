// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/moving_vertices.h"

#include <algorithm>

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
  before = settled = start = end = now();
  velocity.assign(num_all(), {0.0, 0.0, 0.0});
  velocity_at_start = velocity_at_end = velocity_before = velocity;
}

MovingVertices::Places MovingVertices::now() const
{
  Places all;
  all.reserve(num_all());
  for (int v = 0; v < num_all(); v++) all.push_back(place(v));
  return all;
}

template <class Value>
MovingVertices::Places MovingVertices::for_all(const Places &own, Value of_image) const
{
  Places all = own;
  all.reserve(num_all());
  for (int v = num_own(); v < num_all(); v++) all.push_back(of_image(v, own[mesh.own_vertex(v)]));
  return all;
}

MovingVertices::Places MovingVertices::with_images(const Places &own) const
{
  return for_all(own, [this](int v, const Vector3<double> &x) { return x + mesh.shift_of_vertex(v); });
}

void MovingVertices::guide(const Places &places, const Places *velocities, int number, double dt)
{
  steps = left = number;
  start = now();
  end = with_images(places);
  velocity_at_start = velocity;
  follows_way = velocities == nullptr;
  if (velocities)
    velocity_at_end = for_all(*velocities, [](int, const Vector3<double> &v) { return v; });
  else
    for (int v = 0; v < num_all(); v++)
      velocity_at_end[v] =
          number ? 1.0 / (number * dt) * (end[v] - start[v]) : Vector3<double>{0.0, 0.0, 0.0};
  rests = 0;
  set_bounds();
  if (number == 0) {
    if (!has_jumped) before = start;
    has_jumped = true;
    for (int v = 0; v < num_all(); v++) mesh.place(v, end[v]);
    velocity = velocity_at_end;
  }
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
  for (int v = 0; v < num_all(); v++)
    if (differ(place(v), end[v]) || differ(velocity[v], velocity_at_end[v]) ||
        differ(place(v), before[v]) || differ(velocity[v], velocity_before[v]) ||
        (follows_way && differ(velocity[v], {0.0, 0.0, 0.0})))
      moving.push_back(v);
}

void MovingVertices::find_way()
{
  double square = 0.0, of_others = 0.0;
  std::size_t next = 0;
  for (int v = 0; v < num_all(); v++) {
    const double d = dot(gone(v), gone(v));
    square = std::max(square, d);
    if (next < moving.size() && moving[next] == v)
      next++;
    else
      of_others = std::max(of_others, d);
  }
  largest_way = std::sqrt(square);
  way_of_others = of_others;
}

bool MovingVertices::advance()
{
  constexpr int at_rest = 2;    // also where the step before is looked at
  if (moving.empty() || rests >= at_rest) {
    has_jumped = false;
    return false;
  }
  const bool goes = left > 0;
  if (goes) left--;
  if (!goes) rests++;
  const double way = steps ? static_cast<double>(steps - left) / steps : 1.0;
  const bool arrived = left == 0;
  double square = way_of_others;
  for (const int v : moving) {
    if (!has_jumped) before[v] = place(v);
    velocity_before[v] = velocity[v];
    if (v >= num_own())
      mesh.place(v, place(mesh.own_vertex(v)) + mesh.shift_of_vertex(v));
    else if (goes)
      mesh.place(v, arrived ? end[v] : start[v] + way * (end[v] - start[v]));
    if (follows_way)
      velocity[v] = goes ? velocity_at_end[v] : Vector3<double>{0.0, 0.0, 0.0};
    else
      velocity[v] = arrived ? velocity_at_end[v]
                            : velocity_at_start[v] +
                                  way * (velocity_at_end[v] - velocity_at_start[v]);
    square = std::max(square, dot(gone(v), gone(v)));
  }
  has_jumped = false;
  largest_way = std::sqrt(square);
  return true;
}

void MovingVertices::stand_still()
{
  before = now();
  velocity_before = velocity;
}

void MovingVertices::settle()
{
  settled = now();
  largest_way = way_of_others = 0.0;
}

/* ---- the surface ------------------------------------------------------------------------------ */

Triangle MovingVertices::of(const Places &places, int t) const
{
  const int *const v = mesh.corners(t).vertex;
  return {{places[v[0]], places[v[1]], places[v[2]]}};
}

Triangle MovingVertices::half_way(int t) const
{
  const Triangle was = of(before, t), is = mesh.triangle(t);
  Triangle middle;
  for (int k = 0; k < 3; k++) middle.corner[k] = 0.5 * (was.corner[k] + is.corner[k]);
  return middle;
}

PlaceOnTriangle MovingVertices::place_on(int t, const Vector3<double> &point) const
{
  const Triangle at = mesh.triangle(t);
  const Vector3<double> a = at.corner[1] - at.corner[0], b = at.corner[2] - at.corner[0];
  const Vector3<double> n = cross(a, b), p = point - at.corner[0];
  const double over_square = 1.0 / dot(n, n);
  const double second = over_square * dot(cross(p, b), n), third = over_square * dot(cross(a, p), n);
  return {t, {1.0 - second - third, second, third}};
}

namespace {

/// Edges opposite to the second and third corner; unit normal; 1/(twice the area).
struct Edges {
  explicit Edges(const Triangle &t) :
      second(t.corner[0] - t.corner[2]), third(t.corner[1] - t.corner[0])
  {
    const Vector3<double> twice = cross(second, third);
    over_twice_area = 1.0 / length(twice);
    normal = over_twice_area * twice;
  }
  Vector3<double> second, third, normal;
  double over_twice_area;
};

/* Differences to the first corner, so that what is the same of all has no rounding. */

SurfaceMotion motion_of(const Triangle &x, const Triangle &v, const double *share)
{
  const Edges edge(x);
  const auto between = [&](const Triangle &of) {
    return of.corner[0] + share[1] * (of.corner[1] - of.corner[0]) +
           share[2] * (of.corner[2] - of.corner[0]);
  };
  const auto turning = [&](const Vector3<double> &velocity, const Vector3<double> &opposite) {
    const Vector3<double> past = velocity - v.corner[0];
    return edge.over_twice_area *
           (dot(past, edge.normal) * opposite - 0.5 * dot(past, opposite) * edge.normal);
  };
  return {between(x), between(v), turning(v.corner[1], edge.second) + turning(v.corner[2], edge.third)};
}

}    // namespace

SurfaceMotion MovingVertices::motion(const PlaceOnTriangle &at) const
{
  return motion_of(mesh.triangle(at.triangle), of(velocity, at.triangle), at.share);
}

SurfaceMotion MovingVertices::motion_half_way(const PlaceOnTriangle &at) const
{
  const Triangle was = of(velocity_before, at.triangle), is = of(velocity, at.triangle);
  Triangle mean;
  for (int k = 0; k < 3; k++) mean.corner[k] = 0.5 * (was.corner[k] + is.corner[k]);
  return motion_of(half_way(at.triangle), mean, at.share);
}

TriangleTurn MovingVertices::turn(int t) const
{
  return {of(before, t), mesh.triangle(t)};
}

TriangleTurn MovingVertices::turn_since_half_way(int t) const
{
  return {half_way(t), mesh.triangle(t)};
}

void MovingVertices::share_out(const PlaceOnTriangle &at, const Vector3<double> &force,
                               const Vector3<double> &torque, Vector3<double> *on_corners) const
{
  const Edges edge(mesh.triangle(at.triangle));
  const auto couple = [&](const Vector3<double> &opposite) {
    return edge.over_twice_area *
           (dot(torque, opposite) * edge.normal - 0.5 * dot(torque, edge.normal) * opposite);
  };
  on_corners[1] = at.share[1] * force + couple(edge.second);
  on_corners[2] = at.share[2] * force + couple(edge.third);
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

void MovingVertices::to_array(double *a) const
{
  *a++ = steps;
  *a++ = left;
  *a++ = follows_way;
  *a++ = has_jumped + 2 * rests;
  const Places here = now();
  for (const Places *kept : {&here, &start, &end, &velocity_at_start, &velocity_at_end, &velocity,
                             &before, &velocity_before})
    for (int v = 0; v < num_own(); v++) {
      *a++ = (*kept)[v].x;
      *a++ = (*kept)[v].y;
      *a++ = (*kept)[v].z;
    }
}

void MovingVertices::from_array(const double *a)
{
  steps = static_cast<int>(*a++);
  left = static_cast<int>(*a++);
  follows_way = *a++ != 0.0;
  const int flags = static_cast<int>(*a++);
  has_jumped = flags % 2 != 0;
  rests = flags / 2;
  const auto read = [&] {
    Places own;
    for (int v = 0; v < num_own(); v++, a += 3) own.push_back({a[0], a[1], a[2]});
    return own;
  };
  const auto velocities = [&] {
    return for_all(read(), [](int, const Vector3<double> &v) { return v; });
  };
  const Places here = with_images(read());
  for (int v = 0; v < num_all(); v++) mesh.place(v, here[v]);
  start = with_images(read());
  end = with_images(read());
  velocity_at_start = velocities();
  velocity_at_end = velocities();
  velocity = velocities();
  before = with_images(read());
  velocity_before = velocities();
  settled = here;
  set_bounds();
  find_moving();
  find_way();
}

double MovingVertices::memory_usage() const
{
  return static_cast<double>(8 * before.capacity() * sizeof(Vector3<double>) +
                             moving.capacity() * sizeof(int));
}

}    // namespace Talus
