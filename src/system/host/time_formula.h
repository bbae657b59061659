// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Variables of the input script that may be evaluated while particles are in the records.

#ifndef TALUS_SYSTEM_HOST_TIME_FORMULA_H
#define TALUS_SYSTEM_HOST_TIME_FORMULA_H

#include <map>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
class Region;
}    // namespace LAMMPS_NS

namespace Talus {

/// Whether the formula of an equal-style variable reads nothing but the step, the time, numbers and
/// other such variables: its value is the same at any moment of a step, on all ranks, and needs no
/// particle. Not collective. False if there is no such variable.
bool reads_only_time(LAMMPS_NS::LAMMPS *lmp, const std::string &variable);

/// The same of the text of a formula, apart from the variables in it, whose names are added to
/// `variables`.
bool formula_reads_only_time(const std::string &formula, std::vector<std::string> &variables);

/// All variables of this style, and where LAMMPS has them.
std::map<std::string, int> equal_style_variables(LAMMPS_NS::LAMMPS *lmp);

/// Made of other regions.
bool is_composite(const LAMMPS_NS::Region &region);

/// "" if the variables that move a region, or shape it, depend on the time alone; else the name of
/// one that may depend on particles. Of a region that changes its shape all variables of the script
/// are asked.
std::string variable_that_may_read_particles(LAMMPS_NS::LAMMPS *lmp,
                                             const LAMMPS_NS::Region &region);

}    // namespace Talus

#endif
