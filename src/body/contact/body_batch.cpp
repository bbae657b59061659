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
  described = task->shape.describes_surface();
  const bool several = task->shape.most_contacts() > 1;
  for (law_index = 0; law_index < task->laws.num_laws(); law_index++) {
    law = task->laws.distinct_law(law_index);
    if (task->frame.vertices) vectors = law.vectors_in_history();
    for (std::size_t c = begin / width * width; c < end_of_range; c += width) {
      const int low = static_cast<int>(begin > c ? begin - c : 0),
                high = static_cast<int>(std::min<std::size_t>(end_of_range - c, width));
      if (several)
        look_at_eight_by_parts(c, low, high, end_of_range);
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
  if (!law.lasts_beyond_contact()) return task->shape.touches_eight(in_body, high, contacts);
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
  for (; bits; bits &= bits - 1U) {
    const int k = __builtin_ctz(bits);
    if (!has_just_ended(task->history.record(first + k).c[3], task->step.advance)) continue;
    const Vector3<double> x{in_body.center[0][k], in_body.center[1][k], in_body.center[2][k]};
    const double r = in_body.radius[k];
    SurfaceContact far;
    if (!task->shape.touches(x, 2.0 * r, far)) continue;
    far.overlap -= r;
    contacts.set(k, far);
    ended |= 1U << k;
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
  if (described) take_surface(bits);
  filled += store_places(&candidate_of_lane[filled], static_cast<std::uint32_t>(first), bits);
  prefetch_contacts(first, bits);
  if (filled > ContactBatch::width - width) flush();    // no room for eight more
}

void BodyBatch::take_surface(unsigned bits)
{
  for (int d = 0; d < 3; d++) pack_lanes(&surface_velocity[d][filled], contacts.velocity[d], bits);
  pack_lanes(&curvature[filled], contacts.curvature, bits);
  for (int lane = filled; bits; bits &= bits - 1U, lane++)
    part_of_lane[lane] = contacts.part[__builtin_ctz(bits)];
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
    return has_just_ended(history.c[3], task.step.advance);
  }
  int look_further(SurfaceContact *found) const override
  {
    constexpr double further = 0.1;    // of the radius: more than a contact opens in one step
    bool may_touch;
    const NearParts near =
        task.candidates.parts_near(task.frame, c, x, (1.0 + further) * r, may_touch);
    const int count = may_touch ? task.shape.find_contacts(x, (1.0 + further) * r, near, found) : 0;
    for (int k = 0; k < count; k++) found[k].overlap -= further * r;
    return std::max(count, 0);
  }

 private:
  const BodyTask &task;
  std::size_t c;
  const Vector3<double> &x;
  double r;
};

}    // namespace

/* What cannot touch is not asked for, unless a contact may end. */

void BodyBatch::look_at_eight_by_parts(std::size_t first, int low, int high, std::size_t last)
{
  load_spheres(task->index + first, low, high);
  const EightSpheres &in_body = spheres_in_body();
  const unsigned near = task->shape.may_touch_eight(in_body);
  for (int k = low; k < high; k++) {
    prefetch_parts(first + k, last);
    if ((near >> k & 1U) || (task->with_history && task->history.count(first + k) > 0))
      look_at_parts(first, k, in_body);
  }
}

void BodyBatch::look_at_parts(std::size_t first, int k, const EightSpheres &in_body)
{
  const std::size_t c = first + k;
  if (task->laws.law_index(task->row_of(c)) != law_index) return;
  const Vector3<double> x{in_body.center[0][k], in_body.center[1][k], in_body.center[2][k]};
  const double r = spheres.radius[k];
  const double reach = law.lasts_beyond_contact() ? task->pulloff_distance_of(c, r) : 0.0;
  bool may_touch;
  const NearParts near = task->candidates.parts_near(task->frame, c, x, r + reach, may_touch);
  int count = may_touch ? task->shape.find_contacts(x, r + reach, near, found) : 0;
  if (count < 0) return;
  for (int n = 0; n < count; n++) found[n].overlap -= reach;
  if (task->with_history) {
    const EndsOfContacts ends(*task, c, x, r);
    count = task->history.continue_found(c, found, count, slots_of_found, before,
                                         law.tangential().second_order ? &ends : nullptr);
  }
  if (count) task->view.prefetch_for_contact(task->index[c]);
  for (int n = 0; n < count; n++) append(c, k, n);
}

/* Candidates stand far from each other in memory: what one needs is prefetched a while before.
   First its position, then the list of parts, then those that it probably touches. */

void BodyBatch::prefetch_parts(std::size_t c, std::size_t last) const
{
  const ParticleState &view = task->view;
  view.prefetch_position(task->index[c + position_ahead]);
  if (c + list_ahead >= last || !task->candidates.have_parts()) return;
  task->candidates.prefetch_list(c + list_ahead, view.radius_at(task->index[c + list_ahead]));
  task->candidates.prefetch_parts(c + parts_ahead, view.radius_at(task->index[c + parts_ahead]),
                                  task->shape);
}

/* Contact n of candidate c, the sphere in lane k. */

void BodyBatch::append(std::size_t c, int k, int n)
{
  const SurfaceContact &contact = found[n];
  const double normal[3] = {contact.normal.x, contact.normal.y, contact.normal.z};
  for (int d = 0; d < 3; d++) {
    place[d][filled] = spheres.center[d][k];
    batch.normal[d][filled] = normal[d];
  }
  radius[filled] = spheres.radius[k];
  batch.overlap[filled] = contact.overlap;
  candidate_of_lane[filled] = static_cast<std::uint32_t>(c);
  slot_of_lane[filled] = slots_of_found[n];
  part_of_lane[filled] = contact.part;
  if (described) {
    const double velocity[3] = {contact.velocity.x, contact.velocity.y, contact.velocity.z};
    for (int d = 0; d < 3; d++) surface_velocity[d][filled] = velocity[d];
    curvature[filled] = contact.curvature;
  }
  if (needs_normal_changes()) {
    const MovingVertices *const vertices = task->frame.vertices;
    const bool turns = vertices && task->step.advance;
    set_normal_change(filled, contact.normal,
                      turns ? vertices->turn(contact.part)(before[n]) : before[n]);
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
  if (described) std::fill(curvature + filled, curvature + end, 0.0);
  const BodyStep &step = task->step;
  gather();
  batch.lag = step.lag;
  notice_deeper();
  if (step.for_outputs) begin_records();
  run_laws(batch, law_index, 0, end, {task->laws, step.dt, step.advance, step.account});
  if (task->with_history && step.advance) keep_histories();
  if (step.account) account();
  if (step.touched) record_parts();
  if (step.corners) record_corners();
  if (task->frame.turned) rotate_to_space();
  add_to_particles();
  if (step.for_outputs) complete_records();
  add_load();
  if (step.heat.flow && law.conducts_heat()) add_heat();
  if (step.virial) add_virials();
  touching += filled;
  filled = 0;
}

}    // namespace Talus
