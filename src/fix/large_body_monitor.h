// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Two warnings of fix large/body, once per run each, as ContactMonitor gives them for pairs:
//
//   overlap   a particle overlaps the body by more than a tenth of its radius: the laws are those
//             of small overlaps
//   move      a particle near a body that moves goes by more than a tenth of its radius past it in
//             a time step: it may be deep in the body, or through it, before it feels a force
//
// Looked for when the neighbor lists have been rebuilt and at the end of a run, not in every step.

#ifndef TALUS_FIX_LARGE_BODY_MONITOR_H
#define TALUS_FIX_LARGE_BODY_MONITOR_H

#include "body/contact/body_contacts.h"
#include "pointers.h"

#include <string>

namespace LAMMPS_NS {

class LargeBodyMonitor : protected Pointers {
 public:
  static constexpr double largest_overlap = 0.1;    ///< over the radius
  static constexpr double largest_move = 0.1;       ///< over the radius

  explicit LargeBodyMonitor(LAMMPS *lmp) : Pointers(lmp) {}

  /// A run begins: both may be said again.
  void start() { said_overlap = said_move = false; }

  /// Collective. `worst` of the particles of this rank; `moves`: the body does.
  void look(const Talus::BodyContacts::Worst &worst, bool moves, const std::string &id);

 private:
  bool exceeds(double mine, int atom, double limit, double &worst, double &tag) const;

  bool said_overlap = false, said_move = false;
};

}    // namespace LAMMPS_NS

#endif
