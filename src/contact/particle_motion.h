// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Particles that live in the records of a pipeline from one step to the next: how they are moved there,
// on the way through compute() or before it, and how they return to the arrays of LAMMPS.
//
//   after set_pairs()    prepare()
//   every step           advance(), ContactPipeline::compute()
//   somebody looks       complete(), return_state() or show()

#ifndef TALUS_CONTACT_PARTICLE_MOTION_H
#define TALUS_CONTACT_PARTICLE_MOTION_H

#include "particles/particle_records.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace Talus {

class ContactPipeline;

class ParticleMotion {
 public:
  /// (begin, end, to): asked by all threads for those of some owned particles.
  using Movers = std::function<void(int, int, signed char *)>;

  explicit ParticleMotion(ContactPipeline &contacts) : of(contacts) {}
  ParticleMotion(const ParticleMotion &) = delete;
  ParticleMotion &operator=(const ParticleMotion &) = delete;

  /// Particles live in the records since the last compute().
  bool holds_state() const { return in_records; }
  /// Marks the records as not current, and does nothing else: the state must be in the arrays of
  /// LAMMPS, and prepare() has to be called again.
  void leave() { in_records = prepared = pending = completed = false; }

  /// To be called before the first advance() after set_pairs(), with what concerns owned particles
  /// by local index: the numbers of the steps that move them, -1 where none does; and whose states
  /// are sent away before forces are computed.
  void prepare(const Movers &find_movers, const std::vector<int> &sent);
  bool is_prepared() const { return prepared; }
  /// Moves the owned particles, if holds_state(): those at once that are sent, the others on the
  /// way through the next compute().
  void advance(const std::vector<RecordStep> &steps);
  /// It has not been completed.
  bool is_moving() const { return pending; }
  /// It has, by complete() alone, and the sums of forces are as they begin.
  bool has_moved() const { return completed; }
  /// Moves those that are still to be moved now, in a pass of its own.
  void complete();
  /// Of the last move, after compute() or complete(): the largest speed of an owned particle
  /// after it, and whether all of them were moved by it.
  double fastest() const;
  bool moves_all_owned() const { return all_owned_move; }

  /// Ends holds_state(): completes an advance() and writes the state of all owned particles to the
  /// arrays of LAMMPS: positions, velocities, angular velocities and the changes of velocities that
  /// are kept. With forces those and torques are set to the ones in the records.
  void return_state(const ParticleView &arrays, bool with_forces);
  /// Copies the state of all owned particles to the arrays, for code that only reads it, and of proxies
  /// if their state is in the records; sets forces and torques of owned particles there to those in
  /// the records.
  void show(const ParticleView &arrays, bool proxies, bool forces) const;
  /// The state of some owned particles to the arrays, for code that only reads it.
  void copy_states(const std::vector<int> &atoms, const ParticleView &arrays) const;
  /// Sets forces and torques in the records to those in the arrays.
  void take_forces(const ParticleView &arrays);
  /// Whether changes of velocities are kept from now on, see ParticleRecords::keep_changes().
  void keep_changes(bool yes);
  bool keeps_changes() const { return with_changes; }

 private:
  friend class ContactPipeline;
  // ---- by the pipeline
  void make_room(int ranges) { speeds.assign(ranges, {}); }
  /// The forces of a step are there: the state stays in the records, or is in the arrays.
  void end_step(bool stays)
  {
    in_records = stays;
    completed = false;
  }
  /// Those of a thread that others read as well; and those of a range, on the way.
  void move_shared(int thread);
  void move_on_the_way(int range, SlotChoice slots);
  void all_are_moved() { pending = false; }

  void write_state(int atom, const ParticleView &arrays) const;
  void write_forces(int atom, const ParticleView &arrays) const;

  ContactPipeline &of;
  bool in_records = false, prepared = false, pending = false, completed = false;
  bool with_changes = false;
  std::vector<RecordStep> steps_of_move;
  std::vector<ParticleRecords::Role> role;       ///< by slot; empty if all move
  std::vector<int> moved_at_once;                ///< slots that are sent
  std::vector<int> moved_first;                  ///< others that several ranges read
  std::vector<unsigned char> is_moved_before;    ///< by slot: one of these; empty if none is
  bool all_owned_move = false;
  struct alignas(64) Speed {    // in a cache line of its own: written every few hundred particles
    double largest = 0.0;

    void join(double speed) { largest = std::max(largest, speed); }
  };
  std::vector<Speed> speeds;    ///< by range
};

}    // namespace Talus

#endif
