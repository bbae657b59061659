// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The words of a contact law, shared by `pair_coeff I J gran/penalty ...` and `fix large/body ...
// contact`:
//
//   NORMAL args
//   [tangential none | dashpot gt mu | onestep kt gt mu | multistep kt gt mu [midpoint]] [rolling
//   mu_r [delayed]] [spinning mu_s [delayed]] [adhesion constant F | dmt W | perko S] [vmin slip
//   roll spin] [limit_damping]

#ifndef TALUS_PAIR_CONTACT_COMMAND_H
#define TALUS_PAIR_CONTACT_COMMAND_H

#include "material/contact_spec.h"

namespace LAMMPS_NS {

class LAMMPS;

/// Where the words come from, for error messages.
struct CommandWords {
  LAMMPS *lmp;
  const char *command;    ///< as the user knows it, e.g. "pair_coeff gran/penalty"
  int narg;
  char **arg;
  int shift = 0;    ///< words of the command line that are missing before arg[0]
};

/// Parses from arg[iarg] on, and leaves iarg at the first word that belongs to no contact law.
/// Bad, missing and repeated words end in error->all() naming command, word and what was expected.
ContactSpec parse_contact(const CommandWords &words, int &iarg);

/// The keywords that parse_contact() knows, for messages about others.
inline constexpr const char *contact_keywords =
    "tangential, rolling, spinning, adhesion, vmin or limit_damping";

}    // namespace LAMMPS_NS

#endif
