// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What a user asked for one pair of materials, and how kernels' coefficients follow from it.

#ifndef TALUS_MATERIAL_CONTACT_SPEC_H
#define TALUS_MATERIAL_CONTACT_SPEC_H

#include "laws/contact_law.h"

namespace LAMMPS_NS {

/// Plain data: goes to restart files as it is.
struct ContactSpec {
  Talus::ContactLaw law;
  /// As given, not yet those of a kernel: for material laws kn, gn, kt, gt are only set if given.
  Talus::ContactCoefficients given;
  bool kt_given = false, gt_given = false, limit_damping = false;
  double young = 0.0, poisson = 0.0, restitution = 1.0;    ///< of material laws

  bool is_material() const { return law.normal >= Talus::NormalLaw::HOOKE_MATERIAL; }
};

/// Rule by which the coefficients of friction and of resistance of unlike materials are found.
enum class FrictionMix : int { MINIMUM, ARITHMETIC, GEOMETRIC };

/// The kernel's coefficients of a contact between bodies of materials a and b, which must have the
/// same normal law; a and b may be the same object. Stiffness and damping that were given by
/// number: arithmetic mean; moduli by compliance; restitution and adhesion: minimum; characteristic
/// and threshold speeds: maximum; friction by `rule`; damping is limited if either material asks
/// for it.
Talus::ContactCoefficients contact_coefficients(const ContactSpec &a, const ContactSpec &b,
                                                FrictionMix rule);

}    // namespace LAMMPS_NS

#endif
