// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How far the periodic image of a particle is from the particle: data only, without LAMMPS. It is
// set before each exchange, because boxes may change.

#ifndef TALUS_EXCHANGE_PERIODIC_BOX_H
#define TALUS_EXCHANGE_PERIODIC_BOX_H

#include "exchange/exchange_plan.h"

#include <array>
#include <cstdlib>

namespace Talus {

/// The periods of a box along its edges, and the tilts of a triclinic one (length).
struct PeriodicBox {
  double x = 0.0, y = 0.0, z = 0.0;
  bool tilted = false;
  double xy = 0.0, xz = 0.0, yz = 0.0;
  /// The box changes its shape, and velocities of images follow: by the rates of these lengths (x,
  /// y, z, yz, xz, xy as in Domain::h_rate).
  bool changes_velocities = false;
  std::array<double, 6> rate{};

  /// visit(step) for the single steps of a shift: one period after the other, x first, in the order
  /// of the staged exchange of LAMMPS. Code that adds all of them, zeros included, makes the same
  /// additions and gets the same bits: the zeros are products too, and their signs decide about
  /// signed zeros of coordinates. A step along y or z has the tilts of a triclinic box.
  template <class Visit> void for_each_step(const PeriodicShift &shift, Visit visit) const
  {
    for (int d = 0; d < 3; d++) {
      const double s = shift[d] > 0 ? 1.0 : -1.0;
      std::array<double, 3> step{0.0, 0.0, 0.0};
      if (d == 0) step[0] = s * x;
      if (d == 1) step = {tilted ? s * xy : 0.0, s * y, 0.0};
      if (d == 2) step = {tilted ? s * xz : 0.0, tilted ? s * yz : 0.0, s * z};
      for (int n = std::abs(shift[d]); n > 0; n--) visit(step);
    }
  }
  /// The same for velocities; not at all where they do not change.
  template <class Visit> void for_each_velocity_step(const PeriodicShift &shift, Visit visit) const
  {
    if (!changes_velocities) return;
    PeriodicBox rates;
    rates.x = rate[0];
    rates.y = rate[1];
    rates.z = rate[2];
    rates.tilted = tilted;
    rates.yz = rate[3];
    rates.xz = rate[4];
    rates.xy = rate[5];
    rates.for_each_step(shift, visit);
  }
};

}    // namespace Talus

#endif
