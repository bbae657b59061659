// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What normal laws with adhesion of their own have in common. gamma energy/area is that of LAMMPS'
// pair granular, the work of separation being 2 gamma.

#ifndef TALUS_LAWS_NORMAL_ADHESIVE_H
#define TALUS_LAWS_NORMAL_ADHESIVE_H

#include "laws/normal/common.h"

#include <limits>

namespace Talus {

/// Young's modulus that is effective in a contact, surface energy gamma.
template <class Real> struct AdhesiveRow {
  Real young, gamma;
};

struct AdhesiveLaw : HertzianLaw {
  static constexpr bool cohesive = true;
  static constexpr const char *damping = "viscoelastic";
  template <class Real> using Row = AdhesiveRow<Real>;
  static constexpr CoefficientName coefficients[] = {{"E_eff"}, {"gamma"}};

  /// E, damping coefficient, nu, gamma.
  static void read(LawReader &r)
  {
    read_material(r, Damping::ANY);
    r.set_not_negative("gamma");
  }

  /// E_eff is given itself, or follows from E and nu.
  static AdhesiveRow<double> mix(const Mixing &m)
  {
    return {m.both_have("E_eff") ? m.geometric("E_eff") : mixed_young(m), m.geometric("gamma")};
  }
  static double modulus(const AdhesiveRow<double> & /*c*/) { return 0.0; }

 protected:
  static constexpr double pi = 3.14159265358979323846;

  /// Positive without adhesion as well: that the law is cohesive is known by it.
  template <class Real>
  TALUS_INLINE static Real pulloff_force(double factor, Real gamma, const ContactLanes<Real> &s)
  {
    const Real force = (factor * pi) * gamma * s.radius;
    const Real least = splat<Real>(std::numeric_limits<double>::min());
    return select(force > least, force, least);
  }
};

}    // namespace Talus

#endif
