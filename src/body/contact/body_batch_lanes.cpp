// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What laws read of particles, to lanes; and forces, torques and histories from lanes to where they
// are kept.

#include "body/contact/body_batch.h"

#include <algorithm>

namespace Talus {
namespace {

using Lanes = double[3][ContactBatch::width];

inline Vector3<Vec8> vector_at(const Lanes &v, int k)
{
  return {load8(&v[0][k]), load8(&v[1][k]), load8(&v[2][k])};
}

inline void store_at(Lanes &to, int k, const Vector3<Vec8> &v)
{
  store(&to[0][k], v.x);
  store(&to[1][k], v.y);
  store(&to[2][k], v.z);
}

inline EightRows rows_of(const Vector3<Vec8> &v, Vec8 fourth)
{
  return {{v.x, v.y, v.z, fourth}};
}

inline double sum_of(Vec8 lane)
{
  double sum = 0.0;
  for (int k = 0; k < lanes; k++) sum += lane[k];
  return sum;
}

}    // namespace

/* Seen from the body, the particle moves with its velocity less that which the body would have at
   its center, and turns with its omega less the body's: so sliding, rolling and twisting are those
   of the two surfaces. A body that is not free is infinitely heavy: m_eff is the mass of the
   particle. R_eff is its radius. */

void BodyBatch::gather()
{
  const BodyFrame &frame = task->frame;
  for (int k = 0; k < end; k += lanes) {
    int index[lanes];
    for (int q = 0; q < lanes; q++) index[q] = task->index[candidate_of_lane[k + q]];
    Motion m = task->view.motion_at([&](int q) { return index[q]; }, load8(&radius[k]),
                                    law.has_friction());
    if (task->step.masses) gather_masses(m, k);
    const bool second_order = law.tangential().second_order;
    if (second_order || task->step.account) gather_changes(index, k);
    if (frame.moves) {
      if (second_order)
        see_from_body(m, k);
      else {
        m.velocity = frame.to_body(m.velocity - frame.velocity_at(vector_at(place, k)));
        m.omega = frame.to_body(m.omega - in_all_lanes<Vec8>(frame.state.omega));
        if (task->step.account) see_changes_from_body(k);
      }
      m.inverse_mass = m.inverse_mass + splat<Vec8>(frame.inverse_mass);
    }
    if (frame.runs) run_past(m, k);
    if (described) m.velocity = m.velocity - vector_at(surface_velocity, k);
    if (frame.vertices) see_from_vertices(m, k);
    store_at(batch.velocity, k, m.velocity);
    store(&batch.inverse_mass[k], m.inverse_mass);
    store(&batch.inverse_radius[k], m.inverse_radius + load8(&curvature[k]));
    if (law.has_friction()) store_at(batch.surface_rotation, k, load8(&radius[k]) * m.omega);
    if (law.resists()) {
      store_at(batch.relative_omega, k, m.omega);
      store_at(batch.omega_change, k, m.inverse_radius * vector_at(batch.rotation_change, k));
    }
    if (needs_normal_changes() && !task->history.several()) gather_normal_changes(k);
    if (task->with_history) gather_histories(k);
    if (task->with_history && task->step.advance && frame.vertices) turn_histories(k);
  }
  if (law.resists()) gather_resistance();
  if (task->step.heat.temperature) gather_temperatures();
  if (!task->laws.uniform()) gather_coefficients();
}

/* The velocities are those half a step before, in the frame that the body had then, the changes lead
   to those of the present in its frame: so displacements and damping have both where they belong. */

void BodyBatch::see_from_body(Motion &m, int k)
{
  const BodyFrame &frame = task->frame;
  const Vector3<Vec8> x = vector_at(place, k), v = m.velocity, omega = m.omega;
  const Vec8 r = load8(&radius[k]);
  m.velocity = frame.half_way.velocity_seen(v, x - splat<Vec8>(task->step.lag) * v);
  m.omega = frame.half_way.omega_seen(omega);
  const Vector3<Vec8> velocity =
      frame.present.velocity_seen(v + vector_at(batch.velocity_change, k), x);
  const Vector3<Vec8> rotation =
      rotated_back(frame.present.rotation, r * (omega - in_all_lanes<Vec8>(frame.present.omega)) +
                                               vector_at(batch.rotation_change, k));
  store_at(batch.velocity_change, k, velocity - m.velocity);
  store_at(batch.rotation_change, k, rotation - r * m.omega);
}

/* Only the part of the surface's velocity counts that is tangential at the contact: to second order
   where that was half a step before, and of the changes where it is now. */

void BodyBatch::run_past(Motion &m, int k)
{
  const Vector3<Vec8> surface = in_all_lanes<Vec8>(task->frame.surface_velocity),
                      n = vector_at(batch.normal, k);
  const Vector3<Vec8> now = surface - dot(surface, n) * n;
  if (!law.tangential().second_order) {
    m.velocity = m.velocity - now;
    return;
  }
  alignas(64) double before[3][lanes];
  for (int q = 0; q < lanes; q++) {
    const Vector3<double> normal =
        normal_before(k + q, {m.velocity.x[q], m.velocity.y[q], m.velocity.z[q]});
    before[0][q] = normal.x;
    before[1][q] = normal.y;
    before[2][q] = normal.z;
  }
  const Vector3<Vec8> n_before{load8(before[0]), load8(before[1]), load8(before[2])};
  const Vector3<Vec8> then = surface - dot(surface, n_before) * n_before;
  m.velocity = m.velocity - then;
  store_at(batch.velocity_change, k, vector_at(batch.velocity_change, k) - (now - then));
}

/* At the time of the velocities; a contact that was not there has the normal of now. It is computed
   and not stored, so that the setup of a run finds the same bits. */

Vector3<double> BodyBatch::normal_before(int lane, const Vector3<double> &velocity) const
{
  const Vector3<double> now{batch.normal[0][lane], batch.normal[1][lane], batch.normal[2][lane]};
  const Vector3<double> at =
      task->frame.point_to_body(Vector3<double>{place[0][lane], place[1][lane], place[2][lane]});
  const Vector3<double> x = at - task->step.lag * velocity;
  SurfaceContact found_then[LargeBodyShape::max_parts];
  bool may_touch = true;
  const bool several = task->shape.most_contacts() > 1;
  const std::size_t c = candidate_of_lane[lane];
  const NearParts near =
      several ? task->candidates.parts_near(task->frame, c, x, radius[lane], may_touch)
              : NearParts{nullptr, nullptr};
  const int count = may_touch ? task->shape.find_contacts(x, radius[lane], near, found_then) : 0;
  Vector3<double> nearest = now;
  double largest = 0.8;    // as of contacts that go on, see BodyHistory
  for (int n = 0; n < count; n++) {
    const double cosine = dot(found_then[n].normal, now);
    if (cosine <= largest) continue;
    largest = cosine;
    nearest = found_then[n].normal;
  }
  return nearest;
}

void BodyBatch::see_changes_from_body(int k)
{
  const BodyFrame &frame = task->frame;
  const Vector3<Vec8> arm = vector_at(place, k) - in_all_lanes<Vec8>(frame.state.position),
                      omega = in_all_lanes<Vec8>(frame.omega_change);
  const Vector3<Vec8> velocity = vector_at(batch.velocity_change, k) -
                                 in_all_lanes<Vec8>(frame.velocity_change) - cross(omega, arm);
  const Vector3<Vec8> rotation = vector_at(batch.rotation_change, k) - load8(&radius[k]) * omega;
  store_at(batch.velocity_change, k, frame.to_body(velocity));
  store_at(batch.rotation_change, k, frame.to_body(rotation));
}

/* Without a pair style of Talus they are not kept. */

void BodyBatch::gather_changes(const int *index, int k)
{
  const ChangeRecord *const change = task->view.changes();
  for (int half = 0; half < lanes; half += 4) {
    Float8 row[4];
    for (int q = 0; q < 4; q++) row[q] = change ? load8(change[index[half + q]]) : Float8{};
    to_lanes(row, batch.velocity_change, batch.rotation_change, k + half);
  }
}

/* Of shapes with several contacts it is known since they were found. Lanes behind the last contact
   have the geometry of others. */

void BodyBatch::gather_normal_changes(int k)
{
  for (int q = k; q < std::min(k + lanes, filled); q++) {
    const Vector3<double> n{batch.normal[0][q], batch.normal[1][q], batch.normal[2][q]};
    set_normal_change(q, n, task->history.replace_normal(slots()[q], n));
  }
}

void BodyBatch::set_normal_change(int lane, const Vector3<double> &normal,
                                  const Vector3<double> &before)
{
  const bool known = before.x != 0.0 || before.y != 0.0 || before.z != 0.0;
  const Vector3<double> change = known ? normal - before : Vector3<double>{0.0, 0.0, 0.0};
  batch.normal_change[0][lane] = change.x;
  batch.normal_change[1][lane] = change.y;
  batch.normal_change[2][lane] = change.z;
}

void BodyBatch::gather_histories(int k)
{
  const std::uint32_t *const slot = slots() + k;
  for (int r = 0; r < task->history_records; r++) {
    const EightRows values =
        to_lanes([&](int q) -> const Record & { return task->history.record(slot[q], r); });
    for (int n = 0; n < 4; n++) store(&batch.history[4 * r + n][k], values.number[n]);
  }
}

/* The body is flat on the scale of the contact: the circle in which it cuts the sphere. */

void BodyBatch::gather_resistance()
{
  const Vec8 zero{};
  for (int k = 0; k < end; k += lanes) {
    const Vec8 r = load8(&radius[k]), d = load8(&batch.overlap[k]);
    const Vec8 square = 2.0 * r * d - d * d;
    store(&batch.intersection_radius[k], square_root(select(square < zero, zero, square)));
  }
}

void BodyBatch::gather_coefficients()
{
  for (int k = 0; k < end; k++) batch.coefficients[k] = task->row_of(candidate_of_lane[k]);
}

void BodyBatch::gather_masses(Motion &m, int k) const
{
  alignas(64) double mass[lanes];
  for (int q = 0; q < lanes; q++)
    mass[q] = task->step.masses[task->candidates.atom(candidate_of_lane[k + q])];
  m.inverse_mass = splat<Vec8>(1.0) / load8(mass);
}

void BodyBatch::gather_temperatures()
{
  const BodyHeat &heat = task->step.heat;
  for (int k = 0; k < filled; k++)
    batch.temperature_difference[k] =
        heat.of_body - heat.temperature[task->candidates.atom(candidate_of_lane[k])];
}

void BodyBatch::keep_histories()
{
  const std::uint32_t *const slot = slots();
  for (int r = 0; r < task->history_records; r++)
    for (int k = 0; k < filled; k += lanes) {
      EightRows values;
      for (int n = 0; n < 4; n++) values.number[n] = load8(&batch.history[4 * r + n][k]);
      Record of_contact[lanes];
      to_rows(values, of_contact);
      for (int q = 0; q < std::min(lanes, filled - k); q++)
        task->history.record(slot[k + q], r) = of_contact[q];
    }
}

/* From here on normals, forces and torques are in space axes. */

void BodyBatch::rotate_to_space()
{
  for (int k = 0; k < end; k += lanes) {
    const auto rotate = [&](Lanes &v) { store_at(v, k, task->frame.to_space(vector_at(v, k))); };
    rotate(batch.normal);
    rotate(batch.force);
    if (law.has_friction()) rotate(batch.torque_per_radius);
    if (law.resists()) rotate(batch.twisting_torque);
  }
}

/* twisting_torque - r torque_per_radius */

EightRows BodyBatch::torques(int k) const
{
  Vector3<Vec8> torque = -load8(&radius[k]) * vector_at(batch.torque_per_radius, k);
  if (law.resists()) torque = vector_at(batch.twisting_torque, k) + torque;
  return rows_of(torque, Vec8{});
}

void BodyBatch::add_to_particles()
{
  const bool turns = law.has_friction();
  for (int k = 0; k < filled; k += lanes) {
    const EightRows force = rows_of(vector_at(batch.force, k), Vec8{}),
                    torque = turns ? torques(k) : EightRows{};
    task->view.add_at([&](int q) { return task->index[candidate_of_lane[k + q]]; },
                      std::min(lanes, filled - k), force, turns ? &torque : nullptr);
  }
}

void BodyBatch::add_heat()
{
  for (int k = 0; k < filled; k++) {
    task->step.heat.flow[task->candidates.atom(candidate_of_lane[k])] += batch.heat_flow[k];
    load.heat -= batch.heat_flow[k];
  }
}

/* The reaction acts where the lever arm of the particle ends, r along the normal, and rolling and
   twisting resistance act as twisting torques of opposite sign: so forces and torques of particle
   and body balance exactly. */

void BodyBatch::add_load()
{
  for (auto *vector : {batch.force, batch.torque_per_radius, batch.twisting_torque})
    for (int d = 0; d < 3; d++) std::fill(vector[d] + filled, vector[d] + end, 0.0);
  const BodyFrame &frame = task->frame;
  const Vector3<Vec8> about = in_all_lanes<Vec8>(frame.moves ? frame.state.position : frame.origin);
  for (int k = 0; k < end; k += lanes) {
    const Vec8 r = load8(&radius[k]);
    const Vector3<Vec8> force = vector_at(batch.force, k), normal = vector_at(batch.normal, k);
    const Vector3<Vec8> arm = vector_at(place, k) - r * normal - about;
    Vector3<Vec8> torque = -cross(arm, force);
    if (law.resists())
      torque = torque - (vector_at(batch.twisting_torque, k) -
                         r * (vector_at(batch.torque_per_radius, k) - cross(normal, force)));
    load_of_lanes[0] = load_of_lanes[0] - force;
    load_of_lanes[1] = load_of_lanes[1] + torque;
    for (int q = 0; q < std::min(lanes, filled - k) && task->step.exact; q++)
      exact.add({-force.x[q], -force.y[q], -force.z[q]}, {torque.x[q], torque.y[q], torque.z[q]});
  }
}

/* Branch from the surface to the center, times force: xx yy zz xy xz yz. */

void BodyBatch::add_virials()
{
  for (int lane = 0; lane < filled; lane++) {
    const double r = radius[lane];
    const Vector3<double> f{batch.force[0][lane], batch.force[1][lane], batch.force[2][lane]};
    const Vector3<double> b{r * batch.normal[0][lane], r * batch.normal[1][lane],
                            r * batch.normal[2][lane]};
    double *const v = task->step.virial + 6L * task->candidates.atom(candidate_of_lane[lane]);
    v[0] += b.x * f.x;
    v[1] += b.y * f.y;
    v[2] += b.z * f.z;
    v[3] += b.x * f.y;
    v[4] += b.x * f.z;
    v[5] += b.y * f.z;
  }
}

void BodyBatch::sum_up()
{
  const auto sum = [](const Vector3<Vec8> &lane) {
    return Vector3<double>{sum_of(lane.x), sum_of(lane.y), sum_of(lane.z)};
  };
  load.add({sum(load_of_lanes[0]), sum(load_of_lanes[1]), touching});
}

}    // namespace Talus
