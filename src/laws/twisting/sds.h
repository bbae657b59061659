// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Twisting with coefficients of its own: k torque, gamma torque time, limit mu times
// critical_force, mu length; see spring.h.

#ifndef TALUS_LAWS_TWISTING_SDS_H
#define TALUS_LAWS_TWISTING_SDS_H

#include "laws/twisting/spring.h"

namespace Talus {

struct SdsTwist : TwistingLaw {
  static constexpr const char *name = "sds", *label = "twisting sds";
  static constexpr int even_history = 1;
  template <class Real> struct Row {
    Real k, gamma, mu;
  };
  static constexpr CoefficientName coefficients[] = {{"k_twist"}, {"gamma_twist"}, {"mu_twist"}};

  static void read(LawReader &r)
  {
    for (const char *number : {"k_twist", "gamma_twist", "mu_twist"}) r.set_not_negative(number);
  }
  static Row<double> mix(const Mixing &m)
  {
    return {m.geometric("k_twist"), m.geometric("gamma_twist"), m.geometric("mu_twist")};
  }
  template <class Real>
  static Real stored(const ContactLanes<Real> & /*s*/, const Row<Real> &c, const Real *h)
  {
    return 0.5 * c.k * h[0] * h[0];
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    add_twisting_spring<advance>(TwistInput<Real>{c.k, c.gamma, c.mu * s.critical_force}, s, h[0],
                                 dt);
  }
};

}    // namespace Talus

#endif
