// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Flores et al. 2011 from material: gn = f kn overlap/v, gt = h sqrt(S_t m) with f = 8/5 (1-e)/e
// and h = 2 sqrt(5/6) |beta(e)|, both with e between .01 and 1. v: impact speed if it is kept, at
// least the characteristic speed. A gt that was given by number replaces h.

#ifndef TALUS_LAWS_DAMPING_FLORES_MATERIAL_H
#define TALUS_LAWS_DAMPING_FLORES_MATERIAL_H

#include "laws/damping/common.h"

namespace Talus {

struct FloresMaterialDamping : DampingLaw {
  static constexpr const char *name = "flores/material";
  static constexpr bool reads_impact = true;
  template <class Real> struct Row {
    Real gn, gt, floor, speed;
  };
  static constexpr CoefficientName coefficients[] = {{"damping"},
                                                     {"tangential damping", Shown::WITH_SPRING},
                                                     {"floor", Shown::NEVER},
                                                     {"vchar", Shown::NEVER}};

  static void read_coefficient(LawReader &r)
  {
    r.spec.given["e"] = r.words.between("restitution e", 0.0, 1.0);
  }
  static double damping_exponent(double /*elastic*/) { return 1.5; }
  static double dashpot_exponent(double /*elastic*/) { return 0.25; }
  static Row<double> mix(const Mixing &m)
  {
    const double e = m.smallest("e");
    return {flores_damping_factor(e),
            m.both_have("gt") ? m.mean("gt") : hertz_damping_factor(flores_restitution(e)),
            least_force(m), m.largest("vchar")};
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    const Real speed = select(s.impact_speed > c.speed, s.impact_speed, c.speed);
    s.gn = c.gn * s.kn * s.overlap / speed;
    s.gt = c.gt * square_root(s.tangent_t * s.mass);
    finish_normal_force(c.floor, s);
  }
};

}    // namespace Talus

#endif
