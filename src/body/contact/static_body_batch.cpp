// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/static_body_batch.h"

#include "body/contact/record_lanes.h"

#include <algorithm>

namespace Talus {
namespace {

using Lanes = double[3][ContactBatch::width];
constexpr int width = EightSpheres::width;
constexpr std::size_t ahead = 64;    // candidates whose positions are called into the cache
static_assert(width == lanes && ahead + width <= SlottedCandidates::spare);

inline void store_at(Lanes &vector, int k, const EightRecords &lane)
{
  for (int d = 0; d < 3; d++) store(&vector[d][k], lane.number[d]);
}

inline Vector3<Vec8> vector_at(const Lanes &v, int k)
{
  return {load8(&v[0][k]), load8(&v[1][k]), load8(&v[2][k])};
}

inline EightRecords lanes_of(const Lanes &v, int k)
{
  return {{load8(&v[0][k]), load8(&v[1][k]), load8(&v[2][k]), Vec8{}}};
}

/// Four values of histories, from `first` on.
inline EightRecords history_lanes(const ContactBatch &batch, int first, int k)
{
  EightRecords values;
  for (int n = 0; n < 4; n++) values.number[n] = load8(&batch.history[first + n][k]);
  return values;
}

inline void store_history(ContactBatch &batch, int first, int k, const EightRecords &values)
{
  for (int n = 0; n < 4; n++) store(&batch.history[first + n][k], values.number[n]);
}

/// A force record whose particle has a settled torque, see ParticleRecords::settle_torque().
inline Vec4 settled(Vec4 force)
{
  return __builtin_shufflevector(force, Vec4{1.0, 1.0, 1.0, 1.0}, 0, 1, 2, 4);
}

inline double sum_of(Vec8 lane)
{
  double sum = 0.0;
  for (int k = 0; k < lanes; k++) sum += lane[k];
  return sum;
}

}    // namespace

/* No lane may ever hold what is not finite. */

StaticBodyBatch::StaticBodyBatch()
{
  batch.clear();
  std::fill(radius, radius + ContactBatch::width, 1.0);
}

bool StaticBodyBatch::serves(const BodyTask &task)
{
  return task.view.records && !task.frame.moves && !task.exact && !task.record_parts &&
         !task.energies && !task.view.virial;
}

void StaticBodyBatch::compute(const LargeBodyShape &its_shape, const BodyTask &its_task,
                              const SlottedCandidates &its_candidates, SparseHistory &its_history,
                              std::size_t begin, std::size_t last)
{
  shape = &its_shape;
  task = &its_task;
  candidates = &its_candidates;
  history = &its_history;
  touching = 0.0;
  load_of_lanes[0] = load_of_lanes[1] = Vector3<Vec8>{};
  for (law_index = 0; law_index < task->laws.num_laws(); law_index++) {
    law = task->laws.distinct_law(law_index);
    for (std::size_t c = begin / width * width; c < last; c += width)
      look_at(c, static_cast<int>(begin > c ? begin - c : 0),
              static_cast<int>(std::min<std::size_t>(last - c, width)));
    flush();
  }
  sum_up();
}

/* Of eight candidates those low ... high-1 that have this law. */

unsigned StaticBodyBatch::bits_of_law(std::size_t first, int low, int high) const
{
  if (task->laws.num_laws() == 1) return (1U << high) - (1U << low);
  unsigned bits = 0;
  for (int k = low; k < high; k++) {
    const int row = task->row_of(candidates->atoms[first + k]);
    bits |= (task->laws.law_index(row) == law_index ? 1U : 0U) << k;
  }
  return bits;
}

/* Candidates low ... high-1 of eight: the others are not even read, for they may be on their way
   through another thread. */

void StaticBodyBatch::look_at(std::size_t first, int low, int high)
{
  const Record *const positions = task->view.records->position.data();
  const int *const slot = &candidates->slots[first];
  for (int k = 0; k < width; k++) __builtin_prefetch(positions + slot[ahead + k]);
  if (task->with_history) call(first + ahead, history->touched((first + ahead) / width));
  const EightRecords state = to_lanes(
      [=](int k) -> const Record & { return positions[slot[std::clamp(k, low, high - 1)]]; });
  for (int d = 0; d < 3; d++) store(spheres.center[d], state.number[d]);
  store(spheres.radius, state.number[3]);
  const unsigned asked = bits_of_law(first, low, high);
  const unsigned bits = shape->touches_eight(spheres, high, contacts) & asked;
  if (task->with_history) history->set_touching(first / width, asked, bits);
  if (bits) take(first, bits);
}

/* What the batch needs of particles besides their positions is called into the cache, of those that
   probably touch: where histories are kept, of those that did in the step before. */

void StaticBodyBatch::call(std::size_t first, unsigned bits) const
{
  const ParticleRecords &records = *task->view.records;
  for (; bits; bits &= bits - 1U) {
    const std::size_t at = records.stride * candidates->slots[first + __builtin_ctz(bits)];
    __builtin_prefetch(&records.motion[at]);
    __builtin_prefetch(&records.load[at], 1);
  }
}

void StaticBodyBatch::take(std::size_t first, unsigned bits)
{
  if (!task->with_history) call(first, bits);
  for (int d = 0; d < 3; d++) {
    pack_lanes(&place[d][filled], spheres.center[d], bits);
    pack_lanes(&batch.normal[d][filled], contacts.normal[d], bits);
  }
  pack_lanes(&radius[filled], spheres.radius, bits);
  pack_lanes(&batch.overlap[filled], contacts.overlap, bits);
  const int before = filled;
  filled += store_places(&candidate_of_lane[filled], static_cast<std::uint32_t>(first), bits);
  for (int k = before; k < filled; k++)
    task->view.records->prefetch_for_contact(candidates->slots[candidate_of_lane[k]]);
  if (filled > ContactBatch::width - width) flush();    // no room for eight more
}

/* Lanes behind the last contact repeat it with the geometry of older ones: computed, not used. */

void StaticBodyBatch::flush()
{
  if (!filled) return;
  end = (filled + lanes - 1) / lanes * lanes;
  std::fill(candidate_of_lane + filled, candidate_of_lane + end, candidate_of_lane[filled - 1]);
  gather();
  if (law.resists()) gather_resistance();
  if (!task->laws.uniform()) gather_coefficients();
  task->laws.kernel(law_index, task->advance)(batch, 0, end, task->laws.coefficients(), task->dt);
  if (task->with_history && task->advance) keep_histories();
  add_forces();
  add_load();
  touching += filled;
  filled = 0;
}

void StaticBodyBatch::gather()
{
  const ParticleRecords &records = *task->view.records;
  for (int k = 0; k < end; k += lanes) {
    int slot[lanes];
    for (int q = 0; q < lanes; q++) slot[q] = candidates->slots[candidate_of_lane[k + q]];
    const EightRecords motion =
        to_lanes([&](int q) -> const Record & { return records.velocity(slot[q]); });
    store_at(batch.velocity, k, motion);
    store(&batch.inverse_mass[k], motion.number[3]);
    if (law.has_friction())
      gather_spins(k, slot);
    else
      store(&batch.inverse_radius[k], splat<Vec8>(1.0) / load8(&radius[k]));
    if (task->with_history) gather_histories(k);
  }
}

void StaticBodyBatch::gather_spins(int k, const int *slot)
{
  const ParticleRecords &records = *task->view.records;
  EightRecords spin = to_lanes([&](int q) -> const Record & { return records.spin(slot[q]); });
  if (law.resists()) store_at(batch.relative_omega, k, spin);
  for (int d = 0; d < 3; d++) spin.number[d] = load8(&radius[k]) * spin.number[d];
  store_at(batch.spin, k, spin);
  store(&batch.inverse_radius[k], spin.number[3]);
}

void StaticBodyBatch::gather_histories(int k)
{
  const std::uint32_t *const which = &candidate_of_lane[k];
  store_history(batch, 0, k,
                to_lanes([&](int q) -> const Record & { return history->record(which[q]); }));
  if (task->with_impact)
    store_history(batch, 4, k,
                  to_lanes([&](int q) -> const Record & { return history->impact(which[q]); }));
}

/* The body is flat on the scale of the contact: the circle in which it cuts the sphere. */

void StaticBodyBatch::gather_resistance()
{
  const Vec8 zero{};
  for (int k = 0; k < end; k += lanes) {
    const Vec8 r = load8(&radius[k]), d = load8(&batch.overlap[k]);
    const Vec8 square = 2.0 * r * d - d * d;
    store(&batch.circle[k], square_root(select(square < zero, zero, square)));
  }
}

void StaticBodyBatch::gather_coefficients()
{
  for (int k = 0; k < end; k++)
    batch.coefficients[k] = task->row_of(candidates->atoms[candidate_of_lane[k]]);
}

/* Force, and torque couple - r moment. The mark of settle_torque() is set together with the force:
   a record that is read whole right after one number of it was written is late. */

void StaticBodyBatch::add_forces()
{
  ParticleRecords &records = *task->view.records;
  const bool turns = law.has_friction();
  for (int k = 0; k < filled; k += lanes) {
    Record force[lanes], torque[lanes];
    to_records(lanes_of(batch.force, k), force);
    if (turns) to_records(torques(k), torque);
    for (int q = 0; q < std::min(lanes, filled - k); q++) {
      const int slot = candidates->slots[candidate_of_lane[k + q]];
      Record *const load = &records.load[records.stride * slot];
      const Vec4 sum = load4(load[0]) + load4(force[q]);
      if (turns) store(load[1], records.torque(slot) + load4(torque[q]));
      store(load[0], turns ? settled(sum) : sum);
    }
  }
}

EightRecords StaticBodyBatch::torques(int k) const
{
  EightRecords torque = lanes_of(batch.moment, k);
  for (int d = 0; d < 3; d++) {
    torque.number[d] = -load8(&radius[k]) * torque.number[d];
    if (law.resists()) torque.number[d] = load8(&batch.couple[d][k]) + torque.number[d];
  }
  return torque;
}

void StaticBodyBatch::keep_histories()
{
  for (int k = 0; k < filled; k += lanes) {
    Record its[lanes], impact[lanes];
    to_records(history_lanes(batch, 0, k), its);
    if (task->with_impact) to_records(history_lanes(batch, 4, k), impact);
    for (int q = 0; q < std::min(lanes, filled - k); q++) {
      history->record(candidate_of_lane[k + q]) = its[q];
      if (task->with_impact) history->impact(candidate_of_lane[k + q]) = impact[q];
    }
  }
}

/* The reaction, as in BodyBatch::apply(). */

void StaticBodyBatch::add_load()
{
  for (auto *vector : {batch.force, batch.moment, batch.couple})
    for (int d = 0; d < 3; d++) std::fill(vector[d] + filled, vector[d] + end, 0.0);
  const Vector3<double> &o = task->frame.origin;
  const Vector3<Vec8> about{splat<Vec8>(o.x), splat<Vec8>(o.y), splat<Vec8>(o.z)};
  Vector3<Vec8> force_sum = load_of_lanes[0], torque_sum = load_of_lanes[1];
  for (int k = 0; k < end; k += lanes) {
    const Vec8 r = load8(&radius[k]);
    const Vector3<Vec8> force = vector_at(batch.force, k), normal = vector_at(batch.normal, k);
    const Vector3<Vec8> arm = vector_at(place, k) - r * normal - about;
    force_sum = force_sum - force;
    torque_sum = torque_sum - cross(arm, force);
    if (law.resists())
      torque_sum = torque_sum - (vector_at(batch.couple, k) -
                                 r * (vector_at(batch.moment, k) - cross(normal, force)));
  }
  load_of_lanes[0] = force_sum;
  load_of_lanes[1] = torque_sum;
}

void StaticBodyBatch::sum_up()
{
  const auto sum = [](const Vector3<Vec8> &lane) {
    return Vector3<double>{sum_of(lane.x), sum_of(lane.y), sum_of(lane.z)};
  };
  load = {sum(load_of_lanes[0]), sum(load_of_lanes[1]), touching};
}

}    // namespace Talus
