// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A constant adhesive force F as long as the particles overlap (Chrono).

#ifndef TALUS_LAWS_COHESION_CONSTANT_H
#define TALUS_LAWS_COHESION_CONSTANT_H

#include "laws/law_definition.h"

namespace Talus {

struct ConstantAdhesion : CohesionLaw {
  static constexpr const char *name = "constant";
  template <class Real> struct Row {
    Real force;
  };
  static constexpr CoefficientName coefficients[] = {{"adhesion"}};

  static void read(LawReader &r)
  {
    r.spec.given["adhesive force"] = r.words.not_negative("adhesive force F");
  }
  static Row<double> mix(const Mixing &m) { return {m.smallest("adhesive force")}; }
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
  TALUS_INLINE static Real adhesive_force(const Row<Real> &c, const ContactLanes<Real> & /*s*/)
  {
    return c.force;
  }
};

}    // namespace Talus

#endif
