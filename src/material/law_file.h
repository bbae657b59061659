// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact laws in restart files: the names of the laws, and the numbers that were given, by name.
// Files of one version read alike by every build that has the laws, whatever else it has.

#ifndef TALUS_MATERIAL_LAW_FILE_H
#define TALUS_MATERIAL_LAW_FILE_H

#include "laws/given_law.h"

#include <cstdint>
#include <string>

namespace Talus {

/// First numbers of what a pair style writes. `mark` distinguishes it from files without a version.
/// From version 3 on the version of Talus follows, see version.h; version 2 is read as well.
inline constexpr std::int32_t law_file_mark = 0x54414c55, law_file_version = 3;
inline constexpr std::int32_t oldest_law_file = 2;

/// What is wrong with the first two numbers of a file and what to do about it; "" if nothing is.
std::string problem_of_law_file(std::int32_t mark, std::int32_t version);

/// One pair of materials as a string of bytes.
std::string to_bytes(const ContactSpec &spec);

/// Its inverse. Throws std::runtime_error, with what is wrong and what to do about it, if the
/// string names a law that does not exist here or ends early.
ContactSpec from_bytes(const std::string &bytes);

}    // namespace Talus

#endif
