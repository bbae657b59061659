// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Mixing: from the parameters of two materials to the coefficients of the kernels.

#ifndef TALUS_MATERIAL_CONTACT_SPEC_H
#define TALUS_MATERIAL_CONTACT_SPEC_H

#include "laws/given_law.h"

#include <string>

namespace Talus {

/// The coefficients of a contact between bodies of materials a and b, which must have the same law;
/// a and b may be the same object. Every law mixes its own: stiffness and damping that were given
/// by number: arithmetic mean; moduli by compliance; restitution and adhesion: minimum;
/// coefficients of pair granular's laws: geometric mean;
/// characteristic and threshold speeds: maximum; friction by `rule`; damping is limited if either
/// material asks for it.
ContactCoefficients contact_coefficients(const ContactSpec &a, const ContactSpec &b,
                                         FrictionMix rule);

/// Given for a pair of types with E and nu NULL: those of each of the two types, while all other
/// numbers are those of the pair.
inline bool takes_moduli_of_types(const ContactSpec &spec)
{
  return spec.given.has("moduli_of_types");
}

/// Both sides of a contact, and how their numbers are combined.
struct ContactSides {
  ContactSpec a, b;
  FrictionMix rule;

  const ContactLaw &law() const { return a.law; }
  ContactCoefficients coefficients() const { return contact_coefficients(a, b, rule); }
  /// p, where the overlap of an impact is ~ 1/k^(1/p) of a number k, kn or E: its energy is ~ kn
  /// overlap^(1 + exponent); with E overlaps are those of Hertz, or a linear law has the same.
  double stiffness_power() const { return a.is_material() ? 2.5 : 1.0 + law().normal().exponent; }
  /// For the log: law, `note` behind it (e.g. "; mixed"), coefficients.
  std::string describe(const std::string &note) const;
};

}    // namespace Talus

#endif
