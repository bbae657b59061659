// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Damping that gives the coefficient of restitution eta, as LAMMPS' pair granular has it
// (Brilliantov et al. 1996): gn = f sqrt(m kn) with kn = F_e/overlap, f = -2 ln eta/sqrt(pi^2 +
// ln^2 eta) of a linear law and -sqrt(5) ln eta/sqrt(pi^2 + ln^2 eta) of a Hertzian one. Between
// 1e-300 and 1: no finite damping gives eta = 0.

#ifndef TALUS_LAWS_DAMPING_COEFF_RESTITUTION_H
#define TALUS_LAWS_DAMPING_COEFF_RESTITUTION_H

#include "laws/damping/tsuji.h"

#include <algorithm>
#include <cmath>

namespace Talus {

struct CoeffRestitution : StiffnessDamping {
  static constexpr const char *name = "coeff_restitution";

  static Row<double> mix(const Mixing &m)
  {
    constexpr double pi = 3.14159265358979323846;
    const double logarithm = std::log(std::max(m.geometric("eta"), 1.0e-300));
    const double share = -logarithm / std::sqrt(pi * pi + logarithm * logarithm);
    return {(m.a.law.normal().exponent == 1.0 ? 2.0 : std::sqrt(5.0)) * share, least_force(m)};
  }
};

}    // namespace Talus

#endif
