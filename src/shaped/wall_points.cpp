// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shaped/wall_points.h"

#include "base/in_parallel.h"
#include "body/shape/moving_vertices.h"

#include <algorithm>

namespace Talus {
namespace {

constexpr int particles_of_chunk = 64;

}    // namespace

void WallPoints::set_particles(const std::vector<int> &those)
{
  particles = those;
  chunks.clear();
  const int all = static_cast<int>(particles.size());
  for (int begin = 0; begin < all; begin += particles_of_chunk) {
    chunks.emplace_back();
    chunks.back().begin = begin;
    chunks.back().end = std::min(begin + particles_of_chunk, all);
  }
}

void WallPoints::restore(const ContactLists &from)
{
  for (Chunk &chunk : chunks)
    for (int n = chunk.begin; n < chunk.end; n++)
      from.for_each(particles[n], [&](const ContactLists::Contact &one) {
        if (one.partner != name || !(one.feature & ContactLists::of_shape)) return;
        chunk.points.push_back(stored_point(one));
        chunk.of_point.push_back(n);
      });
}

void WallPoints::save(ContactLists &to) const
{
  for (const Chunk &chunk : chunks)
    for (std::size_t k = 0; k < chunk.points.size(); k++)
      keep_history(chunk.points[k], particles[chunk.of_point[k]], name, to);
}

BodyLoad WallPoints::compute(const BodySurfaces &surfaces, const BodyFrame &frame,
                             const ShapedView &view, const LawTable &laws, const BodyStep &step)
{
  while (static_cast<int>(batches.size()) < step.threads)
    batches.push_back(std::make_unique<PointBatch>());
  const Task task{surfaces, frame, view, laws, step};
  in_ranges(static_cast<std::int64_t>(chunks.size()), step.threads, [&](int t, int begin, int end) {
    for (int c = begin; c < end; c++) {
      Chunk &chunk = chunks[c];
      std::swap(chunk.points, chunk.before);
      std::swap(chunk.of_point, chunk.of_before);
      chunk.points.clear();
      chunk.of_point.clear();
      std::size_t old = 0;
      for (int n = chunk.begin; n < chunk.end; n++) find_points(task, chunk, n, old);
      batches[t]->compute({laws, step.dt, step.advance, step.account}, chunk.points.data(),
                          chunk.points.size());
      add_forces(task, chunk);
    }
  });
  if (step.account) account(*step.account);
  if (step.for_outputs) record_contacts(task);
  BodyLoad load;
  for (const Chunk &chunk : chunks) {
    load.add(chunk.load);
    if (step.exact) step.exact->add(chunk.exact);
    if (step.touched)
      step.touched->insert(step.touched->end(), chunk.touched.begin(), chunk.touched.end());
    if (step.corners)
      step.corners->insert(step.corners->end(), chunk.corners.begin(), chunk.corners.end());
  }
  return load;
}

/* What the particle does is seen from the body: its velocity less that which the body has at the
   same point. */

void WallPoints::find_points(const Task &task, Chunk &chunk, int n, std::size_t &old) const
{
  const std::size_t known = old;
  while (old < chunk.of_before.size() && chunk.of_before[old] == n) old++;
  const ShapedView &view = task.view;
  const BodyFrame &frame = task.frame;
  const int i = particles[n];
  const ParticleShape &particle = *shapes.of(view.type(i));
  const Vector3<double> center = view.position(i), seen = frame.point_to_body(center);
  Pose pose = particle.pose(seen, view.quaternion(i));
  if (frame.turned) pose.rotation = frame.rotation.transpose() * pose.rotation;
  const int row = task.laws.row(view.type(i), view.type(i));
  const BodySurfaces::Particle seen_particle{view.type(i), particle.shape(), pose,
                                             task.laws.force_exponent(row)};
  for (int w = 0; w < task.surfaces.size(); w++) {
    if (!task.surfaces.touch(w, seen_particle, chunk.found)) continue;
    const std::size_t first = chunk.points.size();
    PointContact point{};
    point.inverse_mass = view.inverse_mass(i) + frame.inverse_mass;
    point.row = row;
    for (const ShapeContact &one : chunk.found.points) {
      point.place = one.position;
      point.normal = one.normal;
      point.overlap = one.overlap;
      point.weight = one.weight;
      point.energy = one.energy;
      point.inverse_radius = one.curvature[0];
      point.name = (static_cast<std::uint64_t>(w) + one.surface) << 32 | one.name;
      point.part = task.surfaces.has_parts() ? one.part : -1;
      const Vector3<double> place = frame.point_to_space(one.position);
      Vector3<double> v = view.velocity_at(i, place);
      if (frame.moves) v = v - frame.velocity_at(place);
      v = frame.to_body(v);
      if (frame.runs) {
        const Vector3<double> surface = frame.surface_velocity;
        v = v - (surface - dot(surface, one.normal) * one.normal);
      }
      point.velocity = v;
      if (task.step.account) point.velocity_change = change_seen(task, i, place);
      point.is_named_by_place = one.is_named_by_place;
      point.history = {};
      for (std::size_t k = known; !one.is_named_by_place && k < old; k++)
        if (chunk.before[k].name == point.name) point.history = chunk.before[k].history;
      chunk.points.push_back(point);
      chunk.of_point.push_back(n);
      const double ratio = one.overlap / particle.shape().inscribed_radius();
      if (ratio > chunk.deepest.overlap_ratio) chunk.deepest = {ratio, i, point.part};
    }
    PointContact *const those = chunk.points.data() + first;
    const std::size_t count = chunk.points.size() - first;
    continue_at_places(those, count, chunk.before.data() + known, old - known);
    for (std::size_t k = 0; frame.vertices && k < count; k++) see_vertices(task, those[k]);
  }
}

DeepestInBody WallPoints::deepest() const
{
  DeepestInBody most;
  for (const Chunk &chunk : chunks)
    if (chunk.deepest.overlap_ratio > most.overlap_ratio) most = chunk.deepest;
  return most;
}

/* The surface moves at the point as a rigid body, and has turned the history with it: as for spheres, see
   body/contact/body_batch_vertices.cpp. */

void WallPoints::see_vertices(const Task &task, PointContact &point)
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

Vector3<double> WallPoints::change_seen(const Task &task, int i, const Vector3<double> &place)
{
  const BodyFrame &frame = task.frame;
  const Vector3<double> change = task.view.change_at(i, place);
  if (!frame.moves) return frame.to_body(change);
  return frame.to_body(change - frame.velocity_change -
                       cross(frame.omega_change, place - frame.state.position));
}

void WallPoints::account(WorkAccount &to) const
{
  for (const Chunk &chunk : chunks)
    for (std::size_t k = 0; k < chunk.points.size(); k++) {
      to.sum += chunk.points[k].work;
      add_work(to, particles[chunk.of_point[k]], chunk.points[k].work, 1.0);
    }
}

void WallPoints::add_forces(const Task &task, Chunk &chunk) const
{
  const BodyFrame &frame = task.frame;
  const ShapedView &view = task.view;
  chunk.load = BodyLoad{};
  chunk.exact.clear();
  chunk.touched.clear();
  chunk.corners.clear();
  const Vector3<double> about = frame.moves ? frame.state.position : frame.origin;
  for (std::size_t k = 0; k < chunk.points.size(); k++) {
    const PointContact &point = chunk.points[k];
    const int i = particles[chunk.of_point[k]];
    const Vector3<double> force = frame.to_space(point.force),
                          place = frame.point_to_space(point.place);
    const Vector3<double> arm = place - view.position(i), torque = cross(arm, force);
    view.add(i, force, torque);
    const Vector3<double> on_body = -cross(place - about, force);
    chunk.load.add({-force, on_body, 1.0});
    if (task.step.exact) chunk.exact.add(-force, on_body);
    if (task.step.touched) {
      const Vector3<double> &n = point.normal, &v = point.velocity;
      const double pressed = dot(point.force, n);
      const Vector3<double> shear = -(point.force - pressed * n), slip = v - dot(v, n) * n;
      chunk.touched.push_back({point.part, pressed, -point.force, shear, dot(shear, slip)});
    }
    if (task.step.corners) {
      const MovingVertices &vertices = *frame.vertices;
      const SurfacePoint at = vertices.point_on(point.part, point.place);
      const Vector3<double> surface = vertices.motion(at).point;
      TouchedCorners touch{vertices.own_triangle(point.part), {}};
      MovingVertices::share_out(at, -force, -cross(place - surface, force), touch.force);
      chunk.corners.push_back(touch);
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

void WallPoints::record_contacts(const Task &task) const
{
  const BodyFrame &frame = task.frame;
  for (const Chunk &chunk : chunks)
    for (std::size_t k = 0; k < chunk.points.size(); k++) {
      const PointContact &point = chunk.points[k];
      ComputedContact one = PointBatch::contact_of(point);
      ContactReport &to = one.report;
      to.i = particles[chunk.of_point[k]];
      to.part = frame.vertices ? frame.vertices->own_triangle(point.part) : point.part;
      to.normal = frame.to_space(to.normal);
      to.force = frame.to_space(to.force);
      to.center[0] = task.view.position(to.i);
      to.arm[0] = frame.point_to_space(point.place) - to.center[0];
      to.torque[0] = cross(to.arm[0], to.force);
      task.step.for_outputs->add(one);
    }
}

double WallPoints::memory_usage() const
{
  std::size_t bytes = particles.capacity() * sizeof(int);
  for (const Chunk &chunk : chunks)
    bytes += (chunk.points.capacity() + chunk.before.capacity()) * sizeof(PointContact);
  return static_cast<double>(bytes);
}

}    // namespace Talus
