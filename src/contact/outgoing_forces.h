// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Forces of the contacts of one part of the work on first particles of other parts (see
// ParticleOrder::divide()): noted here in the order of the contacts, and added when all parts are
// done. A particle gets the contacts of its own part first, then those of other parts in ascending
// order of the parts: as these are ranges of the order, that is the canonical order.

#ifndef TALUS_CONTACT_OUTGOING_FORCES_H
#define TALUS_CONTACT_OUTGOING_FORCES_H

#include "base/aligned_vector.h"
#include "particles/particle_records.h"

#include <cstddef>
#include <vector>

namespace Talus {

class OutgoingForces {
 public:
  /// For so many contacts.
  void make_room(std::size_t contacts, const ParticleRecords &particles);
  void clear() { noted = with_couple = 0; }

  /// Notes force and, in scenes with friction, moment on a slot; see stream().
  TALUS_INLINE void note(int slot, const Record &force, const Record &moment)
  {
    stream(load[stride * noted], load4(force));
    if (stride == 2) stream(load[stride * noted + 1], load4(moment));
    slots[noted++] = slot;
  }
  /// The same for couples, of the same contacts, a while later.
  TALUS_INLINE void note_couple(Vec4 its) { stream(couple[with_couple++], its); }

  /// Adds those on slots of a range to their sums, after streams_are_done().
  void add_to(ParticleRecords &particles, ParticleOrder::Range range) const;

  std::size_t size() const { return noted; }
  double memory_usage() const;

 private:
  std::size_t stride = 1, noted = 0, with_couple = 0;
  AlignedVector<int> slots;
  AlignedVector<Record> load, couple;
};

}    // namespace Talus

#endif
