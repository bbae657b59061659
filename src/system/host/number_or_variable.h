// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A number of a command that may be an equal-style variable of the script.

#ifndef TALUS_SYSTEM_HOST_NUMBER_OR_VARIABLE_H
#define TALUS_SYSTEM_HOST_NUMBER_OR_VARIABLE_H

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace Talus {

class Words;

struct NumberOrVariable {
  double value = 0.0;
  std::string name;    ///< of a variable; "": it is the number

  /// Of the next word of a command: v_NAME, or a number. `what` is told in messages.
  static NumberOrVariable from(Words &words, const char *what);

  bool is_variable() const { return !name.empty(); }
  /// In init(): it must exist. `command`, "Fix large/body", begins the message.
  void check(LAMMPS_NS::LAMMPS *lmp, const std::string &command) const;
  /// In this step. Around calls of it for variables that may ask computes: clearstep_compute() and addstep_compute() of LAMMPS.
  double evaluate(LAMMPS_NS::LAMMPS *lmp) const;
  /// It may read particles.
  bool reads_more_than_time(LAMMPS_NS::LAMMPS *lmp) const;
};

}    // namespace Talus

#endif
