// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Damping that gives a coefficient of restitution: f sqrt(S_n m), f sqrt(S_t m) with the tangent
// stiffnesses S of the normal law and f of restitution.h. A gt that was given by number replaces
// the second f.

#ifndef TALUS_LAWS_DAMPING_RESTITUTION_H
#define TALUS_LAWS_DAMPING_RESTITUTION_H

#include "laws/damping/common.h"

namespace Talus {

struct RestitutionDamping : DampingLaw {
  static constexpr const char *name = "restitution";
  template <class Real> using Row = DampingRow<Real>;
  static constexpr CoefficientName coefficients[] = {
      {"damping"}, {"tangential damping", Shown::WITH_SPRING}, {"floor", Shown::NEVER}};

  static void read_coefficient(LawReader &r)
  {
    r.spec.given["e"] = r.words.between("restitution e", 0.0, 1.0);
  }
  static double damping_exponent(double elastic) { return 0.5 * (elastic - 1.0); }
  static DampingRow<double> mix(const Mixing &m)
  {
    const double f = factor(m);
    return {f, m.both_have("gt") ? m.mean("gt") : f, least_force(m)};
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.gn = c.gn * square_root(s.tangent_n * s.mass);
    s.gt = c.gt * square_root(s.tangent_t * s.mass);
    finish_normal_force(c.floor, s);
  }

 private:
  static double factor(const Mixing &m)
  {
    const double e = m.smallest("e");
    // which some laws are given
    const double exponent = m.a.given.value("n", m.a.law.normal().exponent);
    if (exponent == 1.0)
      return m.limits_damping() ? linear_damping_factor_limited(e) : linear_damping_factor(e);
    return m.limits_damping() ? hertz_damping_factor_limited(e) : hertz_damping_factor(e);
  }
};

}    // namespace Talus

#endif
