// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Adhesive force W sqrt(R_eff) as long as the particles overlap (Chrono). W force/distance^(1/2).

#ifndef TALUS_LAWS_COHESION_DMT_H
#define TALUS_LAWS_COHESION_DMT_H

#include "laws/law_definition.h"

namespace Talus {

struct DmtAdhesion : CohesionLaw {
  static constexpr const char *name = "dmt";
  template <class Real> struct Row {
    Real w;
  };
  static constexpr CoefficientName coefficients[] = {{"adhesion"}};

  static void read(LawReader &r)
  {
    r.spec.given["adhesion W"] = r.words.not_negative("adhesion W");
  }
  static Row<double> mix(const Mixing &m) { return {m.smallest("adhesion W")}; }
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
    return c.w * square_root(s.radius);
  }
};

}    // namespace Talus

#endif
