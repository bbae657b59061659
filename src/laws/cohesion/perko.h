// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Adhesive force S R_eff as long as the particles overlap (Chrono, after Perko). S force/distance.

#ifndef TALUS_LAWS_COHESION_PERKO_H
#define TALUS_LAWS_COHESION_PERKO_H

#include "laws/law_definition.h"

namespace Talus {

struct PerkoAdhesion : CohesionLaw {
  static constexpr const char *name = "perko";
  template <class Real> struct Row {
    Real s;
  };
  static constexpr CoefficientName coefficients[] = {{"adhesion"}};

  static void read(LawReader &r)
  {
    r.spec.given["adhesion S"] = r.words.not_negative("adhesion S");
  }
  static Row<double> mix(const Mixing &m) { return {m.smallest("adhesion S")}; }
  static double stored(const ContactLanes<double> &s, const Row<double> &c,
                       const double * /*history*/)
  {
    return -adhesive_force(c, s) * s.overlap;
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.force = s.force - (s.adhesive_share * adhesive_force(c, s)) * s.normal;
  }

 private:
  template <class Real>
  TALUS_INLINE static Real adhesive_force(const Row<Real> &c, const ContactLanes<Real> &s)
  {
    return c.s * s.radius;
  }
};

}    // namespace Talus

#endif
