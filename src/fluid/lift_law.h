// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Lift of a fluid on spheres in shear and on spheres that turn, and the drag of their rotation, by name.
//
// With u, v velocities of fluid and grain, w = u - v, curl u the vorticity of the fluid, d the diameter, rho and mu density
// and dynamic viscosity of the fluid, omega the angular velocity of the grain, O = omega - curl u/2, Re = rho w d/mu,
// Re_O = rho d^2 |O|/mu:
//
//   F = 1.615 d^2 (rho mu/|curl u|)^1/2 w x curl u     in shear (its inertia makes this lift)
//   F = pi/8 rho d^3 O x w                             of rotation
//   T = -c_T O,  c_T = pi mu d^3                       drag of rotation, Re_O <= 32
//
// Sources:
//   saffman          Saffman 1965, J. Fluid Mech. 22, 385, and 1968, 31, 624; Re small against Re_s^1/2, Re_s = rho d^2
//                    |curl u|/mu
//   saffman/mei      times the correction for larger Re of Mei 1992, Int. J. Multiphase Flow 18, 145
//   magnus           Rubinow and Keller 1961, J. Fluid Mech. 11, 447; Re below 1
//   magnus/oesterle  Oesterle and Bui Dinh 1998, Exp. Fluids 25, 16; Re of 10 to 140, the same as magnus for small ones
//   rotation         Stokes' torque (Kirchhoff 1876), above Re_O = 32 T = rho/64 d^5 |O| O (12.9 Re_O^-1/2 + 128.4/Re_O): Dennis,
//                    Singh and Ingham 1980, J. Fluid Mech. 101, 257

#ifndef TALUS_FLUID_LIFT_LAW_H
#define TALUS_FLUID_LIFT_LAW_H

#include "base/vector3.h"

#include <string>
#include <vector>

namespace Talus {

/// What a law is asked about, in one system of units.
struct TurningGrain {
  double diameter;
  Vector3<double> slip;         ///< w
  Vector3<double> omega;        ///< of the grain
  Vector3<double> vorticity;    ///< curl u
  double density, viscosity;
};

class LiftLaw {
 public:
  /// Names, of which any may be taken, but one for shear and one for rotation.
  static const std::vector<std::string> &names();
  /// Takes the law with this number; false: there is another one of its kind already.
  bool take(int which);

  bool any() const { return shear != NONE || turn != NONE || rotation; }
  bool needs_vorticity() const { return shear != NONE; }
  bool drags_rotation() const { return rotation; }

  /// Force on the grain.
  Vector3<double> force(const TurningGrain &grain) const;
  /// c_T of the drag of rotation (torque time), more than 0.
  static double rotation_coefficient(const TurningGrain &grain);

 private:
  enum Kind { NONE, PLAIN, CORRECTED };
  Kind shear = NONE, turn = NONE;
  bool rotation = false;
};

}    // namespace Talus

#endif
