// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Particles that are moved in their records, without the arrays of LAMMPS. Every operation and its
// order are those of the integrators in the arrays of LAMMPS and of forecast_motion(), so that it
// does not show in a result where a step was made.

#include "particles/particle_records.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace Talus {
namespace {

/// The squared length of a row of three, in all places. The fourth must be 0. The sum is that of
/// forecast_motion(): (x x + y y) + z z.
inline Vec4 square(Vec4 row)
{
  const Vec4 squares = row * row;
  const Vec4 halves = squares + shuffle<1, 0, 3, 2>(squares, squares);
  return halves + shuffle<2, 3, 0, 1>(halves, halves);
}

}    // namespace

void ParticleRecords::write_state(int slot, double *x, double *v, double *omega) const
{
  const Record *moves = &motion[stride * slot];
  write_row(load4(position[slot]), x);
  write_row(load4(moves[0]), v);
  if (stride == 2) write_row(load4(moves[1]), omega);
}

void ParticleRecords::write_forces(int slot, double *f, double *torque_row) const
{
  write_row(load4(load[stride * slot]), f);
  if (stride == 2) write_row(torque(slot), torque_row);
}

void ParticleRecords::set_forces(int slot, const double *f, const double *torque_row)
{
  const std::size_t s = slot;
  has_acted(s);
  store(load[stride * s], four(f[0], f[1], f[2], stride == 2 ? 1.0 : 0.0));
  if (stride == 2) store(load[2 * s + 1], four(torque_row[0], torque_row[1], torque_row[2], 0.0));
}

/* Returns the new velocity record. `sums` false: they are those with which they begin, and stay so. */

template <bool rotation, bool changes, bool sums>
inline Vec4 ParticleRecords::move(const KickAndDrift &step, std::size_t s)
{
  constexpr std::size_t stride = rotation ? 2 : 1;
  Record *moves = &motion[stride * s];
  const Vec4 x = load4(position[s]), v = load4(moves[0]);
  const Vec4 force = sums ? load4(load[stride * s]) : weight(s, v);
  const Vec4 v_new = step.velocity(v, force, v[3] != 0.0);
  if constexpr (rotation && (changes || sums)) {
    const Vec4 w = load4(moves[1]), torque = sums ? torque_of(s, x, force) : Vec4{};
    const Vec4 w_new = step.omega(w, v, torque);
    store(moves[1], w_new);
    if constexpr (changes) keep_change(s, v, v_new, w, w_new);
  } else if constexpr (changes)
    keep_change(s, v, v_new, Vec4{}, Vec4{});
  store(moves[0], v_new);
  store(position[s], step.position(x, v_new));
  return v_new;
}

/* Of eight slots from this one on, or as many as there are: one byte of each, 1 or 0. On most nothing
   has acted: those that the first step moves have sums that are still what they begin with, and idle
   ghosts are as they should be. All eight are asked at once, for the answer of a single one is
   unpredictable. */

inline ParticleRecords::Group ParticleRecords::group_at(const Role *role, const SlotChoice &slots,
                                                        int n) const
{
  constexpr std::uint64_t ones = 0x0101010101010101U;
  const int count = std::min(lanes, slots.end - n);
  const auto bytes = [&slots, n, count](const void *of) {
    const auto *const first = static_cast<const unsigned char *>(of);
    std::uint64_t word = 0;
    if (!slots.list && count == lanes)
      std::memcpy(&word, first + n, lanes);
    else
      for (int k = 0; k < count; k++) word |= std::uint64_t{first[slots.at(n + k)]} << (8 * k);
    return word;
  };
  const auto are_zero = [](std::uint64_t small) { return ~(small + 0x7FU * ones) >> 7U & ones; };
  const std::uint64_t here =
      ones >> (8 * (lanes - count)) & ~(slots.marked ? bytes(slots.marked) : 0);
  const std::uint64_t roles = role ? bytes(role) : ones * MOVES, idle = here & ~bytes(acted.data());
  const std::uint64_t moving = idle & are_zero(roles ^ (ones * MOVES)),
                      ghosts = idle & are_zero(roles ^ (ones * GHOST));
  return {moving, here & ~(moving | ghosts)};
}

/* Where a group will be looked for that comes `ahead` slots later. */

template <bool rotation>
inline void ParticleRecords::prefetch_group(const SlotChoice &slots, int n, bool with_sums) const
{
  constexpr std::size_t row_stride = rotation ? 2 : 1;
  constexpr int ahead = 64;
  const int end = std::max(slots.end, slots.next_end),
            begin = std::max(n, std::min(n + ahead, end - lanes)),
            count = std::min(lanes, end - begin);
  for (int k = 0; k < count; k++) {
    const std::size_t soon = slots.at(begin + k);
    __builtin_prefetch(position.data() + soon, 1);
    __builtin_prefetch(motion.data() + row_stride * soon, 1);
    if (with_sums) __builtin_prefetch(load.data() + row_stride * soon, 1);
  }
}

template <bool rotation, bool changes>
double ParticleRecords::advance_all(const std::vector<RecordStep> &steps,
                                    const std::vector<Role> &role, const SlotChoice &slots)
{
  constexpr std::size_t row_stride = rotation ? 2 : 1;
  const KickAndDrift first(steps[0]);
  const std::vector<KickAndDrift> others(steps.begin() + 1, steps.end());
  const Role *const roles = role.empty() ? nullptr : role.data();
  Vec4 fastest2{};
  const auto had_speed = [&fastest2](Vec4 v) {
    fastest2 = larger(square(clear_fourth(v)), fastest2);
  };
  for (int n = slots.begin; n < slots.end; n += lanes) {
    const Group group = group_at(roles, slots, n);
    prefetch_group<rotation>(slots, n, group.others != 0);
    for (std::uint64_t rest = group.idle; rest; rest &= rest - 1)
      had_speed(move<rotation, changes, false>(first, slots.at(n + __builtin_ctzll(rest) / 8)));
    for (std::uint64_t rest = group.others; rest; rest &= rest - 1) {
      const std::size_t s = slots.at(n + __builtin_ctzll(rest) / 8);
      const Role role = roles ? roles[s] : MOVES;
      const Vec4 v = role == MOVES  ? move<rotation, changes, true>(first, s)
                     : role > MOVES ? move<rotation, changes, true>(others[role - MOVES - 1], s)
                                    : load4(motion[row_stride * s]);
      begin_sums(s, v);
      if (role != GHOST) had_speed(v);
    }
  }
  return std::sqrt(fastest2[0]);
}

double ParticleRecords::advance(const std::vector<RecordStep> &steps, const std::vector<Role> &role,
                                const SlotChoice &slots)
{
  if (keeps_changes())
    return stride == 2 ? advance_all<true, true>(steps, role, slots)
                       : advance_all<false, true>(steps, role, slots);
  return stride == 2 ? advance_all<true, false>(steps, role, slots)
                     : advance_all<false, false>(steps, role, slots);
}

void ParticleRecords::clear(int begin, int end)
{
  for (int s = begin; s < end; s++) begin_sums(s, load4(velocity(s)));
}

}    // namespace Talus
