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
  stored_energy = 0.0;
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
        look_at_eight_by_parts(c, low, high);
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

/* Contacts that have begun may last beyond zero overlap, and those that reach begin there. */

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
  const unsigned of_this_thread = (1U << high) - (1U << low);
  const unsigned begun = task->history.touched(first / width) & of_this_thread;
  const unsigned touching = task->shape.touches_eight(in_body, high, contacts) & of_this_thread;
  const unsigned asked = (law.reaches() ? of_this_thread : begun) & ~touching;
  if (!asked) return touching;
  const EightSpheres &reaching = as_far_as_contacts_last(first, in_body, asked);
  const unsigned bits = task->shape.touches_eight(reaching, high, contacts);
  for (unsigned rest = bits & asked; rest; rest &= rest - 1U) {
    const int k = __builtin_ctz(rest);
    contacts.overlap[k] -= pulloff[k];
  }
  return bits;
}

/* `asked`: those that are apart and have begun, or that reach; the others need no root. */

const EightSpheres &BodyBatch::as_far_as_contacts_last(std::size_t first,
                                                       const EightSpheres &in_body, unsigned asked)
{
  std::fill(pulloff, pulloff + width, 0.0);
  if (!law.lasts_beyond_contact()) return in_body;
  widened = in_body;
  for (; asked; asked &= asked - 1U) {
    const int k = __builtin_ctz(asked);
    pulloff[k] = task->pulloff_distance_of(first + k, in_body.radius[k]);
    widened.radius[k] += pulloff[k];
  }
  return widened;
}

/* Of those contacts that were there, `bits`, those that last for the step in which they end: looked
   for with radii twice as large. */

unsigned BodyBatch::just_ended(std::size_t first, const EightSpheres &in_body, unsigned bits)
{
  unsigned ended = 0;
  for (; bits; bits &= bits - 1U) {
    const int k = __builtin_ctz(bits);
    if (!has_just_ended(task->history.record(first + k).c[3], task->step.advance)) continue;
    const Vector3<double> x = in_body.at(k);
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
  put_side_by_side(first, bits);
  if (filled > ContactBatch::width - width) flush();    // no room for eight more
}

void BodyBatch::put_side_by_side(std::size_t first, unsigned bits)
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
}

void BodyBatch::take_surface(unsigned bits)
{
  for (int d = 0; d < 3; d++) pack_lanes(&surface_velocity[d][filled], contacts.velocity[d], bits);
  pack_lanes(&curvature[filled], contacts.curvature, bits);
  for (int lane = filled; bits; bits &= bits - 1U, lane++)
    part_of_lane[lane] = contacts.part[__builtin_ctz(bits)];
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
  touching +=
      static_cast<double>(law.reaches() ? std::count_if(batch.overlap, batch.overlap + filled,
                                                        [](double x) { return x > 0.0; })
                                        : filled);
  filled = 0;
}

}    // namespace Talus
