// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Particles that are moved in their records, without the arrays of LAMMPS. Every operation and its
// order are those of the integrators in the arrays of LAMMPS and of forecast_motion(), so that it
// does not show in a result where a step was made.

#include "particles/kick_and_drift.h"
#include "particles/particle_records.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

/// The number in the fourth place of a record, four times.
inline Vec4 fourth_of(Vec4 record)
{
  return shuffle<3, 3, 3, 3>(record, record);
}

inline Vec4 clear_fourth(Vec4 record)
{
  return shuffle<0, 1, 2, 4>(record, Vec4{});
}

/// The squared length of a row of three, in all places. The fourth must be 0. The sum is that of
/// forecast_motion(): (x x + y y) + z z.
inline Vec4 square(Vec4 row)
{
  const Vec4 squares = row * row;
  const Vec4 halves = squares + shuffle<1, 0, 3, 2>(squares, squares);
  return halves + shuffle<2, 3, 0, 1>(halves, halves);
}

/* Number by number: std::copy would call a function. */

TALUS_INLINE void write_row(Vec4 from, double *to)
{
  for (int d = 0; d < 3; d++) to[d] = from[d];
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
  store(load[stride * s], four(f[0], f[1], f[2], stride == 2 ? 1.0 : 0.0));
  if (stride == 2) store(load[2 * s + 1], four(torque_row[0], torque_row[1], torque_row[2], 0.0));
}

/* What is the same for all particles of a step. The fourth places, 1/m, r and 1/r, stay as they
   are: 0 is added to them. */

struct ParticleRecords::Kick {
  explicit Kick(const RecordStep &step) :
      kick(four(step.kick, step.kick, step.kick, 0.0)), dt(four(step.dt, step.dt, step.dt, 0.0)),
      gravity_kick(four(step.gravity_kick[0], step.gravity_kick[1], step.gravity_kick[2], 0.0)),
      inverse_c(1.0 / step.inertia), twice(step.two_kicks)
  {
  }
  Vec4 kick, dt, gravity_kick;
  double inverse_c;
  bool twice;
};

template <bool rotation, bool changes>
inline ParticleRecords::Moved ParticleRecords::kick(const Kick &with, std::size_t s)
{
  constexpr std::size_t stride = rotation ? 2 : 1;
  Record *moves = &motion[stride * s];
  const Vec4 v = load4(moves[0]), per_mass = fourth_of(v) * with.kick;
  const Vec4 x = load4(position[s]), force = load4(load[stride * s]);
  const Vec4 gravity_kick = kept_if(v[3] != 0.0, with.gravity_kick);
  Vec4 v_new = kicked(v, per_mass, force, gravity_kick);
  if (with.twice) v_new = kicked(v_new, per_mass, force, gravity_kick);
  if constexpr (rotation) {
    const Vec4 w = load4(moves[1]), inverse_radius = clear_fourth(fourth_of(w));
    const Vec4 per_inertia = kick_per_inertia(per_mass, inverse_radius, with.inverse_c);
    const Vec4 torque = torque_of(s, x, force);
    Vec4 w_new = kicked_omega(w, per_inertia, torque);
    if (with.twice) w_new = kicked_omega(w_new, per_inertia, torque);
    store(moves[1], w_new);
    if constexpr (changes) keep_change(s, v, v_new, w, w_new);
  } else if constexpr (changes)
    keep_change(s, v, v_new, Vec4{}, Vec4{});
  const Vec4 x_new = drifted(x, with.dt, v_new);
  store(moves[0], v_new);
  store(position[s], x_new);
  return {x_new, v_new};
}

template <bool rotation, bool changes>
RecordTravel ParticleRecords::advance_all(const std::vector<RecordStep> &steps,
                                          const std::vector<Role> &role, const Record *held,
                                          const SlotChoice &slots)
{
  constexpr std::size_t row_stride = rotation ? 2 : 1;
  const Kick first(steps[0]);
  const std::vector<Kick> others(steps.begin() + 1, steps.end());
  const Role *const roles = role.empty() ? nullptr : role.data();
  Vec4 moved2{}, fastest2{};
  slots.for_each(64, [&](std::size_t s, std::size_t soon) {
    __builtin_prefetch(position.data() + soon, 1);
    __builtin_prefetch(motion.data() + row_stride * soon, 1);
    __builtin_prefetch(load.data() + row_stride * soon, 1);
    if (held) __builtin_prefetch(held + soon);
    const Role role = roles ? roles[s] : MOVES;
    const Moved now = role == MOVES  ? kick<rotation, changes>(first, s)
                      : role > MOVES ? kick<rotation, changes>(others[role - MOVES - 1], s)
                                     : Moved{load4(position[s]), load4(motion[row_stride * s])};
    begin_sums(s, now.v);
    if (!held || role == GHOST) return;
    moved2 = larger(square(now.x - load4(held[s])), moved2);
    fastest2 = larger(square(clear_fourth(now.v)), fastest2);
  });
  return {std::sqrt(moved2[0]), std::sqrt(fastest2[0])};
}

RecordTravel ParticleRecords::advance(const std::vector<RecordStep> &steps,
                                      const std::vector<Role> &role, const Record *held,
                                      const SlotChoice &slots)
{
  if (keeps_changes())
    return stride == 2 ? advance_all<true, true>(steps, role, held, slots)
                       : advance_all<false, true>(steps, role, held, slots);
  return stride == 2 ? advance_all<true, false>(steps, role, held, slots)
                     : advance_all<false, false>(steps, role, held, slots);
}

void ParticleRecords::clear(int begin, int end)
{
  for (int s = begin; s < end; s++) begin_sums(s, load4(velocity(s)));
}

}    // namespace Talus
