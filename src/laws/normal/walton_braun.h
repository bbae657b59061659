// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Walton and Braun (1986, J. Rheology 30, 949): F_e = k1 overlap where a contact is as deep as never before, else
//
//   F_e = k2 (overlap - d_0) >= 0,   d_0 = (1 - k1/k2) m
//
// with the largest overlap m. Without other damping the restitution is sqrt(k1/k2) at all speeds.

#ifndef TALUS_LAWS_NORMAL_WALTON_BRAUN_H
#define TALUS_LAWS_NORMAL_WALTON_BRAUN_H

#include "laws/normal/hysteretic.h"

namespace Talus {

struct WaltonBraun : HystereticLaw {
  static constexpr const char *name = "walton/braun", *label = name;
  template <class Real> using Row = HystereticRow<Real>;
  static constexpr CoefficientName coefficients[] = {{"k1"}, {"k2"}, {"kt", Shown::WITH_SPRING}};

  static void read(LawReader &r)
  {
    read_stiffnesses(r);
    read_damping(r, Damping::ANY);
  }
  static Row<double> mix(const Mixing &m) { return mix_stiffnesses(m); }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *history,
                                   double /*dt*/)
  {
    const Real deepest = at_least(history[0], s.overlap);
    const Real force = c.k2 * s.overlap - (c.k2 - c.k1) * deepest;
    set(s, c.k2, at_least(force, splat<Real>(0.0)), c.k2, c.kt);
    if constexpr (advance) history[0] = deepest;
  }
};

}    // namespace Talus

#endif
