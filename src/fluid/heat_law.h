// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Heat from a fluid to grains, by name: Q = Nu pi d k (T_fluid - T_grain) per grain, with d its diameter (of the sphere
// of its volume), k the conductivity of the fluid, and the Nusselt number
//
//   ranz/marshall   Nu = 2 + 0.6 Re'^1/2 Pr^1/3          Chem. Eng. Prog. 48, 141 and 173, 1952; single grains
//   gunn            Nu = (7 - 10 e + 5 e^2)(1 + 0.7 Re^0.2 Pr^1/3) + (1.33 - 2.4 e + 1.2 e^2) Re^0.7 Pr^1/3
//                   Int. J. Heat Mass Transfer 21, 467, 1978; e from 0.35 to 1, Re to 1e5
//
// e porosity, Re = rho e w d/mu, w = |u - v|, Re' = Re/e, Pr = c_p mu/k.

#ifndef TALUS_FLUID_HEAT_LAW_H
#define TALUS_FLUID_HEAT_LAW_H

#include "fluid/drag_law.h"

#include <string>
#include <vector>

namespace Talus {

class HeatLaw {
 public:
  /// Names, in the order of numbers.
  static const std::vector<std::string> &names();
  explicit HeatLaw(int which) : law(which) {}

  /// Nu; `prandtl` of the fluid, above 0.
  double nusselt(const GrainInFluid &grain, double prandtl) const;
  bool depends_on_porosity() const;

 private:
  int law;
};

}    // namespace Talus

#endif
