// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Names of the contact laws and the coefficients that one pair of materials has.
// Plain data: parsed by the styles, read by the kernels, written to restart files.

#ifndef TALUS_LAWS_CONTACT_LAW_H
#define TALUS_LAWS_CONTACT_LAW_H

namespace Talus {

/// Law of the normal force and of all stiffnesses; see normal_laws.h.
enum class NormalLaw : int {
  HOOKE,
  HERTZ,
  FLORES,
  PLAINCOULOMB,
  HOOKE_MATERIAL,
  HERTZ_MATERIAL,
  FLORES_MATERIAL,
  PLAINCOULOMB_MATERIAL
};

/// The elastic force is proportional to the overlap; with all others the stiffness grows with it.
inline bool is_linear(NormalLaw law)
{
  return law == NormalLaw::HOOKE || law == NormalLaw::HOOKE_MATERIAL;
}

/// Where the tangential force comes from; see tangential_laws.h.
///   NONE       frictionless: no tangential force, no torque, no history
///   DASHPOT    no displacement: F_t = gt v_t, capped
///   ONESTEP    displacement of the current step, dt v_t
///   MULTISTEP  displacement accumulated over the life of the contact
///   TANH       PlainCoulomb's: mu tanh(5 v_t) F_n
///   MIDPOINT   MULTISTEP with an update of the displacement that is consistent to second order
///   SLIDER, SLIDER_MIDPOINT   the same two with the dashpot in series with the slip
enum class TangentialLaw : int {
  NONE,
  DASHPOT,
  ONESTEP,
  MULTISTEP,
  TANH,
  MIDPOINT,
  SLIDER,
  SLIDER_MIDPOINT
};

inline constexpr int num_normal_laws = 8;
inline constexpr int num_tangential_laws = 8;

/// Which formulas a pair uses; pairs with equal laws share a kernel.
struct ContactLaw {
  NormalLaw normal = NormalLaw::HOOKE;
  TangentialLaw tangential = TangentialLaw::NONE;
  bool resists = false;    ///< rolling or spinning resistance; needs friction
  bool adheres = false;
  bool delayed = false;    ///< resistance acts only after one collision time

  bool operator==(const ContactLaw &o) const
  {
    return normal == o.normal && tangential == o.tangential && resists == o.resists &&
           adheres == o.adheres && delayed == o.delayed;
  }
  bool operator!=(const ContactLaw &o) const { return !(*this == o); }

  /// Spins are read, torques arise.
  bool has_friction() const { return tangential != TangentialLaw::NONE || resists; }
  /// The tangential displacement is kept.
  bool has_history() const
  {
    return tangential == TangentialLaw::MULTISTEP || tangential >= TangentialLaw::MIDPOINT;
  }
  /// Impact speed and age are kept as well.
  bool has_impact() const
  {
    const bool needs_speed =
        normal == NormalLaw::HOOKE_MATERIAL || normal == NormalLaw::FLORES_MATERIAL;
    return has_history() && (needs_speed || (resists && delayed));
  }
};

/// Numbers of one pair of materials. Units: see normal_laws.h for kn, gn, kt, gt and the adhesive
/// coefficients; mu, mu_roll, mu_twist are dimensionless.
template <class Real> struct Coefficients {
  Real kn{};                ///< normal stiffness, or effective Young's modulus
  Real gn{};                ///< normal damping
  Real kt{};                ///< tangential stiffness, or effective shear modulus
  Real gt{};                ///< tangential damping
  Real mu{};                ///< coefficient of friction
  Real force_floor{};       ///< least normal force: 0 with limit_damping, else -infinity
  Real speed{};             ///< characteristic speed of hooke/material and flores/material
  Real mu_roll{};           ///< rolling resistance: torque / (radius F_n)
  Real mu_twist{};          ///< spinning resistance: torque / (radius of the overlap circle F_n)
  Real adhesion{};          ///< constant adhesive force
  Real adhesion_dmt{};      ///< times sqrt(R_eff)
  Real adhesion_perko{};    ///< times R_eff
  Real slip_min{};          ///< plaincoulomb: no friction below this surface velocity
  Real roll_min{};          ///< no rolling resistance below this velocity
  Real twist_min{};         ///< no spinning resistance below this angular velocity
};
using ContactCoefficients = Coefficients<double>;

/// Words of the input script.
const char *name_of(NormalLaw law);
const char *name_of(TangentialLaw law);

}    // namespace Talus

#endif
