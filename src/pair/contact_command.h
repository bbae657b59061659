// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The words of a contact law, shared by `pair_coeff I J gran/penalty ...` and `fix large/body ... contact`:
//
//   NORMAL args [tangential MODE args] [limit_damping]

#ifndef TALUS_CONTACT_COMMAND_H
#define TALUS_CONTACT_COMMAND_H

#include "contact/contact_law.h"

namespace LAMMPS_NS {

class LAMMPS;

/// What a user asked for one pair of materials. Plain data: goes to restart files as it is.
struct ContactSpec {
  Talus::ContactLaw law;
  Talus::ContactCoefficients coefficients;
};

/// Where the words come from, for error messages.
struct CommandWords {
  LAMMPS *lmp;
  const char *command;    ///< as the user knows it, e.g. "pair_coeff gran/penalty"
  int narg;
  char **arg;
  int shift = 0;          ///< words of the command line that are missing before arg[0]
};

/// Parses from arg[iarg] on, and leaves iarg at the first word that belongs to no contact law.
/// Bad and missing words end in error->all() naming command, word and what was expected.
ContactSpec parse_contact(const CommandWords &words, int &iarg);

/// Rule by which the coefficient of friction of unlike materials is found.
enum class FrictionMix : int { MINIMUM, ARITHMETIC, GEOMETRIC };

/// Coefficients of a pair of unlike materials with the same law: stiffness and damping by the
/// arithmetic mean, friction by `rule`; damping is limited if either material asks for it.
ContactSpec mix_contacts(const ContactSpec &a, const ContactSpec &b, FrictionMix rule);

}    // namespace LAMMPS_NS

#endif
