// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// No damping.

#ifndef TALUS_LAWS_DAMPING_NONE_H
#define TALUS_LAWS_DAMPING_NONE_H

#include "laws/damping/common.h"

namespace Talus {

struct NoDamping : DampingLaw {
  static constexpr const char *name = "none";
  static constexpr const char *takes_no_gt = "damping none has no tangential damping either";
  template <class Real> struct Row {
    Real floor;
  };
  static constexpr CoefficientName coefficients[] = {{"floor", Shown::NEVER}};

  static void read(LawReader & /*r*/) {}
  static double damping_exponent(double /*elastic*/) { return 0.0; }
  static Row<double> mix(const Mixing &m) { return {least_force(m)}; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.gn = s.gt = splat<Real>(0.0);
    finish_normal_force(c.floor, s);
  }
};

}    // namespace Talus

#endif
