// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Elastic-plastic spring, as rolling_friction epsd2 of LIGGGHTS (model C of Ai et al. 2011, Powder
// Technology 206, 269, without dashpot): that of sds.h with the tangential stiffness as its own, so
// that the torque grows by kt R^2 for each unit of rolling angle, up to mu_r R |F_n|.

#ifndef TALUS_LAWS_ROLLING_EPSD2_H
#define TALUS_LAWS_ROLLING_EPSD2_H

#include "laws/contact_law.h"
#include "laws/rolling/sds.h"

#include <string>

namespace Talus {

struct Epsd2Rolling : SdsRolling {
  static constexpr const char *name = "epsd2", *label = "rolling epsd2";
  static constexpr std::nullptr_t order_2 = nullptr;
  template <class Real> struct Row {
    Real mu;
  };
  static constexpr CoefficientName coefficients[] = {{"mu_epsd2"}};

  static void read(LawReader &r)
  {
    r.set_not_negative("mu_epsd2");
    r.check_later(r.words.index() - 1, [](const ContactLaw &law) -> std::string {
      if (law.tangential().reads_stiffness) return "";
      return "epsd2 takes the stiffness of the tangential law: expected dashpot, onestep or "
             "multistep";
    });
  }
  static Row<double> mix(const Mixing &m) { return {m.friction("mu_epsd2")}; }
  template <class Real>
  static Real stored(const ContactLanes<Real> &s, const Row<Real> & /*c*/, const Real *h)
  {
    return 0.5 * s.kt * (h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    SdsRolling::follow<advance, false>(SdsRolling::Row<Real>{s.kt, splat<Real>(0.0), c.mu}, s, h,
                                       dt);
  }
};

}    // namespace Talus

#endif
