// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What damping laws have in common: F_n = F_e - gn v_n, which is attractive when particles separate
// fast, unless limit_damping cuts it at zero. m and R are the effective mass and radius, a the
// contact radius.

#ifndef TALUS_LAWS_DAMPING_COMMON_H
#define TALUS_LAWS_DAMPING_COMMON_H

#include "laws/law_definition.h"
#include "laws/restitution.h"

namespace Talus {

/// Damping in the units of the law, and the least normal force: 0 with limit_damping, else
/// -infinity.
template <class Real> struct DampingRow {
  Real gn, gt, floor;
};

/// The least normal force of a contact.
double least_force(const Mixing &m);

/// From gn to the normal force. Friction is limited to mu times its magnitude; with adhesion of the
/// normal law to mu |F_e + 2 pull-off force|, without damping: Marshall 2009 (J. Comput. Phys. 228,
/// 1541), as LAMMPS' pair granular has it.
template <class Real> TALUS_INLINE void finish_normal_force(Real floor, ContactLanes<Real> &s)
{
  const Real elastic_damped = s.elastic - s.gn * s.normal_velocity;
  s.normal_force = select(elastic_damped < floor, floor, elastic_damped);
  s.critical_force = magnitude(select(s.pulloff_force > splat<Real>(0.0),
                                      s.elastic + 2.0 * s.pulloff_force, s.normal_force));
  s.force = s.normal_force * s.normal;
}

/// Damping by number: arithmetic means; gt that was not given is gn/2, as in the stock styles.
struct DampingByNumber : DampingLaw {
  template <class Real> using Row = DampingRow<Real>;
  static constexpr CoefficientName coefficients[] = {
      {"gn"}, {"gt", Shown::WITH_SPRING}, {"floor", Shown::NEVER}};

  static DampingRow<double> mix(const Mixing &m)
  {
    const auto gt = [](const ContactSpec &s) {
      return s.given.value("gt", 0.5 * s.given.value("gn"));
    };
    return {m.mean("gn"), 0.5 * (gt(m.a) + gt(m.b)), least_force(m)};
  }
};

}    // namespace Talus

#endif
