// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How far the periodic image of a particle is from the particle: data only, without LAMMPS. Whoever
// knows the box hands it over before each exchange, because boxes may change.

#ifndef TALUS_EXCHANGE_PERIODIC_BOX_H
#define TALUS_EXCHANGE_PERIODIC_BOX_H

#include "exchange/exchange_plan.h"

#include <array>
#include <vector>

namespace Talus {

/// The periods of a box along its edges, and the tilts of a triclinic one (length).
struct PeriodicBox {
  double x = 0.0, y = 0.0, z = 0.0;
  bool tilted = false;
  double xy = 0.0, xz = 0.0, yz = 0.0;

  /// The single steps of a shift: one period after the other, x first, in the order of the staged
  /// exchange of LAMMPS. Code that adds all of them, zeros included, makes the same additions and
  /// gets the same bits.
  std::vector<std::array<double, 3>> steps_of(const PeriodicShift &shift) const;
};

}    // namespace Talus

#endif
