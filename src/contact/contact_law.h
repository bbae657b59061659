// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Names of the contact laws and the coefficients that one pair of materials has.
// Plain data: parsed by the styles, read by the kernels, written to restart files.

#ifndef TALUS_CONTACT_LAW_H
#define TALUS_CONTACT_LAW_H

namespace Talus {

/// Law of the normal force and of all stiffnesses.
enum class NormalLaw : int { HOOKE, HERTZ };

/// Where the tangential displacement comes from.
///   NONE       frictionless: no tangential force, no torque, no history
///   DASHPOT    no displacement: F_t = gt v_t, capped
///   ONESTEP    displacement of the current step, dt v_t
///   MULTISTEP  displacement accumulated over the life of the contact
enum class TangentialLaw : int { NONE, DASHPOT, ONESTEP, MULTISTEP };

inline constexpr int num_normal_laws = 2;
inline constexpr int num_tangential_laws = 4;

/// Which formulas a pair uses; pairs with equal laws share a kernel.
struct ContactLaw {
  NormalLaw normal = NormalLaw::HOOKE;
  TangentialLaw tangential = TangentialLaw::NONE;

  bool operator==(const ContactLaw &other) const
  {
    return normal == other.normal && tangential == other.tangential;
  }
  bool operator!=(const ContactLaw &other) const { return !(*this == other); }
  bool has_friction() const { return tangential != TangentialLaw::NONE; }
  bool has_history() const { return tangential == TangentialLaw::MULTISTEP; }
};

/// Numbers of one pair of materials.
/// Units: kn, kt force/distance (hooke) or force/distance^2 (hertz); gn, gt 1/time (hooke) or
/// 1/(time distance) (hertz); mu dimensionless; force_floor force.
template <class Real> struct Coefficients {
  Real kn{};             ///< normal stiffness
  Real gn{};             ///< normal damping
  Real kt{};             ///< tangential stiffness
  Real gt{};             ///< tangential damping
  Real mu{};             ///< coefficient of friction
  Real force_floor{};    ///< least normal force: 0 with limit_damping, else -infinity
};
using ContactCoefficients = Coefficients<double>;

const char *name_of(NormalLaw law);
const char *name_of(TangentialLaw law);

}    // namespace Talus

#endif
