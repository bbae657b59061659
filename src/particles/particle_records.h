// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// State of all particles of a rank, owned and ghost, as records in canonical order, and the sums of
// their contact forces. The arrays of LAMMPS are read once and written once in a step; or, as long
// as no code outside reads the particles, not at all: advance() then moves them here.
//
// What a contact needs of its partner apart from the position stands in one cache line, and so does
// what it adds to it: (velocity, omega) and (force, torque per radius). Scenes without friction
// have no second halves.

#ifndef TALUS_PARTICLES_PARTICLE_RECORDS_H
#define TALUS_PARTICLES_PARTICLE_RECORDS_H

#include "base/aligned_vector.h"
#include "particles/change_record.h"
#include "particles/kick_and_drift.h"
#include "particles/particle_order.h"
#include "particles/record.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace Talus {

/// The arrays of LAMMPS: rows of three doubles, owned particles first, then ghosts.
struct ParticleView {
  double *x, *v, *omega;    ///< omega may be nullptr in a scene without friction
  const double *radius, *mass;
  const double
      *mass_override;    ///< nullptr, or per particle: > 0 replaces its mass (infinity: frozen)
  double *f, *torque;    ///< added to; torque may be nullptr like omega
  double *heat_flow = nullptr;       ///< added to, if given: scalars, of owned particles
  ChangeRecord *change = nullptr;    ///< see ParticleRecords::change; if these are kept
};

/// Some slots of a rank: those at begin ... end-1 of a list, or without a list those of a range; of
/// these only the slots that are not marked.
struct SlotChoice {
  int begin, end;
  const int *list = nullptr;
  const unsigned char *marked = nullptr;    ///< by slot, or nullptr
  int next_end = 0;    ///< more slots may be asked for after these, up to this one

  int at(int n) const { return list ? list[n] : n; }
  bool holds(int slot) const { return !marked || !marked[slot]; }
  template <class Visit> void for_each(Visit visit) const
  {
    for (int n = begin; n < end; n++)
      if (const int slot = at(n); holds(slot)) visit(static_cast<std::size_t>(slot));
  }
  /// The same as visit(slot, soon), where `soon` is probably visited `ahead` visits later.
  template <class Visit> void for_each(int ahead, Visit visit) const
  {
    const int last = std::max(end, next_end) - 1;
    for (int n = begin; n < end; n++) {
      const int later = n + std::min(ahead, last - n);
      const int soon = list ? list[later] : later;
      if (const int slot = at(n); holds(slot))
        visit(static_cast<std::size_t>(slot), static_cast<std::size_t>(soon));
    }
  }
  /// visit(slots, count) for groups of up to eight.
  template <class Visit> void in_groups(Visit visit) const
  {
    int group[lanes], count = 0;
    for_each([&](std::size_t slot) {
      group[count++] = static_cast<int>(slot);
      if (count < lanes) return;
      visit(group, count);
      count = 0;
    });
    if (count) visit(group, count);
  }
};

class ParticleRecords {
 public:
  /// Makes room for `n` particles and their sums, whatever stood there before. `rotation` is false
  /// in scenes without friction: omega records and torques per radius are then neither read nor
  /// kept. `twisting_torques`: laws with resistance occur. `copies`: of the states of some
  /// particles, behind those of all. `changes`: see keep_changes(). `heat`: is conducted.
  void resize(std::size_t n, bool rotation, bool twisting_torques, std::size_t copies = 0,
              bool changes = false, bool heat = false);
  /// From now on changes of velocities are kept, 0 before the next step, or are not.
  void keep_changes(bool yes);
  bool keeps_changes() const { return !change.empty(); }

  /// Releases the memory of the sums. That of the states stays: it is smaller than what rebuilds
  /// need besides the sums, and allocating it again takes time.
  void release_sums();
  bool has_room() const { return !load.empty(); }

  /// Reads the state of some slots and clears their sums.
  void read(const ParticleOrder &order, const ParticleView &arrays, const SlotChoice &slots);

  /// From the next read(), advance() or clear() on: the sums of forces begin with the weight of the
  /// particle in a field of gravity (acceleration, nullptr: none). Without weight are those of
  /// infinite mass and the slots marked in set_weightless().
  void set_gravity(const double *acceleration);
  bool have_weights() const { return has_gravity; }
  /// By slot of the present order; empty: none.
  void set_weightless(std::vector<unsigned char> marks) { weightless = std::move(marks); }
  /// The same: masses of the particles where those of the records are those of rigid bodies.
  void set_own_masses(std::vector<double> masses) { own_mass = std::move(masses); }
  /// Initial value of the sum of forces of a slot with this velocity record.
  Vec4 weight(std::size_t slot, Vec4 velocity_record) const
  {
    if (!has_gravity) return Vec4{};
    const double inverse_mass = velocity_record[3];
    const double mass = own_mass.empty() ? 1.0 / inverse_mass : own_mass[slot];
    const bool has_weight = inverse_mass > 0.0 && (weightless.empty() || !weightless[slot]);
    return kept_if(has_weight, mass * load4(gravity));
  }
  Vec4 weight(int slot) const { return weight(slot, load4(velocity(slot))); }

  /// Adds the summed forces, and torques if angular velocities are kept, of slots begin ... end-1
  /// to LAMMPS' rows of owned particles: f += F, torque += C - r M; and the heat flows.
  void add_to(const ParticleOrder &order, const ParticleView &arrays, int begin, int end) const;
  /// The heat flows alone: they and temperatures are kept in the arrays of LAMMPS in every step.
  void add_heat_to(const ParticleOrder &order, const ParticleView &arrays, int begin,
                   int end) const;

  /// Writes x, v and, if angular velocities are kept, omega of a slot to LAMMPS' row.
  void write_state(int slot, double *x, double *v, double *omega) const;
  /// Sets LAMMPS' row of forces, and that of torques if angular velocities are kept.
  void write_forces(int slot, double *f, double *torque) const;
  /// Sets the sums to those of LAMMPS' rows, as settle_torque() leaves them.
  void set_forces(int slot, const double *f, const double *torque);

  /// Keeps the changes of a slot whose records of velocities and angular velocities were replaced
  /// in a step: also of proxies, to which it happens what has happened to their owners.
  TALUS_INLINE void keep_change(std::size_t slot, Vec4 v_old, Vec4 v, Vec4 w_old, Vec4 w)
  {
    const double radius = position[slot].c[3];
    store(change[slot], change_by_kick(extrapolation, radius, v_old, v, w_old, w));
  }

  /// Moves the particles of some slots and resets their sums. `role` of each slot: a ghost, at
  /// rest, or MOVES + n for the ones that the step n moves; empty: all are moved by the first step.
  /// Returns the largest speed of those that are not ghosts.
  enum Role : unsigned char { GHOST, RESTS, MOVES };
  double advance(const std::vector<RecordStep> &steps, const std::vector<Role> &role,
                 const SlotChoice &slots);
  /// Only resets the sums.
  void clear(int begin, int end);

  /// Copies the state of a slot to where other cores read it; then streams_are_done().
  void copy_state(int slot, int copy)
  {
    const std::size_t from = slot, to = copy;
    stream(position[to], load4(position[from]));
    for (std::size_t n = 0; n < stride; n++)
      stream(motion[stride * to + n], load4(motion[stride * from + n]));
    if (keeps_changes()) stream(change[to], load8(change[from]));
  }

  /// Torque on a slot so far: C - r M with the twisting torque C and the torque per radius M, or
  /// the torque itself after settle_torque(). Torques are added in one order on any number of
  /// threads: first those of the contacts, and of these first the lever arms.
  Vec4 torque(int slot) const
  {
    const std::size_t s = slot;
    return torque_of(s, load4(position[s]), load4(load[2 * s]));
  }
  /// To be called for each slot whose sums are changed: of others advance() reads and resets none.
  void has_acted(std::size_t slot) { acted[slot] = 1; }
  /// Otherwise its sums are the weight.
  bool was_acted_on(int slot) const { return acted[slot] != 0; }
  /// For forces other than contacts between particles: from here on until advance() the second half
  /// of the load is the torque itself, which others may add to.
  void settle_torque(int slot)
  {
    Record *loads = &load[2 * static_cast<std::size_t>(slot)];
    has_acted(slot);
    if (loads[0].c[3] != 0.0) return;
    store(loads[1], torque(slot));
    loads[0].c[3] = 1.0;
  }

  double memory_usage() const;

  /// Prefetches the state of a slot, before it is read or set. (A call that is
  /// not inlined would be removed: to the compiler it has no effect.)
  TALUS_INLINE void prefetch(int slot) const
  {
    __builtin_prefetch(position.data() + slot, 1);
    __builtin_prefetch(motion.data() + stride * slot, 1);
  }

  /// The same for all that advance() reads and sets of a slot and the next one, long before: into
  /// the second cache.
  TALUS_INLINE void prefetch_two_early(int slot) const
  {
    constexpr int second_cache = 2;
    const Record *moves = motion.data() + stride * slot, *sums = load.data() + stride * slot;
    __builtin_prefetch(position.data() + slot, 0, second_cache);
    __builtin_prefetch(moves, 0, second_cache);
    __builtin_prefetch(moves + stride, 0, second_cache);
    __builtin_prefetch(sums, 0, second_cache);
    __builtin_prefetch(sums + stride, 0, second_cache);
    if (keeps_changes()) __builtin_prefetch(change.data() + slot, 0, second_cache);
  }

  /// The same for what a contact reads and adds to, once its position is known.
  TALUS_INLINE void prefetch_for_contact(int slot) const
  {
    __builtin_prefetch(motion.data() + stride * slot);
    __builtin_prefetch(load.data() + stride * slot, 1);
    if (keeps_changes()) __builtin_prefetch(change.data() + slot);
  }

  const Record &velocity(int slot) const { return motion[stride * slot]; }
  const Record &omega(int slot) const { return motion[2 * static_cast<std::size_t>(slot) + 1]; }

  std::size_t stride = 1;    ///< records per particle in motion and load: 2 with angular velocities
  AlignedVector<Record> position, motion, load, twisting_torque;    ///< see record.h
  AlignedVector<double> heat_flow;    ///< sums like those of load, or none
  /// For laws of second order and for energies: changes of velocities in the time by which they are
  /// behind positions, by the accelerations of the last step; one record per particle, or none.
  AlignedVector<ChangeRecord> change;
  double extrapolation = 0.0;    ///< of the step that moves particles, see RecordStep

 private:
  void read_eight(const ParticleOrder &order, const ParticleView &arrays, const int *slots,
                  int count);
  template <bool rotation, bool changes, bool sums>
  Vec4 move(const KickAndDrift &step, std::size_t slot);
  struct Group {
    std::uint64_t idle, others;
  };
  Group group_at(const Role *role, const SlotChoice &slots, int n) const;
  template <bool rotation>
  void prefetch_group(const SlotChoice &slots, int n, bool with_sums) const;
  template <bool rotation, bool changes>
  double advance_all(const std::vector<RecordStep> &steps, const std::vector<Role> &role,
                     const SlotChoice &slots);
  /// The sums of a slot with this velocity record, before anything is added.
  void begin_sums(std::size_t slot, Vec4 velocity_record)
  {
    acted[slot] = 0;
    store(load[stride * slot], weight(slot, velocity_record));
    if (stride == 2) store(load[2 * slot + 1], Vec4{});
    if (!twisting_torque.empty()) store(twisting_torque[slot], Vec4{});
    if (!heat_flow.empty()) heat_flow[slot] = 0.0;
  }
  Vec4 torque_of(std::size_t slot, Vec4 position_record, Vec4 force_record) const
  {
    const Vec4 torque_record = load4(load[2 * slot + 1]);
    if (force_record[3] != 0.0) return torque_record;
    const Vec4 of_forces = Vec4{} - position_record[3] * torque_record;
    return twisting_torque.empty() ? of_forces : of_forces + load4(twisting_torque[slot]);
  }

  std::vector<unsigned char> acted;    // by slot: something was added to its sums
  bool has_gravity = false;
  Record gravity{};    // fourth place 0
  std::vector<unsigned char> weightless;
  std::vector<double> own_mass;
};

}    // namespace Talus

#endif
