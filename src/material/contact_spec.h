// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Mixing: from the parameters of two materials to the coefficients of the kernels.

#ifndef TALUS_MATERIAL_CONTACT_SPEC_H
#define TALUS_MATERIAL_CONTACT_SPEC_H

#include "laws/given_law.h"

namespace Talus {

/// The coefficients of a contact between bodies of materials a and b, which must have the same law;
/// a and b may be the same object. Every law mixes its own: stiffness and damping that were given
/// by number: arithmetic mean; moduli by compliance; restitution and adhesion: minimum;
/// coefficients of pair granular's laws: geometric mean;
/// characteristic and threshold speeds: maximum; friction by `rule`; damping is limited if either
/// material asks for it.
ContactCoefficients contact_coefficients(const ContactSpec &a, const ContactSpec &b,
                                         FrictionMix rule);

}    // namespace Talus

#endif
