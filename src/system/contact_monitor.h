// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Two warnings, once per run each, for what the laws and the time step are not made for:
//
//   overlap   two particles overlap by more than a tenth of the smaller radius: the laws are those
//             of small overlaps
//   move      a particle moves by more than a tenth of its radius in a time step: it may be deep in
//             another one, or through it, before it feels a force
//
// Looked for whenever the neighbor lists are about to be rebuilt and at the end of a run, not in
// every step.

#ifndef TALUS_SYSTEM_CONTACT_MONITOR_H
#define TALUS_SYSTEM_CONTACT_MONITOR_H

#include "contact/contact_pipeline.h"
#include "pointers.h"

namespace LAMMPS_NS {

class ContactMonitor : protected Pointers {
 public:
  static constexpr double largest_overlap = 0.1;    ///< over the smaller radius
  static constexpr double largest_move = 0.1;       ///< over the radius

  explicit ContactMonitor(LAMMPS *lmp) : Pointers(lmp) {}

  /// A run begins: both may be said again.
  void start() { said_overlap = said_move = false; }

  /// Collective. `contacts` are those of the last compute(); particles are still numbered as then.
  void look(const Talus::ContactPipeline &contacts);

 private:
  struct Move {
    double ratio;    ///< way in a time step over radius
    int atom;        ///< host's number; meaningless if the ratio is zero
  };
  Move largest_own_move() const;
  bool exceeds(double mine, double limit, double &worst, int &rank) const;

  bool said_overlap = false, said_move = false;
};

}    // namespace LAMMPS_NS

#endif
