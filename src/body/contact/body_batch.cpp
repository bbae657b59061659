// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/body_batch.h"

#include "laws/tangential/end_of_contact.h"
#include "material/run_laws.h"

#include <algorithm>

namespace Talus {
namespace {

constexpr int width = EightSpheres::width;
constexpr std::size_t ahead = 64;    // candidates whose positions are prefetched
static_assert(width == lanes && ahead + width <= BodyTask::spare);

// the same where each candidate has parts to be looked at, and the parts nearer to their use
constexpr std::size_t position_ahead = 24, list_ahead = 12, parts_ahead = 6;
static_assert(position_ahead <= BodyTask::spare);

Vector3<Vec8> center_of(const EightSpheres &spheres)
{
  const auto &x = spheres.center;
  return {load8(x[0]), load8(x[1]), load8(x[2])};
}

}    // namespace

/* No lane may ever hold what is not finite. */

BodyBatch::BodyBatch()
{
  batch.clear();
  std::fill(radius, radius + ContactBatch::width, 1.0);
}

void BodyBatch::start(bool with_exact)
{
  load = BodyLoad{};
  if (with_exact) exact.clear();
  touched.clear();
  corners.clear();
  contacts_for_outputs.clear();
  work = EnergyByCause{};
}

void BodyBatch::compute(const BodyTask &new_task, std::size_t begin, std::size_t end_of_range)
{
  task = &new_task;
  touching = 0.0;
  load_of_lanes[0] = load_of_lanes[1] = Vector3<Vec8>{};
  const bool several = task->shape.most_contacts() > 1, by_parts = several && !task->wall;
  if (task->wall) set_all_points();
  for (law_index = 0; law_index < task->laws.num_laws(); law_index++) {
    law = task->laws.distinct_law(law_index);
    if (task->frame.vertices) vectors = law.vectors_in_history();
    for (std::size_t c = begin; c < end_of_range && by_parts; c++) look_at_parts(c, end_of_range);
    for (std::size_t c = begin / width * width; c < end_of_range && !by_parts; c += width) {
      const int low = static_cast<int>(begin > c ? begin - c : 0),
                high = static_cast<int>(std::min<std::size_t>(end_of_range - c, width));
      if (several)
        look_at_eight_of_wall(c, low, high);
      else
        look_at_eight(c, low, high);
    }
    flush();
  }
  sum_up();
}

/* Of eight candidates those low ... high-1 that have this law. */

unsigned BodyBatch::bits_of_law(std::size_t first, int low, int high) const
{
  if (task->laws.num_laws() == 1) return (1U << high) - (1U << low);
  unsigned bits = 0;
  for (int k = low; k < high; k++)
    bits |= (task->laws.law_index(task->row_of(first + k)) == law_index ? 1U : 0U) << k;
  return bits;
}

/* Candidates low ... high-1 of eight: the others are not even read, for they may be on their way
   through another thread. */

void BodyBatch::look_at_eight(std::size_t first, int low, int high)
{
  const int *const index = task->index + first;
  for (int k = 0; k < width; k++) task->view.prefetch_position(index[ahead + k]);
  if (task->with_history)
    prefetch_contacts(first + ahead, task->history.touched((first + ahead) / width));
  load_spheres(index, low, high);
  const unsigned asked = bits_of_law(first, low, high);
  const unsigned bits = touching_eight(first, low, high) & asked;
  if (task->with_history) task->history.set_touching(first / width, asked, bits);
  if (bits) take(first, bits);
}

void BodyBatch::load_spheres(const int *index, int low, int high)
{
  task->view.spheres_at([=](int k) { return index[std::clamp(k, low, high - 1)]; }, spheres.center,
                        spheres.radius);
}

const EightSpheres &BodyBatch::spheres_in_body()
{
  if (!task->frame.moves) return spheres;
  const Vector3<Vec8> x = task->frame.point_to_body(center_of(spheres));
  store(seen.center[0], x.x);
  store(seen.center[1], x.y);
  store(seen.center[2], x.z);
  store(seen.radius, load8(spheres.radius));
  return seen;
}

/* Contacts that have begun may last beyond zero overlap. */

unsigned BodyBatch::touching_eight(std::size_t first, int low, int high)
{
  const EightSpheres &in_body = spheres_in_body();
  if (law.tangential().second_order) {
    const unsigned bits = task->shape.touches_eight(in_body, high, contacts);
    const unsigned of_this_thread =
        (1U << high) - (1U << low);    // others may be changed by other threads
    return bits | just_ended(first, in_body,
                             task->history.touched(first / width) & of_this_thread & ~bits);
  }
  if (!law.normal().lasts_beyond_contact) return task->shape.touches_eight(in_body, high, contacts);
  double reach[width] = {};
  widened = in_body;
  for (int k = 0; k < high; k++) {
    reach[k] = task->pulloff_distance_of(first + k, in_body.radius[k]);
    widened.radius[k] += reach[k];
  }
  unsigned bits = task->shape.touches_eight(widened, high, contacts);
  const unsigned begun = task->history.touched(first / width);
  for (unsigned rest = bits; rest; rest &= rest - 1U) {
    const int k = __builtin_ctz(rest);
    contacts.overlap[k] -= reach[k];
    if (!(contacts.overlap[k] > 0.0)) bits &= begun | ~(1U << k);
  }
  return bits;
}

/* Of those contacts that were there, `bits`, those that last for the step in which they end: looked
   for with radii twice as large. */

unsigned BodyBatch::just_ended(std::size_t first, const EightSpheres &in_body, unsigned bits)
{
  unsigned ended = 0;
  for (unsigned rest = bits; rest; rest &= rest - 1U) {
    const int k = __builtin_ctz(rest);
    if (has_just_ended(task->history.record(first + k).c[3], task->advance)) ended |= 1U << k;
  }
  if (!ended) return 0;
  widened = in_body;
  for (int k = 0; k < width; k++) widened.radius[k] *= 2.0;
  EightContacts far;
  ended &= task->shape.touches_eight(widened, width, far);
  for (unsigned rest = ended; rest; rest &= rest - 1U) {
    const int k = __builtin_ctz(rest);
    for (int d = 0; d < 3; d++) contacts.normal[d][k] = far.normal[d][k];
    contacts.overlap[k] = far.overlap[k] - in_body.radius[k];
  }
  return ended;
}

/* What the laws need of particles besides their positions is prefetched of those that probably
   touch: where histories are kept, of those that did in the step before. */

void BodyBatch::prefetch_contacts(std::size_t first, unsigned bits) const
{
  for (; bits; bits &= bits - 1U)
    task->view.prefetch_for_contact(task->index[first + __builtin_ctz(bits)]);
}

void BodyBatch::take(std::size_t first, unsigned bits)
{
  for (int d = 0; d < 3; d++) {
    pack_lanes(&place[d][filled], spheres.center[d], bits);
    pack_lanes(&batch.normal[d][filled], contacts.normal[d], bits);
  }
  pack_lanes(&radius[filled], spheres.radius, bits);
  pack_lanes(&batch.overlap[filled], contacts.overlap, bits);
  if (task->wall) take_points(bits);
  filled += store_places(&candidate_of_lane[filled], static_cast<std::uint32_t>(first), bits);
  prefetch_contacts(first, bits);
  if (filled > ContactBatch::width - width) flush();    // no room for eight more
}

namespace {

/// Of a sphere, by candidate, place in the frame of the body and radius.
class EndsOfContacts : public BodyHistory::Ends {
 public:
  EndsOfContacts(const BodyTask &task, std::size_t c, const Vector3<double> &x, double r) :
      task(task), c(c), x(x), r(r)
  {
  }
  bool lasts(const Record &history) const override
  {
    return has_just_ended(history.c[3], task.advance);
  }
  int look_further(SurfaceContact *found) const override
  {
    constexpr double further = 0.1;    // of the radius: more than a contact opens in one step
    bool may_touch;
    const NearParts near =
        task.candidates.parts_near(task.frame, c, x, (1.0 + further) * r, may_touch);
    const int count = may_touch ? task.shape.find_contacts(x, (1.0 + further) * r, near, found) : 0;
    for (int k = 0; k < count; k++) found[k].overlap -= further * r;
    return count;
  }

 private:
  const BodyTask &task;
  std::size_t c;
  const Vector3<double> &x;
  double r;
};

}    // namespace

void BodyBatch::look_at_parts(std::size_t c, std::size_t last)
{
  prefetch_parts(c, last);
  if (task->laws.law_index(task->row_of(c)) != law_index) return;
  const ParticleState &view = task->view;
  const int i = task->index[c];
  const Vector3<double> place_now = view.position_at(i), x = task->frame.point_to_body(place_now);
  const double r = view.radius_at(i);
  const double reach = law.normal().lasts_beyond_contact ? task->pulloff_distance_of(c, r) : 0.0;
  SurfaceContact found[LargeBodyShape::max_contacts];
  bool may_touch;
  const NearParts near = task->candidates.parts_near(task->frame, c, x, r + reach, may_touch);
  int count = may_touch ? task->shape.find_contacts(x, r + reach, near, found) : 0;
  for (int k = 0; k < count; k++) found[k].overlap -= reach;
  std::size_t slot = 0;
  Vector3<double> before[LargeBodyShape::max_contacts];
  if (task->with_history) {
    slot = task->history.first_slot(c);
    const EndsOfContacts ends(*task, c, x, r);
    count = task->history.continue_contacts(c, found, count, before,
                                            law.tangential().second_order ? &ends : nullptr);
  }
  if (count) view.prefetch_for_contact(i);
  for (int k = 0; k < count; k++) append(c, slot + k, place_now, r, found[k], before[k]);
}

/* Candidates stand far from each other in memory: what one needs is prefetched a while before.
   First its position, then the list of parts, then those that it probably touches. */

void BodyBatch::prefetch_parts(std::size_t c, std::size_t last) const
{
  const ParticleState &view = task->view;
  view.prefetch_position(task->index[c + position_ahead]);
  if (c + list_ahead >= last) return;
  task->candidates.prefetch_list(c + list_ahead, view.radius_at(task->index[c + list_ahead]));
  task->candidates.prefetch_parts(c + parts_ahead, view.radius_at(task->index[c + parts_ahead]),
                                  task->shape);
}

void BodyBatch::append(std::size_t c, std::size_t slot, const Vector3<double> &x, double r,
                       const SurfaceContact &contact, const Vector3<double> &normal_before)
{
  const double at[3] = {x.x, x.y, x.z};
  const double n[3] = {contact.normal.x, contact.normal.y, contact.normal.z};
  for (int d = 0; d < 3; d++) {
    place[d][filled] = at[d];
    batch.normal[d][filled] = n[d];
  }
  radius[filled] = r;
  batch.overlap[filled] = contact.overlap;
  candidate_of_lane[filled] = static_cast<std::uint32_t>(c);
  slot_of_lane[filled] = static_cast<std::uint32_t>(slot);
  part_of_lane[filled] = contact.part;
  if (needs_normal_changes()) {
    const MovingVertices *const vertices = task->frame.vertices;
    const bool turns = vertices && task->advance;
    set_normal_change(filled, contact.normal,
                      turns ? vertices->turn(contact.part)(normal_before) : normal_before);
  }
  if (++filled == ContactBatch::width) flush();
}

/* Lanes behind the last contact repeat it with the geometry of older ones: computed, not used. */

void BodyBatch::flush()
{
  if (!filled) return;
  end = (filled + lanes - 1) / lanes * lanes;
  std::fill(candidate_of_lane + filled, candidate_of_lane + end, candidate_of_lane[filled - 1]);
  std::fill(slot_of_lane + filled, slot_of_lane + end, slot_of_lane[filled - 1]);
  if (task->wall && !task->wall->surface.everywhere())
    std::fill(curvature + filled, curvature + end, 0.0);
  gather();
  batch.lag = task->lag;
  if (!task->wall) notice_deeper();
  if (task->record_contacts) begin_records();
  run_laws(batch, law_index, 0, end, {task->laws, task->dt, task->advance, task->account});
  if (task->with_history && task->advance) keep_histories();
  if (task->account) account();
  if (task->record_parts) record_parts();
  if (task->record_corners) record_corners();
  if (task->frame.turned) rotate_to_space();
  add_to_particles();
  if (task->record_contacts) complete_records();
  if (task->wall)
    add_heat();
  else
    add_load();
  if (task->virial) add_virials();
  touching += filled;
  filled = 0;
}

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
    add_work(*task->account, task->candidates.atom(candidate_of_lane[lane]), contact_work, 1.0);
  }
}

/* For outputs; -1 without parts. */

int BodyBatch::part_of(int lane) const
{
  if (!task->wall && task->shape.most_contacts() == 1) return -1;
  const MovingVertices *const vertices = task->frame.vertices;
  return vertices ? vertices->own_triangle(part_of_lane[lane]) : part_of_lane[lane];
}

/* What laws are about to read: some of them change it. */

void BodyBatch::begin_records()
{
  for (int lane = 0; lane < filled; lane++) {
    ComputedContact &one = contacts_for_outputs.emplace_back();
    one.state = state_of_lane(batch, lane);
    one.row = batch.coefficients[lane];
  }
}

/* Forces and torques are in space axes by now. */

void BodyBatch::complete_records()
{
  const std::size_t before = contacts_for_outputs.size() - filled;
  for (int lane = 0; lane < filled; lane++) {
    ComputedContact &one = contacts_for_outputs[before + lane];
    ContactReport &to = one.report;
    to.i = task->candidates.atom(candidate_of_lane[lane]);
    to.part = part_of(lane);
    to.center[0] = lane_of(place, lane);
    to.normal = task->frame.to_space(one.state.normal);
    to.overlap = one.state.overlap;
    to.force = lane_of(batch.force, lane);
    if (law.has_friction()) to.torque_per_radius = lane_of(batch.torque_per_radius, lane);
    if (law.resists()) to.twisting_torque = lane_of(batch.twisting_torque, lane);
    if (law.conducts_heat()) to.heat_flow = batch.heat_flow[lane];
    for (int n = 0; task->with_history && n < 4 * task->history_records; n++)
      to.history[n] = batch.history[n][lane];
    to.set_arms_of_spheres(radius[lane], 0.0);
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
    touched.push_back({part_of_lane[lane], pressed, -f, shear, dot(shear, slip)});
  }
}

}    // namespace Talus
