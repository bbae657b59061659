// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Flores et al. 2011 with coefficients: springs of hertz, normal damping times the overlap. kn, kt
// pressure.

#ifndef TALUS_LAWS_NORMAL_FLORES_H
#define TALUS_LAWS_NORMAL_FLORES_H

#include "laws/normal/hertz.h"

namespace Talus {

struct Flores : Hertz {
  static constexpr const char *name = "flores", *label = name;
  static constexpr const char *damping = "flores";
  static constexpr bool like_stock = false;

  static void read(LawReader &r)
  {
    read_numbers(r, Damping::OWN);
    r.spec.given["kn"] *= r.pressure_unit;
  }
  template <class Real> static void reduce(Real overlap, Real &k, Real &g)
  {
    const Real root = square_root(overlap);
    k = k / root;
    g = g / (root * overlap);
  }
};

}    // namespace Talus

#endif
