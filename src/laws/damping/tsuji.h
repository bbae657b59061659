// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Damping of Tsuji, Tanaka and Ishida (1992, Powder Technology 71, 239), as LAMMPS' pair granular
// has it: gn = f sqrt(m kn) with kn = F_e/overlap, and f a polynomial of the coefficient eta, which
// is the restitution of a Hertzian contact. gt of laws that read it is half of gn.

#ifndef TALUS_LAWS_DAMPING_TSUJI_H
#define TALUS_LAWS_DAMPING_TSUJI_H

#include "laws/damping/common.h"

namespace Talus {

/// gn = f sqrt(m kn); gt = gt_share gn.
struct StiffnessDamping : DampingLaw {
  static constexpr bool allows_cohesion = false;
  static constexpr const char *takes_no_gt =
      "with damping tsuji and coeff_restitution it is half of the normal damping";
  template <class Real> struct Row {
    Real factor, floor;
  };
  static constexpr CoefficientName coefficients[] = {{"damping"}, {"floor", Shown::NEVER}};

  static void read(LawReader & /*r*/) {}
  static void read_coefficient(LawReader &r)
  {
    r.spec.given["eta"] = r.words.between("restitution eta", 0.0, 1.0);
  }
  static double damping_exponent(double elastic) { return 0.5 * (elastic - 1.0); }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.gn = c.factor * square_root(s.mass * s.kn);
    s.gt = 0.5 * s.gn;
    finish_normal_force(c.floor, s);
  }
};

struct Tsuji : StiffnessDamping {
  static constexpr const char *name = "tsuji";

  static Row<double> mix(const Mixing &m)
  {
    const double e = m.geometric("eta");
    return {1.2728 + e * (-4.2783 +
                          e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218))))),
            least_force(m)};
  }
};

}    // namespace Talus

#endif
