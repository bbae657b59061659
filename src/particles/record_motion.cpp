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

/* Up to eight slots from this one on, on none of which anything has acted, and of which the first
   step moves some and the others are ghosts, whose sums are what they begin with: in dilute scenes
   most. Asked for eight at once, for of a single one the answer is unpredictable. */

ParticleRecords::Idle ParticleRecords::find_idle(const Role *role, const SlotChoice &slots, int n,
                                                 int count) const
{
  static_assert(GHOST == 0 && MOVES == 2, "one bit tells them apart");
  constexpr std::uint64_t eight_ones = 0x0101010101010101U;
  const auto bytes = [&slots, n](const unsigned char *of, std::uint64_t chosen) {
    std::uint64_t word = 0;
    if (!slots.list && chosen == eight_ones)
      std::memcpy(&word, of + n, lanes);
    else
      for (; chosen; chosen &= chosen - 1)
        word |= std::uint64_t{of[slots.at(n + __builtin_ctzll(chosen) / 8)]}
                << (__builtin_ctzll(chosen) & ~7);
    return word;
  };
  std::uint64_t here = eight_ones >> (8 * (lanes - count));
  if (slots.marked) here &= ~bytes(slots.marked, here);    // other threads may change the others
  if (bytes(acted.data(), here) != 0) return {};
  const std::uint64_t roles =
      role ? bytes(reinterpret_cast<const unsigned char *>(role), here) : here * MOVES;
  if ((roles & ~(eight_ones * MOVES)) != 0) return {};
  return {true, roles / MOVES};
}

/* Those that find_idle() has found: one byte each. Returns the square of the largest speed. */

template <bool rotation, bool changes>
inline Vec4 ParticleRecords::advance_idle(const KickAndDrift &step, const SlotChoice &slots, int n,
                                          std::uint64_t moving)
{
  Vec4 fastest2{};
  const auto advance_one = [&](int place) {
    const Vec4 v = move<rotation, changes, false>(step, slots.at(place));
    fastest2 = larger(square(clear_fourth(v)), fastest2);
  };
  constexpr std::uint64_t all = 0x0101010101010101U;
  if (moving == all)
    for (int k = 0; k < lanes; k++) advance_one(n + k);
  else
    for (; moving; moving &= moving - 1) advance_one(n + __builtin_ctzll(moving) / 8);
  return fastest2;
}

template <bool rotation, bool changes>
double ParticleRecords::advance_all(const std::vector<RecordStep> &steps,
                                    const std::vector<Role> &role, const SlotChoice &slots)
{
  constexpr std::size_t row_stride = rotation ? 2 : 1;
  constexpr int ahead = 64;
  const KickAndDrift first(steps[0]);
  const std::vector<KickAndDrift> others(steps.begin() + 1, steps.end());
  const Role *const roles = role.empty() ? nullptr : role.data();
  const int last = std::max(slots.end, slots.next_end) - 1;
  Vec4 fastest2{};
  for (int n = slots.begin; n < slots.end;) {
    const int end = std::min(n + lanes, slots.end);
    const Idle idle = find_idle(roles, slots, n, end - n);
    for (int k = n; k < end; k++) {
      const std::size_t soon = slots.at(k + std::min(ahead, last - k));
      __builtin_prefetch(position.data() + soon, 1);
      __builtin_prefetch(motion.data() + row_stride * soon, 1);
      if (!idle.all) __builtin_prefetch(load.data() + row_stride * soon, 1);
    }
    if (idle.all) {
      fastest2 = larger(advance_idle<rotation, changes>(first, slots, n, idle.moving), fastest2);
      n = end;
      continue;
    }
    for (; n < end; n++) {
      const int slot = slots.at(n);
      if (!slots.holds(slot)) continue;
      const std::size_t s = slot;
      const Role role = roles ? roles[s] : MOVES;
      const Vec4 v = role == MOVES  ? move<rotation, changes, true>(first, s)
                     : role > MOVES ? move<rotation, changes, true>(others[role - MOVES - 1], s)
                                    : load4(motion[row_stride * s]);
      begin_sums(s, v);
      if (role != GHOST) fastest2 = larger(square(clear_fourth(v)), fastest2);
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
