// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How fast the sides of a periodic box move while fix deform or deform/pressure drives it with `remap v`:
// velocities of particles that cross a border, and of ghosts beyond it, change by the difference (Domain::h_rate, a
// speed). For sides that follow a pressure or a volume LAMMPS before 30 Sep 2026 tells the rate of strain in its
// place (https://github.com/lammps/lammps/pull/5191), which is too small by the length of the box.
//
// The run style calls start() at the begin of a run and correct() after each end_of_step() of all fixes.

#ifndef TALUS_SYSTEM_HOST_BOX_SPEEDS_H
#define TALUS_SYSTEM_HOST_BOX_SPEEDS_H

#include "lmptype.h"

#include <array>

namespace LAMMPS_NS {
class Fix;
class LAMMPS;
}    // namespace LAMMPS_NS

namespace Talus {

class BoxSpeeds {
 public:
  explicit BoxSpeeds(LAMMPS_NS::LAMMPS *lammps) : lmp(lammps) {}
  void start();
  /// If the box has changed in this step: rates of strain become speeds, others stay. Says so once.
  void correct();

 private:
  std::array<double, 3> lengths() const;

  LAMMPS_NS::LAMMPS *lmp;
  const LAMMPS_NS::Fix *deform = nullptr;    ///< that changes velocities, in this run
  std::array<double, 3> before{};            ///< lengths of the box
  bool told_user = false;
};

}    // namespace Talus

#endif
