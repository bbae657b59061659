// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/resting_body_batch.h"

#include "body/lane_bits.h"

#include <algorithm>

namespace Talus {
namespace {

using Lanes = double[3][ContactBatch::width];
constexpr int width = EightSpheres::width;
constexpr std::size_t ahead = 32;    // candidates whose positions are called into the cache
static_assert(width == lanes && ahead + width <= SlottedCandidates::spare);

/// Four records become lanes k ... k+3 of a vector and of a scalar.
inline void spread(Vec4 *rows, Lanes &vector, double *fourth, int k)
{
  transpose(rows[0], rows[1], rows[2], rows[3]);
  for (int q = 0; q < 3; q++) store(&vector[q][k], rows[q]);
  if (fourth) store(&fourth[k], rows[3]);
}

inline Vector3<Vec8> vector_at(const Lanes &v, int k)
{
  return {load8(&v[0][k]), load8(&v[1][k]), load8(&v[2][k])};
}

inline void add_to(double *sum, Vec8 value)
{
  store(sum, load8(sum) + value);
}

inline double sum_of(const double *lane)
{
  double sum = 0.0;
  for (int k = 0; k < lanes; k++) sum += lane[k];
  return sum;
}

}    // namespace

bool RestingBodyBatch::serves(const BodyTask &task)
{
  return task.view.records && !task.frame.moves && !task.exact && !task.record_parts &&
         !task.energies && !task.view.virial;
}

void RestingBodyBatch::compute(const LargeBodyShape &its_shape, const BodyTask &its_task,
                               const SlottedCandidates &its_candidates, SparseHistory &its_history,
                               std::size_t begin, std::size_t last)
{
  shape = &its_shape;
  task = &its_task;
  candidates = &its_candidates;
  history = &its_history;
  touching = 0.0;
  for (auto &sum : sums) std::fill(sum, sum + lanes, 0.0);
  for (law_index = 0; law_index < task->laws.num_laws(); law_index++) {
    law = task->laws.distinct_law(law_index);
    for (std::size_t c = begin; c < last; c += width)
      look_at(c, static_cast<int>(std::min<std::size_t>(last - c, width)));
    flush();
  }
  sum_up();
}

/* Those of eight candidates that have this law. */

unsigned RestingBodyBatch::bits_of_law(std::size_t first, int count) const
{
  const unsigned all = (1U << count) - 1U;
  if (task->laws.num_laws() == 1) return all;
  unsigned bits = 0;
  for (int k = 0; k < count; k++) {
    const int row = task->row_of(candidates->atoms[first + k]);
    bits |= (task->laws.law_index(row) == law_index ? 1U : 0U) << k;
  }
  return bits;
}

void RestingBodyBatch::look_at(std::size_t first, int count)
{
  const Record *const positions = task->view.records->position.data();
  const int *const slot = &candidates->slots[first];
  for (int k = 0; k < width; k++) __builtin_prefetch(positions + slot[ahead + k]);
  for (int k = 0; k < width; k += 4) {
    Vec4 rows[4];
    for (int q = 0; q < 4; q++) rows[q] = load4(positions[slot[k + q]]);
    transpose(rows[0], rows[1], rows[2], rows[3]);
    for (int q = 0; q < 3; q++) store(&spheres.centre[q][k], rows[q]);
    store(&spheres.radius[k], rows[3]);
  }
  const unsigned asked = bits_of_law(first, count);
  const unsigned bits = shape->touches_eight(spheres, count, contacts) & asked;
  if (task->with_history) history->set_touching(first / width, asked, bits);
  if (bits) take(first, bits);
}

/* What the batch needs of these particles besides is called into the cache until it is full. */

void RestingBodyBatch::take(std::size_t first, unsigned bits)
{
  const ParticleRecords &records = *task->view.records;
  for (unsigned rest = bits; rest; rest &= rest - 1U) {
    const std::size_t at = records.stride * candidates->slots[first + __builtin_ctz(rest)];
    __builtin_prefetch(&records.motion[at]);
    __builtin_prefetch(&records.load[at], 1);
  }
  for (int d = 0; d < 3; d++) {
    pack_lanes(&place[d][filled], spheres.centre[d], bits);
    pack_lanes(&batch.normal[d][filled], contacts.normal[d], bits);
  }
  pack_lanes(&radius[filled], spheres.radius, bits);
  pack_lanes(&batch.overlap[filled], contacts.overlap, bits);
  filled += store_places(&candidate_of_lane[filled], static_cast<std::uint32_t>(first), bits);
  if (filled > ContactBatch::width - width) flush();    // no room for eight more
}

/* Lanes behind the last contact repeat it with the geometry of older ones: computed, not used. */

void RestingBodyBatch::flush()
{
  if (!filled) return;
  end = (filled + lanes - 1) / lanes * lanes;
  std::fill(candidate_of_lane + filled, candidate_of_lane + end, candidate_of_lane[filled - 1]);
  gather();
  if (law.resists) gather_resistance();
  if (!task->laws.uniform()) gather_coefficients();
  task->laws.kernel(law_index, task->advance)(batch, 0, end, task->laws.coefficients(), task->dt);
  if (task->with_history && task->advance) keep_histories();
  add_forces();
  add_load();
  touching += filled;
  filled = 0;
}

void RestingBodyBatch::gather()
{
  const ParticleRecords &records = *task->view.records;
  for (int k = 0; k < end; k += 4) {
    int slot[4];
    Vec4 rows[4];
    for (int q = 0; q < 4; q++) {
      slot[q] = candidates->slots[candidate_of_lane[k + q]];
      rows[q] = load4(records.velocity(slot[q]));
    }
    spread(rows, batch.velocity, batch.inverse_mass, k);
    if (law.has_friction())
      gather_spins(k, slot);
    else
      store(&batch.inverse_radius[k], Vec4{1.0, 1.0, 1.0, 1.0} / load4(&radius[k]));
    if (task->with_history) gather_histories(k);
  }
}

void RestingBodyBatch::gather_spins(int k, const int *slot)
{
  Vec4 rows[4];
  for (int q = 0; q < 4; q++) rows[q] = load4(task->view.records->spin(slot[q]));
  spread(rows, batch.relative_spin, batch.inverse_radius, k);
  for (int d = 0; d < 3; d++) store(&batch.spin[d][k], load4(&radius[k]) * rows[d]);
}

void RestingBodyBatch::gather_histories(int k)
{
  Vec4 rows[4];
  for (int q = 0; q < 4; q++) rows[q] = load4(history->record(candidate_of_lane[k + q]));
  spread(rows, batch.displacement, batch.at_limit, k);
  if (!task->with_onset) return;
  for (int q = 0; q < 4; q++) rows[q] = load4(history->onset(candidate_of_lane[k + q]));
  spread(rows, batch.onset, nullptr, k);
}

/* The body is flat on the scale of the contact: the circle in which it cuts the sphere. */

void RestingBodyBatch::gather_resistance()
{
  const Vec8 zero{};
  for (int k = 0; k < end; k += lanes) {
    const Vec8 r = load8(&radius[k]), d = load8(&batch.overlap[k]);
    const Vec8 square = 2.0 * r * d - d * d;
    store(&batch.circle[k], square_root(select(square < zero, zero, square)));
  }
}

void RestingBodyBatch::gather_coefficients()
{
  for (int k = 0; k < end; k++)
    batch.coefficients[k] = task->row_of(candidates->atoms[candidate_of_lane[k]]);
}

/* Force, and torque couple - r moment. */

void RestingBodyBatch::add_forces()
{
  ParticleRecords &records = *task->view.records;
  const bool turns = law.has_friction();
  for (int k = 0; k < filled; k += 4) {
    Vec4 force[4], torque[4];
    for (int d = 0; d < 3; d++) {
      force[d] = load4(&batch.force[d][k]);
      if (!turns) continue;
      torque[d] = -load4(&radius[k]) * load4(&batch.moment[d][k]);
      if (law.resists) torque[d] = load4(&batch.couple[d][k]) + torque[d];
    }
    force[3] = torque[3] = Vec4{};
    transpose(force[0], force[1], force[2], force[3]);
    if (turns) transpose(torque[0], torque[1], torque[2], torque[3]);
    for (int q = 0; q < std::min(4, filled - k); q++) {
      const int slot = candidates->slots[candidate_of_lane[k + q]];
      if (turns) records.settle_torque(slot);
      Record *const load = &records.load[records.stride * slot];
      store(load[0], load4(load[0]) + force[q]);
      if (turns) store(load[1], load4(load[1]) + torque[q]);
    }
  }
}

void RestingBodyBatch::keep_histories()
{
  for (int k = 0; k < filled; k += 4) {
    Vec4 row[4], onset[4];
    for (int d = 0; d < 3; d++) {
      row[d] = load4(&batch.displacement[d][k]);
      onset[d] = load4(&batch.onset[d][k]);
    }
    row[3] = load4(&batch.at_limit[k]);
    onset[3] = Vec4{};
    transpose(row[0], row[1], row[2], row[3]);
    if (task->with_onset) transpose(onset[0], onset[1], onset[2], onset[3]);
    for (int q = 0; q < std::min(4, filled - k); q++) {
      store(history->record(candidate_of_lane[k + q]), row[q]);
      if (task->with_onset) store(history->onset(candidate_of_lane[k + q]), onset[q]);
    }
  }
}

/* The reaction, as in BodyBatch::apply(). */

void RestingBodyBatch::add_load()
{
  for (auto *vector : {batch.force, batch.moment, batch.couple})
    for (int d = 0; d < 3; d++) std::fill(vector[d] + filled, vector[d] + end, 0.0);
  const Vector3<double> &o = task->frame.origin;
  const Vector3<Vec8> about{splat<Vec8>(o.x), splat<Vec8>(o.y), splat<Vec8>(o.z)};
  for (int k = 0; k < end; k += lanes) {
    const Vec8 r = load8(&radius[k]);
    const Vector3<Vec8> force = vector_at(batch.force, k), normal = vector_at(batch.normal, k);
    Vector3<Vec8> torque = cross(vector_at(place, k) - r * normal - about, force);
    if (law.resists)
      torque = torque + vector_at(batch.couple, k) -
               r * (vector_at(batch.moment, k) - cross(normal, force));
    add_to(sums[0], -force.x);
    add_to(sums[1], -force.y);
    add_to(sums[2], -force.z);
    add_to(sums[3], -torque.x);
    add_to(sums[4], -torque.y);
    add_to(sums[5], -torque.z);
  }
}

void RestingBodyBatch::sum_up()
{
  load.force = {sum_of(sums[0]), sum_of(sums[1]), sum_of(sums[2])};
  load.torque = {sum_of(sums[3]), sum_of(sums[4]), sum_of(sums[5])};
  load.contacts = touching;
}

}    // namespace Talus
