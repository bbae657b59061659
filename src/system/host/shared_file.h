// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SYSTEM_HOST_SHARED_FILE_H
#define TALUS_SYSTEM_HOST_SHARED_FILE_H

#include "base/words.h"

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace Talus {

/// The content of a file on all ranks: rank 0 reads, so that the file need not be visible elsewhere.
/// `words`: the command whose last word is the file, for errors. Collective.
std::string read_everywhere(LAMMPS_NS::LAMMPS *lmp, const Words &words, const std::string &file);

}    // namespace Talus

#endif
