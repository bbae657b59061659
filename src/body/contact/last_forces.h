// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Forces of the contacts of the last step, for outputs: not all laws of LAMMPS have the history to
// compute them again.

#ifndef TALUS_BODY_CONTACT_LAST_FORCES_H
#define TALUS_BODY_CONTACT_LAST_FORCES_H

#include "base/aligned_vector.h"
#include "base/lanes.h"
#include "laws/contact_energy.h"

#include <algorithm>
#include <cstddef>

namespace Talus {

/// Of one thread.
class LastForces {
 public:
  void clear() { kept = 0; }
  /// The first `filled` lanes of a batch, behind the others; atom(lane): local index.
  template <class Atom>
  void add(const ContactBatch &batch, int filled, bool with_torques, bool with_twisting, Atom atom)
  {
    if (batches.size() == kept) batches.emplace_back();
    Forces &forces = batches[kept++];
    forces.filled = filled;
    for (int k = 0; k < filled; k++) forces.atoms[k] = atom(k);
    copy(batch.force, forces.force, filled);
    if (with_torques) copy(batch.torque_per_radius, forces.torque_per_radius, filled);
    if (with_twisting) copy(batch.twisting_torque, forces.twisting_torque, filled);
  }

  /// Begins to find() them in the order in which they were added.
  void rewind() { at = lane = 0; }
  /// Of the next contact of a report. One that began behind the step has no forces.
  void find(bool with_torques, bool with_twisting, ContactReport &of)
  {
    if (at == kept) return;
    const Forces &forces = batches[at];
    if (forces.atoms[lane] != of.i) return;
    of.force = lane_of(forces.force, lane);
    if (with_torques) of.torque_per_radius = lane_of(forces.torque_per_radius, lane);
    if (with_twisting) of.twisting_torque = lane_of(forces.twisting_torque, lane);
    if (++lane < forces.filled) return;
    at++;
    lane = 0;
  }

 private:
  using Lanes = double[3][ContactBatch::width];
  struct Forces {
    int filled, atoms[ContactBatch::width];
    alignas(64) Lanes force, torque_per_radius, twisting_torque;
  };
  static void copy(const Lanes &from, Lanes &to, int filled)
  {
    for (int d = 0; d < 3; d++)
      for (int k = 0; k < filled; k += lanes) store(&to[d][k], load8(&from[d][k]));
  }

  AlignedVector<Forces> batches;
  std::size_t kept = 0;    // batches
  std::size_t at = 0;
  int lane = 0;
};

}    // namespace Talus

#endif
