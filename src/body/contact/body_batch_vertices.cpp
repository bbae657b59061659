// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What only meshes whose vertices move need: each contact sees a surface of its own, which moves there as a
// rigid body, and turns its history with it. Everything is computed in space.

#include "body/contact/body_batch.h"

#include <algorithm>

namespace Talus {
namespace {

using Vector = Vector3<double>;

/// Of lanes 0 ... lanes-1, gathered one by one.
struct VectorLanes {
  alignas(64) double at[3][lanes] = {};

  void set(int q, const Vector &v)
  {
    at[0][q] = v.x;
    at[1][q] = v.y;
    at[2][q] = v.z;
  }
  Vector3<Vec8> all() const { return {load8(at[0]), load8(at[1]), load8(at[2])}; }
};

Vector lane_of(const Vector3<Vec8> &v, int q)
{
  return {v.x[q], v.y[q], v.z[q]};
}

}    // namespace

/* Where the surface is touched. Lanes behind the last contact are not looked at. */

void BodyBatch::find_points(int k)
{
  for (int lane = k; lane < std::min(k + lanes, filled); lane++) {
    const Vector x{place[0][lane], place[1][lane], place[2][lane]};
    const Vector n = Talus::lane_of(batch.normal, lane);
    point_of_lane[lane] = task->frame.vertices->point_on(
        part_of_lane[lane], x - (radius[lane] - batch.overlap[lane]) * n);
  }
}

/* As of a rigid body: velocity less that which the surface has at the center of the particle. */

void BodyBatch::see_from_vertices(Motion &m, int k)
{
  find_points(k);
  if (law.tangential().second_order) {
    see_from_vertices_order_2(m, k);
    return;
  }
  VectorLanes velocity, omega;
  for (int q = 0; q < std::min(lanes, filled - k); q++) {
    const SurfaceMotion surface = task->frame.vertices->motion(point_of_lane[k + q]);
    velocity.set(q, surface.velocity_at({place[0][k + q], place[1][k + q], place[2][k + q]}));
    omega.set(q, surface.omega);
  }
  m.velocity = m.velocity - velocity.all();
  m.omega = m.omega - omega.all();
}

/* Velocities are those half a step before, turned as the surface has turned since; the changes lead to those
   of the present: see see_from_body(). */

void BodyBatch::see_from_vertices_order_2(Motion &m, int k)
{
  const MovingVertices &vertices = *task->frame.vertices;
  VectorLanes velocity, omega, velocity_change, rotation_change;
  for (int q = 0; q < std::min(lanes, filled - k); q++) {
    const int lane = k + q;
    const SurfacePoint &at = point_of_lane[lane];
    const SurfaceMotion now = vertices.motion(at), then = vertices.motion_half_way(at);
    const TriangleTurn turned = vertices.turn_since_half_way(at.triangle);
    const Vector x{place[0][lane], place[1][lane], place[2][lane]}, v = lane_of(m.velocity, q),
                                                                    w = lane_of(m.omega, q);
    const double r = radius[lane];
    const Vector v_then = turned(v - then.velocity_at(x - task->step.lag * v)),
                 w_then = turned(w - then.omega);
    const Vector v_now = v + Talus::lane_of(batch.velocity_change, lane) - now.velocity_at(x);
    const Vector rotation_now = r * (w - now.omega) + Talus::lane_of(batch.rotation_change, lane);
    velocity.set(q, v_then);
    omega.set(q, w_then);
    velocity_change.set(q, v_now - v_then);
    rotation_change.set(q, rotation_now - r * w_then);
  }
  m.velocity = velocity.all();
  m.omega = omega.all();
  for (int d = 0; d < 3; d++) {
    store(&batch.velocity_change[d][k], load8(velocity_change.at[d]));
    store(&batch.rotation_change[d][k], load8(rotation_change.at[d]));
  }
}

void BodyBatch::turn_histories(int k)
{
  for (int lane = k; lane < std::min(k + lanes, filled) && vectors.count; lane++) {
    const TriangleTurn turned = task->frame.vertices->turn(part_of_lane[lane]);
    for (int n = 0; n < vectors.count; n++) {
      double *component[3];
      for (int d = 0; d < 3; d++) component[d] = &batch.history[vectors.index[n][d]][lane];
      const Vector now = turned({*component[0], *component[1], *component[2]});
      *component[0] = now.x;
      *component[1] = now.y;
      *component[2] = now.z;
    }
  }
}

/* The reaction of the contact as add_load() has it, about the point where the surface is touched. */

void BodyBatch::record_corners()
{
  for (int lane = 0; lane < filled; lane++) {
    const Vector n = Talus::lane_of(batch.normal, lane), f = Talus::lane_of(batch.force, lane);
    const double r = radius[lane];
    Vector torque = batch.overlap[lane] * cross(n, f);
    if (law.resists())
      torque = torque - (Talus::lane_of(batch.twisting_torque, lane) -
                         r * (Talus::lane_of(batch.torque_per_radius, lane) - cross(n, f)));
    TouchedCorners touch{part_of_lane[lane], {}};
    MovingVertices::share_out(point_of_lane[lane], -f, torque, touch.force);
    touch.triangle = task->frame.vertices->own_triangle(touch.triangle);
    corners.push_back(touch);
  }
}

}    // namespace Talus
