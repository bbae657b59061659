// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The vertices of a mesh that another program moves: places that they are to have some steps later. On
// the way there they go along straight lines at constant speed, so that the surface between them deforms.
// What contacts see of it, and how their forces act on vertices, goes by the triangle that they touch:
//
//   velocity at a point   barycentric from those of the corners
//   angular velocity      of the triangle: its normal turns with it, and half the curl of the velocity
//                         in its plane is its part along the normal:
//                         w = 1/(2A) sum over corners of (v.n) e - 1/2 (v.e) n, e the edge opposite
//   force f at a point    barycentric to the corners
//   torque m              m.w as a function of the corners' velocities has the derivatives
//                         1/(2A) ((m.e) n - 1/2 (m.n) e): forces on corners whose sum is zero, whose
//                         torque is m, and whose power is that of m on the angular velocity
//
// So a mesh that moves as a rigid body is one, and forces on vertices have the force, the torque and the
// power of the contacts.
//
// Vertices that images of the mesh have (MeshImages) follow those that they stand for. A step:
// advance(), then all others are read until the next one.

#ifndef TALUS_BODY_SHAPE_MOVING_VERTICES_H
#define TALUS_BODY_SHAPE_MOVING_VERTICES_H

#include "base/vector3.h"
#include "body/shape/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace Talus {

/// How a surface moves where a particle touches it: as a rigid body.
struct SurfaceMotion {
  Vector3<double> point, velocity, omega;    ///< velocity: of this point of the surface
  Vector3<double> velocity_at(const Vector3<double> &x) const
  {
    return velocity + cross(omega, x - point);
  }
};

/// A point of a triangle: by shares of its corners, whose sum is 1.
struct SurfacePoint {
  int triangle = 0;
  double share[3] = {1.0, 0.0, 0.0};
  // edges opposite to the second and third corner; unit normal; 1/(twice the area)
  Vector3<double> second{}, third{}, normal{};
  double over_twice_area = 0.0;
};

/// How a triangle has turned: without the stretch of its plane (polar decomposition).
class TriangleTurn {
 public:
  TriangleTurn(const Triangle &from, const Triangle &to);
  Vector3<double> operator()(const Vector3<double> &v) const
  {
    if (none) return v;
    return dot(v, before[0]) * now[0] + dot(v, before[1]) * now[1] + dot(v, before[2]) * now[2];
  }

 private:
  bool none;    // its edges are the same
  Vector3<double> before[3], now[3];
};

class MovingVertices {
 public:
  using Places = std::vector<Vector3<double>>;

  /// At rest. The mesh must live as long as this, which moves its vertices.
  explicit MovingVertices(TriangleMesh &mesh);

  int num_own() const { return mesh.num_own_vertices(); }
  int num_all() const { return mesh.num_vertices(); }
  const Vector3<double> &place(int vertex) const { return mesh.vertex(vertex); }
  /// Where they are to be.
  const Places &target() const { return end; }
  /// These places of the own ones, for all.
  Places with_images(const Places &own) const;

  /// All are to be there after so many steps of this length (time), 0: at once. `velocities`: that
  /// the own ones are to have then, and keep until the next call; on the way velocities go there linearly
  /// from what they are. Without: those of the way, and then none.
  void guide(Places with_images, const Places *velocities, int steps, double dt);
  /// To the next step. Returns whether any may have moved. `order_2`: motion_half_way() will be asked for.
  bool advance(bool order_2);
  /// Contacts have seen the last step: without another one nothing has turned.
  void stand_still();

  /// No vertex has gone further since settle() (length).
  double way() const { return largest_way; }
  void settle();
  /// How far a vertex has gone since then.
  Vector3<double> gone(int vertex) const { return place(vertex) - settled[vertex]; }
  /// And in the last step.
  Vector3<double> gone_in_step(int vertex) const
  {
    return states[vertex].place - states[vertex].before;
  }
  void prefetch(int vertex) const { __builtin_prefetch(&states[vertex]); }

  // ---- the surface, in the last step; triangles may be images

  int own_triangle(int triangle) const { return mesh.own(triangle); }

  /// The point of its plane that is nearest to this one.
  SurfacePoint point_on(int triangle, const Vector3<double> &x) const;
  SurfaceMotion motion(const SurfacePoint &at) const;
  /// Half a step before.
  SurfaceMotion motion_half_way(const SurfacePoint &at) const;
  /// Since the step before, and since half of it.
  TriangleTurn turn(int triangle) const;
  TriangleTurn turn_since_half_way(int triangle) const;
  /// A force that acts at this point, and a torque, as forces on the corners.
  static void share_out(const SurfacePoint &at, const Vector3<double> &force,
                        const Vector3<double> &torque, Vector3<double> *on_corners);

  /// For restart files and snapshots; of what the same mesh was.
  template <class Exchange> void exchange_state(Exchange &x)
  {
    x(steps, left, follows_way, has_jumped, rests, states, start, end, velocity_at_start,
      velocity_at_end, velocity_before);
  }
  /// They are those of this mesh; then what follows from them is found.
  bool state_fits() const;
  void state_is_restored();

  double memory_usage() const;

 private:
  struct State {
    Vector3<double> place, velocity, before;    // before: a step ago
    template <class Exchange> void exchange_state(Exchange &x) { x(place, velocity, before); }
  };
  Places now() const;
  void put(int vertex, const Vector3<double> &x);
  void find_moving();
  void find_way();
  void set_bounds();
  template <class Value> Places for_all(const Places &own, Value of_image) const;
  template <class Value> Triangle corners(int triangle, Value value) const;
  Triangle half_way(int triangle) const;

  TriangleMesh &mesh;    // has the places as well
  int steps = 0, left = 0;
  bool follows_way = true;    // velocities are those of the way
  bool has_jumped = false;    // since the last step; `before` is from before that
  std::vector<State> states;
  Places start, end, velocity_at_start, velocity_at_end;
  Places velocity_before, settled;
  std::vector<int> moving;    // those with a way or a velocity
  int rests = 0;              // steps since they have come to rest, up to 2
  double largest_way = 0.0, largest_step = 0.0;
};

}    // namespace Talus

#endif
