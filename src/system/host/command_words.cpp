// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/host/command_words.h"

#include "error.h"
#include "lammps.h"

namespace Talus {

Words command_words(LAMMPS_NS::LAMMPS *lmp, const std::string &command, int narg,
                    const char *const *arg, int first, int shift)
{
  return {command, narg, arg, first, [lmp, shift](int index, const std::string &text) {
            // of a command without words there is none to point at
            const int at = index + shift < 0 ? LAMMPS_NS::Error::NOPOINTER : index + shift;
            lmp->error->all(FLERR, at, "{}", text);
          }};
}

}    // namespace Talus
