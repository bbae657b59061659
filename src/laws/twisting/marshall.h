// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Twisting from the friction of pair granular (Marshall 2009, J. Comput. Phys. 228, 1541, equations
// 30 to 44): with the contact radius a, k = kt a^2/2, damping xt gn a^2/2, limit 2/3 a mu times
// critical_force; see spring.h. kt is that of the tangential law before it is scaled by a, as in
// LAMMPS.

#ifndef TALUS_LAWS_TWISTING_MARSHALL_H
#define TALUS_LAWS_TWISTING_MARSHALL_H

#include "laws/tangential/granular.h"
#include "laws/twisting/spring.h"

namespace Talus {

struct MarshallTwist : TwistingLaw {
  static constexpr const char *name = "marshall", *label = "twisting marshall";
  static constexpr bool needs_radius = true;
  static constexpr int even_history = 1;
  template <class Real> using Row = GranularRow<Real>;
  static constexpr CoefficientName coefficients[] = {
      {"kt", Shown::NEVER}, {"xt", Shown::NEVER}, {"mu", Shown::NEVER}};

  static void read(LawReader &r);
  /// The row of the tangential law.
  static GranularRow<double> mix(const Mixing &m)
  {
    double row[ContactCoefficients::size];
    m.a.law.tangential().mix(m, row);
    return {row[0], row[1], row[2]};
  }
  template <class Real>
  static Real stored(const ContactLanes<Real> &s, const Row<Real> &c, const Real *h)
  {
    return 0.25 * c.kt * s.contact_radius * s.contact_radius * h[0] * h[0];
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    const Real a = s.contact_radius, half_square = 0.5 * a * a;
    const TwistInput<Real> in{c.kt * half_square, c.xt * s.gn * half_square,
                              (2.0 / 3.0) * a * c.mu * s.critical_force};
    add_twisting_spring<advance>(in, s, h[0], dt);
  }
};

}    // namespace Talus

#endif
