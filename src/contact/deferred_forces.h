// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Forces of the contacts of one chunk of the work that must not be added at once (see
// WorkPartition): on particles of other ranges, and in the early phase on those that wait for
// contacts with ghosts. They are noted here in the order of the contacts, and added later such that
// every particle gets its contacts in canonical order:
//
//   particles of the own range   by the late chunk of this range, between contacts of its own
//   particles of other ranges    when all chunks are done, in ascending order of the ranges

#ifndef TALUS_CONTACT_DEFERRED_FORCES_H
#define TALUS_CONTACT_DEFERRED_FORCES_H

#include "base/aligned_vector.h"
#include "particles/particle_records.h"

#include <cstddef>
#include <limits>
#include <tuple>

namespace Talus {

/// The slots of a pair. Canonical order is that of pair lists: by the second, then the first.
struct PairOfSlots {
  int first, second;

  bool operator<(const PairOfSlots &o) const
  {
    return std::tie(second, first) < std::tie(o.second, o.first);
  }
};
constexpr PairOfSlots after_all_pairs{std::numeric_limits<int>::max(),
                                      std::numeric_limits<int>::max()};

/// What a contact adds to the sums of one of its particles, see record.h. Moment and couple count
/// only in scenes that have them.
struct ContactLoad {
  Vec4 force, moment, couple;

  void add_to(ParticleRecords &particles, std::size_t slot) const
  {
    Record *sums = &particles.load[particles.stride * slot];
    store(sums[0], load4(sums[0]) + force);
    if (particles.stride == 2) store(sums[1], load4(sums[1]) + moment);
    if (particles.couple.empty()) return;
    store(particles.couple[slot], load4(particles.couple[slot]) + couple);
  }
};

class DeferredForces {
 public:
  /// For at most so many notes.
  void make_room(std::size_t notes, const ParticleRecords &particles);
  void clear() { noted = 0; }

  /// Notes what a contact adds to one of its slots; contacts in canonical order. Others may read it
  /// after streams_are_done().
  TALUS_INLINE void note(PairOfSlots pair, int slot, const ContactLoad &its)
  {
    stream(load[stride * noted], its.force);
    if (stride == 2) stream(load[stride * noted + 1], its.moment);
    if (!couple.empty()) stream(couple[noted], its.couple);
    notes[noted++] = {pair, slot};
  }

  /// Adds the notes from number `begin` on that belong to pairs before `limit` and to slots of a
  /// range. Returns the number of the first one that belongs to no pair before.
  std::size_t add_before(PairOfSlots limit, std::size_t begin, SlotRange range,
                         ParticleRecords &particles) const;

  /// Adds those of two phases of the same range to slots of `range`, in canonical order.
  static void add_both(const DeferredForces &early, const DeferredForces &late, SlotRange range,
                       ParticleRecords &particles);

  std::size_t size() const { return noted; }
  double memory_usage() const;

 private:
  struct Note {
    PairOfSlots pair;
    int slot;
  };
  std::size_t stride = 1, noted = 0;
  AlignedVector<Note> notes;
  AlignedVector<Record> load, couple;    // of each note
};

}    // namespace Talus

#endif
