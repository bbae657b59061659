// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/contact/body_points.h"

#include "body/shape/moving_vertices.h"

namespace Talus {
namespace {

constexpr int particles_of_chunk = 64;

template <class One> void append(std::vector<One> *to, const std::vector<One> &more)
{
  if (to) to->insert(to->end(), more.begin(), more.end());
}

}    // namespace

void BodyPoints::set_particles(const ShapedView &view, const std::vector<int> &particles,
                               const ContactLists &from)
{
  is_set = true;
  std::vector<Pair> pairs;
  for (const int i : particles)
    pairs.push_back({i, large_body, {0, name}, shapes.radius_inside(view.type(i), 0.0)});
  set_list(std::move(pairs), view.owned(), particles_of_chunk);
  restore_points(from, [](const Pair &pair) -> Stored { return {pair.first, pair.name[1]}; });
}

BodyLoad BodyPoints::compute(const BodyFrame &frame, const ShapedView &view, const LawTable &laws,
                             const BodyStep &step)
{
  surfaces.follow();
  reactions.resize(chunks.size());
  const Task task{frame, view, laws, step};
  const auto find = [&](Chunk &chunk, Scratch &with) {
    for (int p = chunk.begin; p < chunk.end; p++) find_points(task, chunk, p, with.found[0]);
  };
  const auto add = [&](int c) { add_forces(task, chunks[c], reactions[c]); };
  compute_points({laws, step.dt, step.advance, step.account}, step.threads, find, add);
  if (step.account) account_for_work(*step.account);
  if (step.for_outputs) record_contacts(task);
  BodyLoad load;
  for (const Reaction &reaction : reactions) {
    load.add(reaction.load);
    if (step.exact) step.exact->add(reaction.exact);
    append(step.touched, reaction.touched);
    append(step.corners, reaction.corners);
  }
  return load;
}

void BodyPoints::find_points(const Task &task, Chunk &chunk, int p, ShapeContacts &found) const
{
  const ShapedView &view = task.view;
  const BodyFrame &frame = task.frame;
  const int i = list[p].first, type = view.type(i);
  const ParticleShape &particle = *shapes.of(type);
  Pose pose = particle.pose(frame.point_to_body(view.position(i)), view.quaternion(i));
  if (frame.turned) pose.rotation = frame.rotation.transpose() * pose.rotation;
  const int row = task.laws.row(type, type);
  const double inverse_mass = view.inverse_mass(i) + frame.inverse_mass;
  const BodySurfaces::Particle seen{type, particle.shape(), pose, task.laws.force_exponent(row)};
  for (int w = 0; w < surfaces.size(); w++) {
    if (!surfaces.touch(w, seen, found)) continue;
    const std::size_t first = chunk.points.size();
    take_points(chunk, p, w, found, [&](const ShapeContact &one, PointContact &point) {
      point.row = row;
      point.inverse_mass = inverse_mass;
      point.inverse_radius = one.curvature[0];
      if (!surfaces.has_parts()) point.part = -1;
      see_motion(task, i, point);
    });
    for (std::size_t k = first; frame.vertices && k < chunk.points.size(); k++)
      see_vertices(task, chunk.points[k]);
  }
}

/* What the particle does is seen from the body: its velocity less that which the body has at the
   same point. */

void BodyPoints::see_motion(const Task &task, int i, PointContact &point)
{
  const BodyFrame &frame = task.frame;
  const Vector3<double> place = frame.point_to_space(point.place);
  Vector3<double> v = task.view.velocity_at(i, place);
  if (frame.moves) v = v - frame.velocity_at(place);
  v = frame.to_body(v);
  if (frame.runs) {
    const Vector3<double> surface = frame.surface_velocity;
    v = v - (surface - dot(surface, point.normal) * point.normal);
  }
  point.velocity = v;
  if (!task.step.account) return;
  Vector3<double> change = task.view.change_at(i, place);
  if (frame.moves)
    change =
        change - frame.velocity_change - cross(frame.omega_change, place - frame.state.position);
  point.velocity_change = frame.to_body(change);
}

/* The surface moves at the point as a rigid body, and has turned the history with it: as for spheres, see
   body/contact/body_batch_vertices.cpp. */

void BodyPoints::see_vertices(const Task &task, PointContact &point)
{
  const MovingVertices &vertices = *task.frame.vertices;
  point.velocity =
      point.velocity -
      vertices.motion(vertices.point_on(point.part, point.place)).velocity_at(point.place);
  if (!task.step.advance) return;
  const HistoryVectors vectors = task.laws.law(point.row).vectors_in_history();
  const TriangleTurn turned = vertices.turn(point.part);
  for (int n = 0; n < vectors.count; n++) {
    const std::array<int, 3> &at = vectors.index[n];
    if (at[2] >= point_history_size) continue;
    PointHistory &h = point.history;
    const Vector3<double> now = turned({h[at[0]], h[at[1]], h[at[2]]});
    h[at[0]] = now.x;
    h[at[1]] = now.y;
    h[at[2]] = now.z;
  }
}

void BodyPoints::add_forces(const Task &task, const Chunk &chunk, Reaction &reaction) const
{
  const BodyFrame &frame = task.frame;
  const ShapedView &view = task.view;
  reaction.load = BodyLoad{};
  reaction.exact.clear();
  reaction.touched.clear();
  reaction.corners.clear();
  const Vector3<double> about = frame.moves ? frame.state.position : frame.origin;
  for (std::size_t k = 0; k < chunk.points.size(); k++) {
    const PointContact &point = chunk.points[k];
    const int i = list[chunk.of_point[k]].first;
    const Vector3<double> force = frame.to_space(point.force),
                          place = frame.point_to_space(point.place);
    const Vector3<double> arm = place - view.position(i), torque = cross(arm, force);
    view.add(i, force, torque);
    const Vector3<double> on_body = -cross(place - about, force);
    reaction.load.add({-force, on_body, 1.0});
    if (task.step.exact) reaction.exact.add(-force, on_body);
    if (task.step.touched) {
      const Vector3<double> &n = point.normal, &v = point.velocity;
      const double pressed = dot(point.force, n);
      const Vector3<double> shear = -(point.force - pressed * n), slip = v - dot(v, n) * n;
      reaction.touched.push_back({point.part, pressed, -point.force, shear, dot(shear, slip)});
    }
    if (task.step.corners) {
      const MovingVertices &vertices = *frame.vertices;
      const SurfacePoint at = vertices.point_on(point.part, point.place);
      const Vector3<double> surface = vertices.motion(at).point;
      TouchedCorners touch{vertices.own_triangle(point.part), {}};
      MovingVertices::share_out(at, -force, -cross(place - surface, force), touch.force);
      reaction.corners.push_back(touch);
    }
    if (!task.step.virial) continue;
    double *const virial = task.step.virial + 6L * i;
    virial[0] -= arm.x * force.x;
    virial[1] -= arm.y * force.y;
    virial[2] -= arm.z * force.z;
    virial[3] -= arm.x * force.y;
    virial[4] -= arm.x * force.z;
    virial[5] -= arm.y * force.z;
  }
}

void BodyPoints::record_contacts(const Task &task) const
{
  const BodyFrame &frame = task.frame;
  for_each_point([&](const Pair &pair, const PointContact &point) {
    ComputedContact one = PointBatch::contact_of(point);
    ContactReport &to = one.report;
    to.i = pair.first;
    to.part = frame.vertices ? frame.vertices->own_triangle(point.part) : point.part;
    to.normal = frame.to_space(to.normal);
    to.force = frame.to_space(to.force);
    to.center[0] = task.view.position(to.i);
    to.arm[0] = frame.point_to_space(point.place) - to.center[0];
    to.torque[0] = cross(to.arm[0], to.force);
    task.step.for_outputs->add(one.with_energy(task.laws, task.step.dt));
  });
}

}    // namespace Talus
