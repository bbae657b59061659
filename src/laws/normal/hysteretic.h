// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What piecewise linear laws with a memory have in common: the largest overlap m that a contact has had, as its branches
// set it back. F_e = k overlap - (k - k1) m on the branch of unloading and loading again, with its slope k; the energy
// that is given back is that of a spring k with the force F_e. Tangential: a constant kt, 2/7 k1 if it is not given.

#ifndef TALUS_LAWS_NORMAL_HYSTERETIC_H
#define TALUS_LAWS_NORMAL_HYSTERETIC_H

#include "laws/normal/common.h"

namespace Talus {

template <class Real> struct HystereticRow {
  Real k1, k2, kt;
};

/// The larger of two.
template <class Real> TALUS_INLINE Real at_least(Real a, Real least)
{
  return select(a > least, a, least);
}

struct HystereticLaw : NormalLaw {
  static constexpr bool hysteretic = true, needs_radius = true;    // for the contact radius
  static constexpr int even_history = 1;                           // m

  /// kn is the slope of the branch.
  template <class Row>
  static double stored(const ContactLanes<double> &s, const Row & /*c*/, const double * /*history*/)
  {
    return s.kn > 0.0 ? 0.5 * s.elastic * s.elastic / s.kn : 0.0;
  }

 protected:
  /// k1 k2, k2 the larger one.
  static void read_stiffnesses(LawReader &r)
  {
    GivenNumbers &given = r.spec.given;
    given["k1"] = r.words.positive("stiffness k1 of loading");
    given["k2"] = r.words.positive("stiffness k2 of unloading");
    if (!(given["k2"] > given["k1"]))
      r.words.fail(1, "the stiffness k2 of unloading must be larger than k1, that of loading");
  }
  static HystereticRow<double> mix_stiffnesses(const Mixing &m)
  {
    const auto kt = [](const ContactSpec &s) {
      return s.given.value("kt", 2.0 / 7.0 * s.given.value("k1"));
    };
    return {m.mean("k1"), m.mean("k2"), 0.5 * (kt(m.a) + kt(m.b))};
  }

  /// The steepest branch is what time steps depend on.
  template <class Real>
  TALUS_INLINE static void set(ContactLanes<Real> &s, Real slope, Real force, Real k2, Real kt)
  {
    s.kn = slope;
    s.tangent_n = k2;
    s.kt = s.tangent_t = kt;
    s.contact_radius = square_root(s.overlap * s.radius);
    s.elastic = force;
  }
};

}    // namespace Talus

#endif
