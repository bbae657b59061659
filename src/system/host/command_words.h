// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Words of a LAMMPS command, whose errors end in error->all().

#ifndef TALUS_SYSTEM_HOST_COMMAND_WORDS_H
#define TALUS_SYSTEM_HOST_COMMAND_WORDS_H

#include "base/words.h"

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace Talus {

/// `shift`: words of the command line that are missing before arg[0], so that the message points at
/// the right one. Call on all ranks.
Words command_words(LAMMPS_NS::LAMMPS *lmp, const std::string &command, int narg,
                    const char *const *arg, int first = 0, int shift = 0);

}    // namespace Talus

#endif
