// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Particles that are moved in their records, without the host's arrays. Every operation and its
// order are those of fix nve/sphere/symplectic and of forecast_motion(), so that it does not show
// in a result where a step was made.

#include "contact/particle_records.h"

#include <algorithm>

namespace Talus {
namespace {

/// The number in the fourth place of a record, three times, and 0.
inline Vec4 fourth_of(Vec4 record, double factor)
{
  return __builtin_shufflevector(record, record, 3, 3, 3, 3) * Vec4{factor, factor, factor, 0.0};
}

/// Squared lengths of eight rows of three; the fourth places do not count.
inline void squares(Vec4 *row, double *to)
{
  for (int k = 0; k < lanes; k += 4) {
    transpose(row[k], row[k + 1], row[k + 2], row[k + 3]);
    store(to + k, row[k] * row[k] + row[k + 1] * row[k + 1] + row[k + 2] * row[k + 2]);
  }
}

inline Vec8 larger(Vec8 a, Vec8 b)
{
  return select(a > b, a, b);
}

double largest(Vec8 a)
{
  alignas(64) double each[lanes];
  store(each, a);
  return *std::max_element(each, each + lanes);
}

}    // namespace

void ParticleRecords::write_state(int slot, double *x, double *v, double *omega) const
{
  const Record *moves = &motion[stride * slot];
  std::copy(position[slot].c, position[slot].c + 3, x);
  std::copy(moves[0].c, moves[0].c + 3, v);
  if (stride == 2) std::copy(moves[1].c, moves[1].c + 3, omega);
}

void ParticleRecords::write_forces(int slot, double *f, double *torque_row) const
{
  const Record &force = load[stride * slot];
  std::copy(force.c, force.c + 3, f);
  if (stride == 1) return;
  Record turn;
  store(turn, torque(slot));
  std::copy(turn.c, turn.c + 3, torque_row);
}

/* The fourth places, 1/m, r and 1/r, stay as they are: 0 is added to them. */

inline void ParticleRecords::kick(const RecordStep &step, int s)
{
  Record *moves = &motion[stride * s];
  const Record *loads = &load[stride * s];
  const Vec4 v = load4(moves[0]), per_mass = fourth_of(v, step.kick);
  const Vec4 fall{step.fall[0], step.fall[1], step.fall[2], 0.0};
  const Vec4 v_new = v + (per_mass * load4(loads[0]) + fall);
  store(moves[0], v_new);
  store(position[s], load4(position[s]) + Vec4{step.dt, step.dt, step.dt, 0.0} * v_new);
  if (stride == 1) return;
  const Vec4 w = load4(moves[1]), inverse_radius = fourth_of(w, 1.0);
  const Vec4 per_inertia = per_mass * (inverse_radius * inverse_radius) * (1.0 / step.inertia);
  store(moves[1], w + per_inertia * torque(s));
}

/* Calls a slot into the cache; one beyond the last does no harm. */

inline void ParticleRecords::call(int slot, const Record *held) const
{
  __builtin_prefetch(position.data() + slot, 1);
  __builtin_prefetch(motion.data() + stride * slot, 1);
  __builtin_prefetch(load.data() + stride * slot, 1);
  if (held) __builtin_prefetch(held + slot);
}

RecordTravel ParticleRecords::advance(const RecordStep &step, const std::vector<Role> &role,
                                      const Record *held, const SlotChoice &slots)
{
  constexpr int ahead = 96;
  Vec8 moved{}, next{}, fastest{};
  slots.in_groups([&](const int *slot, int count) {
    Vec4 way[lanes] = {}, speed[lanes] = {};
    for (int k = 0; k < count; k++) {
      const int s = slot[k];
      call(s + ahead, held);
      const Role its = role.empty() ? MOVES : role[s];
      if (its == MOVES) kick(step, s);
      clear_sums(s);
      if (!held || its == GHOST) continue;
      way[k] = load4(position[s]) - load4(held[s]);
      speed[k] = load4(motion[stride * s]);
    }
    if (!held) return;
    alignas(64) double way2[lanes], speed2[lanes];
    squares(way, way2);
    squares(speed, speed2);
    const Vec8 d = square_root(load8(way2)), v = square_root(load8(speed2));
    moved = larger(d, moved);
    next = larger(d + splat<Vec8>(step.dt) * v, next);
    fastest = larger(v, fastest);
  });
  return {largest(moved), largest(next), largest(fastest)};
}

void ParticleRecords::clear(int begin, int end)
{
  for (int s = begin; s < end; s++) clear_sums(s);
}

}    // namespace Talus
