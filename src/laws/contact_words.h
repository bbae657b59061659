// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The words of a contact law, shared by `pair_coeff I J gran/penalty ...` and `fix large/body ...
// contact`:
//
//   NORMAL args
//   [tangential NAME args] [damping NAME] [rolling [NAME] args] [spinning mu | twisting NAME args]
//   [adhesion NAME args] [heat NAME args] [vmin slip roll spin] [limit_damping]
//
// Which names there are, and their args, the laws know themselves (laws/*/list.cpp).

#ifndef TALUS_LAWS_CONTACT_WORDS_H
#define TALUS_LAWS_CONTACT_WORDS_H

#include "base/words.h"
#include "laws/given_law.h"

namespace Talus {

/// Reads a law, and stops at the first word that belongs to none. Bad, missing and repeated words
/// end in Words::fail(). `pressure_unit`: the caller's unit of pressure in terms of force and
/// length.
ContactSpec parse_contact(Words &words, double pressure_unit);

/// The keywords that parse_contact() knows, for messages about others.
inline constexpr const char *contact_keywords =
    "tangential, damping, rolling, spinning, twisting, adhesion, heat, vmin or limit_damping";

}    // namespace Talus

#endif
