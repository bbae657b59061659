// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact laws in restart files: the names of the laws, and the numbers that were given, by name: they
// are read alike by every build that has the laws, whatever else it has.

#ifndef TALUS_MATERIAL_LAW_FILE_H
#define TALUS_MATERIAL_LAW_FILE_H

#include "laws/given_law.h"

#include <string>

namespace Talus {

/// One pair of materials as a string of bytes.
std::string to_bytes(const ContactSpec &spec);

/// Its inverse. Throws std::runtime_error, with what is wrong and what to do about it, if the
/// string names a law that does not exist here or ends early.
ContactSpec from_bytes(const std::string &bytes);

}    // namespace Talus

#endif
