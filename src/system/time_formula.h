// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Variables of the input script that may be evaluated while particles are in the records.

#ifndef TALUS_SYSTEM_TIME_FORMULA_H
#define TALUS_SYSTEM_TIME_FORMULA_H

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace Talus {

/// Whether the formula of an equal-style variable reads nothing but the step, the time, numbers and
/// other such variables: its value is the same at any moment of a step, on all ranks, and needs no
/// particle. Not collective. False if there is no such variable.
bool reads_only_time(LAMMPS_NS::LAMMPS *lmp, const std::string &variable);

/// The same of the text of a formula, apart from the variables in it, whose names are added to
/// `variables`.
bool formula_reads_only_time(const std::string &formula, std::vector<std::string> &variables);

}    // namespace Talus

#endif
