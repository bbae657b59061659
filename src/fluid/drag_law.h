// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Drag of a fluid on grains, by name. All formulas of laws are here.
//
//   F = c (u - v)     per grain, without the force of the pressure gradient (model A of Gidaspow)
//
// with d the diameter of the grain (of the sphere of its volume), w = |u - v|, e the porosity, s = 1 - e the solid fraction,
// rho and mu density and dynamic viscosity of the fluid, Re = rho e w d/mu the Reynolds number of the superficial
// velocity. Cd is a drag coefficient, beta the coefficient per volume: c = beta (pi/6 d^3)/s. Laws are written so that
// none has a pole at w = 0.
//
// Sources:
//   stokes            Stokes 1851; c = 3 pi mu d
//   schiller/naumann  Schiller and Naumann 1935, Z. VDI 77, 318; Re without e
//   ganser            Ganser 1993, Powder Technol. 77, 143, isometric shapes of sphericity S; Re without e
//   difelice          Di Felice 1994, Int. J. Multiphase Flow 20, 153; Cd of Dallavalle
//   wen/yu            Wen and Yu 1966, Chem. Eng. Prog. Symp. Ser. 62, 100
//   ergun             Ergun 1952, Chem. Eng. Prog. 48, 89
//   gidaspow          Gidaspow 1994, Multiphase Flow and Fluidization: ergun for e <= 0.8, wen/yu above
//   koch/hill         Hill, Koch and Ladd 2001, J. Fluid Mech. 448, 213 and 243, with one line for all Reynolds numbers as in
//                     Deen et al. 2007, Chem. Eng. Sci. 62, 28
//   beetstra          Beetstra, van der Hoef and Kuipers 2007, AIChE J. 53, 489; grains of one size
//   hoelzer/sommerfeld  Hoelzer and Sommerfeld 2008, Powder Technol. 184, 361, eq. 9 with the crosswise sphericity in
//                     place of the lengthwise one; sphericities of the shape as it is turned; Re without e
//   rong              Rong, Dong and Yu 2013, Chem. Eng. Sci. 99, 44

#ifndef TALUS_FLUID_DRAG_LAW_H
#define TALUS_FLUID_DRAG_LAW_H

#include <string>
#include <vector>

namespace Talus {

/// What a law is asked about, in one system of units.
struct GrainInFluid {
  double diameter;
  double speed;       ///< w, 0 or more
  double porosity;    ///< 0 < e <= 1
  double density, viscosity;
  /// Surface of the sphere with its volume over its own; the same of cross sections, of its own that which the fluid sees.
  double sphericity = 1.0, crosswise = 1.0;
};

class DragLaw {
 public:
  /// Names, in the order of numbers.
  static const std::vector<std::string> &names();
  /// `which`: place of its name. `sphericity`, of ganser: 0 < S <= 1, 1: a sphere. `total`: the force of the pressure
  /// gradient that drag itself makes is in c as well, c/e (model B): for partners that give no gradient of the pressure.
  explicit DragLaw(int which = 0, double sphericity = 1.0, bool total = false);

  /// c (force/velocity), 0 or more.
  double coefficient(const GrainInFluid &grain) const;
  bool depends_on_porosity() const;
  static bool has_sphericity(int which);
  /// Are sphericities of grains asked for?
  bool depends_on_shape() const;

 private:
  int law;
  double sphericity;
  bool total;
};

}    // namespace Talus

#endif
