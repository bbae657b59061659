// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What is kept of contacts: the deepest one, work, loads of parts, and all of them for outputs.

#include "body/contact/body_batch.h"

#include <algorithm>

namespace Talus {

/* Contacts of eight at a time are compared with the deepest one so far. */

void BodyBatch::notice_deeper()
{
  const auto is_deeper = [this](int k) {
    return load8(&batch.overlap[k]) > deepest_so_far.overlap_ratio * load8(&radius[k]);
  };
  bool any_deeper = false;
  for (int k = 0; k < end && !any_deeper; k += lanes) any_deeper = any(is_deeper(k));
  if (!any_deeper) return;
  for (int lane = 0; lane < filled; lane++) {
    const double ratio = batch.overlap[lane] / radius[lane];
    if (!(ratio > deepest_so_far.overlap_ratio)) continue;
    deepest_so_far = {ratio, task->candidates.atom(candidate_of_lane[lane]), part_of(lane)};
  }
}

void BodyBatch::account()
{
  for (int lane = 0; lane < filled; lane++) {
    const EnergyByCause contact_work = work_of_lane(batch, lane);
    work += contact_work;
    add_work(*task->step.account, task->candidates.atom(candidate_of_lane[lane]), contact_work,
             1.0);
  }
}

/* For outputs; -1 without parts. */

int BodyBatch::part_of(int lane) const
{
  if (!described && task->shape.most_contacts() == 1) return -1;
  const MovingVertices *const vertices = task->frame.vertices;
  return vertices ? vertices->own_triangle(part_of_lane[lane]) : part_of_lane[lane];
}

/* What laws are about to read: some of them change it. */

void BodyBatch::begin_records()
{
  before_laws.clear();
  for (int lane = 0; lane < filled; lane++) before_laws.push_back(state_of_lane(batch, lane));
}

/* Forces and torques are in space axes by now. Gaps through which nothing but heat passes are no contacts. */

ContactReport BodyBatch::report_of_lane(int lane) const
{
  const ContactState<double> &state = before_laws[lane];
  ContactReport to;
  to.i = task->candidates.atom(candidate_of_lane[lane]);
  to.part = part_of(lane);
  to.center[0] = lane_of(place, lane);
  to.normal = task->frame.to_space(state.normal);
  to.overlap = state.overlap;
  to.force = lane_of(batch.force, lane);
  if (law.has_friction()) to.torque_per_radius = lane_of(batch.torque_per_radius, lane);
  if (law.resists()) to.twisting_torque = lane_of(batch.twisting_torque, lane);
  if (law.conducts_heat()) to.heat_flow = batch.heat_flow[lane];
  for (int n = 0; task->with_history && n < 4 * task->history_records; n++)
    to.history[n] = batch.history[n][lane];
  const int row = batch.coefficients[lane];
  to.stored =
      Talus::stored_energy(law, task->laws.coefficients(row), state, task->step.dt, to.history);
  to.set_arms_of_spheres(radius[lane], 0.0);
  return to;
}

void BodyBatch::complete_records()
{
  const bool listed = task->step.for_outputs->are_listed();
  for (int lane = 0; lane < filled; lane++) {
    if (law.reaches() && !(before_laws[lane].overlap > 0.0)) continue;
    const ContactReport one = report_of_lane(lane);
    stored_energy += kept_energy(one);
    if (listed) contacts_for_outputs.push_back(one);
  }
}

void BodyBatch::record_parts()
{
  for (int lane = 0; lane < filled; lane++) {
    const Vector3<double> n = lane_of(batch.normal, lane), f = lane_of(batch.force, lane);
    const Vector3<double> v = lane_of(batch.velocity, lane);
    const double pressed = dot(f, n);
    const Vector3<double> slip =
        v - dot(v, n) * n - cross(lane_of(batch.surface_rotation, lane), n);
    const Vector3<double> shear =
        law.has_friction() ? -(f - pressed * n) : Vector3<double>{0.0, 0.0, 0.0};
    const double heat = law.conducts_heat() ? -batch.heat_flow[lane] : 0.0;
    touched.push_back({part_of_lane[lane], pressed, -f, shear, dot(shear, slip), heat});
  }
}

}    // namespace Talus
