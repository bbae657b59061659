// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts with shapes that may touch a sphere at several points, such as meshes.

#include "body/contact/body_batch.h"

#include <algorithm>
#include <functional>

namespace Talus {
namespace {

constexpr int width = EightSpheres::width;
constexpr std::size_t position_ahead = 24;    // candidates whose positions are prefetched
static_assert(position_ahead + width <= BodyTask::spare);

}    // namespace

/* What cannot touch is not asked for, unless a contact may end; nor is what is near one plane only: such spheres
   are dealt with eight at a time. */

void BodyBatch::look_at_eight_by_parts(std::size_t first, int low, int high)
{
  prefetch_parts(first);
  load_spheres(task->index + first, low, high);
  const EightSpheres &in_body = spheres_in_body();
  const unsigned mine = (1U << high) - (1U << low);
  unsigned near = law.reaches() ? mine : task->shape.may_touch_eight(in_body);
  const unsigned last = law.lasts_beyond_contact() ? begun_of(first, mine) | (near & mine) : 0U;
  const EightSpheres &reaching = as_far_as_contacts_last(first, in_body, last);
  unsigned told;
  const unsigned touching = task->candidates.touch_flat(task->shape, task->frame, first / width,
                                                        reaching, contacts, told);
  if (law.reaches()) near = task->shape.may_touch_eight(reaching);
  unsigned rest = bits_of_law(first, low, high);
  while (rest) {    // in their order: what is told before the next one that is not, and this one
    const unsigned to_ask = rest & ~told, next = to_ask & (0U - to_ask);
    const unsigned before_it = rest & (next - 1U);
    take_told(first, in_body, before_it, touching);
    rest &= ~(before_it | next);
    if (!next) continue;
    const int k = __builtin_ctz(next);
    const bool begun = has_begun(first + k);
    if (!(near & next) && !begun) continue;
    const int count = find_by_parts(first + k, reaching.at(k), reaching.radius[k], found);
    if (count > 0 || (count == 0 && begun)) take_found(first + k, in_body, k, count);
  }
}

unsigned BodyBatch::begun_of(std::size_t first, unsigned bits) const
{
  unsigned begun = 0;
  for (; bits; bits &= bits - 1U) {
    const int k = __builtin_ctz(bits);
    begun |= (has_begun(first + k) ? 1U : 0U) << k;
  }
  return begun;
}

/* Of these candidates of eight: without a contact, or with one. */

void BodyBatch::take_told(std::size_t first, const EightSpheres &in_body, unsigned bits,
                          unsigned touching)
{
  for (unsigned ended = bits & ~touching; ended; ended &= ended - 1U) {
    const int k = __builtin_ctz(ended);
    if (has_begun(first + k)) take_found(first + k, in_body, k, 0);
  }
  bits &= touching;
  const bool is_plain = !law.lasts_beyond_contact() && !law.tangential().second_order;
  if (bits && is_plain && filled <= ContactBatch::width - width) {
    take_eight(first, bits);
    return;
  }
  for (; bits; bits &= bits - 1U) {
    const int k = __builtin_ctz(bits);
    *found = contacts.plain(k);
    take_found(first + k, in_body, k, 1);
  }
}

/* The same as take_found() for each of them. */

void BodyBatch::take_eight(std::size_t first, unsigned bits)
{
  int lane = filled;
  for (unsigned rest = bits; rest; rest &= rest - 1U, lane++) {
    const int k = __builtin_ctz(rest);
    SurfaceContact one = contacts.plain(k);
    if (task->with_history)
      task->history.continue_found(first + k, &one, 1, &slot_of_lane[lane], nullptr, nullptr);
    part_of_lane[lane] = one.part;
  }
  put_side_by_side(first, bits);
  if (filled == ContactBatch::width) flush();
}

/* Of a sphere, by candidate, place in the frame of the body and radius. */

int BodyBatch::find_by_parts(std::size_t c, const Vector3<double> &x, double r,
                             SurfaceContact *contacts_found) const
{
  bool may_touch;
  const NearParts near = task->candidates.parts_near(task->frame, c, x, r, may_touch);
  return may_touch ? task->shape.find_contacts(x, r, near, contacts_found) : 0;
}

/* Of candidate c, the sphere in lane k. */

void BodyBatch::take_found(std::size_t c, const EightSpheres &in_body, int k, int count)
{
  for (int n = 0; n < count; n++) found[n].overlap -= pulloff[k];
  if (task->with_history) {
    const auto look_further = [&](SurfaceContact *far) {
      constexpr double further = 0.1;    // of the radius: more than a contact opens in one step
      const double r = spheres.radius[k];
      const int num_far = find_by_parts(c, in_body.at(k), (1.0 + further) * r, far);
      for (int n = 0; n < num_far; n++) far[n].overlap -= further * r;
      return std::max(num_far, 0);
    };
    const bool last = law.tangential().second_order;
    BodyHistory::Ends ends{task->step.advance, {}};
    if (last) ends.look_further = std::cref(look_further);    // needs no memory
    count = task->history.continue_found(c, found, count, slots_of_found, before,
                                         last ? &ends : nullptr, law.reaches());
  }
  if (count) task->view.prefetch_for_contact(task->index[c]);
  for (int n = 0; n < count; n++) append(c, k, n);
}

/* Candidates stand far from each other in memory: what one needs is prefetched a while before.
   First its position, then the list of parts, then those that it probably touches. */

void BodyBatch::prefetch_parts(std::size_t first) const
{
  const ParticleState &view = task->view;
  for (int k = 0; k < width; k++) view.prefetch_position(task->index[first + position_ahead + k]);
  const BodyCandidates &candidates = task->candidates;
  const std::size_t next = first + width, second = next + width;
  for (unsigned bits = candidates.with_parts(second / width); bits; bits &= bits - 1U)
    candidates.prefetch_list(second + __builtin_ctz(bits));
  for (unsigned bits = candidates.with_parts(next / width); bits; bits &= bits - 1U) {
    const std::size_t c = next + __builtin_ctz(bits);
    candidates.prefetch_parts(c, view.radius_at(task->index[c]), task->shape);
  }
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

}    // namespace Talus
