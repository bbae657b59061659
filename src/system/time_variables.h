// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which equal-style variables may be evaluated in a step whose particles are in the records: those
// whose value depends on the time alone, and so on nothing that is in the arrays of LAMMPS.

#ifndef TALUS_SYSTEM_TIME_VARIABLES_H
#define TALUS_SYSTEM_TIME_VARIABLES_H

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace Talus {

/// "" if the value of a variable depends only on numbers, step, time, dt, elapsed, functions of
/// these, and other such variables; else what it depends on, for people. The same on all ranks; no
/// variable is evaluated.
std::string what_else_variable_reads(LAMMPS_NS::LAMMPS *lmp, const std::string &name);

/// The same for all equal-style variables that are defined: the first that reads more, with its
/// name.
std::string what_else_variables_read(LAMMPS_NS::LAMMPS *lmp);

}    // namespace Talus

#endif
