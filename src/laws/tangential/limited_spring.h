// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// multistep ... spring: the Coulomb limit L = mu |F_n| is that of the spring alone, as in LIGGGHTS
// (tangential history):
//
//   kt |d| <= L   F = -(kt d + gt v_t), which may be longer than L
//   kt |d| > L    d <- d L/(kt |d|), F = -kt d: no dashpot while the contact slides
//
// with d as of multistep. Whether the contact slides is stored, so that a set-up without a step
// finds the force that was there: the spring that is stored then has the length of the limit but for
// rounding.

#ifndef TALUS_LAWS_TANGENTIAL_LIMITED_SPRING_H
#define TALUS_LAWS_TANGENTIAL_LIMITED_SPRING_H

#include "laws/tangential/common.h"
#include "laws/tangential/sliding.h"

namespace Talus {

struct MultistepSpring : FrictionLaw {
  static constexpr const char *name = "multistep spring", *label = name;
  static constexpr int odd_history = 3, even_history = 1;    // see TangentialHistory
  static constexpr bool has_spring = true;

  template <class Real>
  static Real stored(const ContactLanes<Real> &s, const Row<Real> & /*c*/, const Real *h)
  {
    const Vector3<Real> d{h[0], h[1], h[2]};
    return 0.5 * s.kt * dot(d, d);
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const Real limit = c.mu * s.critical_force;
    const Vector3<Real> velocity = surface_velocity(s);
    Vector3<Real> d{h[0], h[1], h[2]};
    if (advance && dt > 0.0) {
      d = d + splat<Real>(dt) * velocity;
      d = d - dot(d, s.normal) * s.normal;
    }
    const Real pull = s.kt * square_root(dot(d, d));
    auto slides = pull > limit;
    if (!advance) slides = slides | ((h[3] > zero) & (pull * (1.0 + 1.0e-12) >= limit));
    const Real share = select(slides & (pull > zero), limit / pull, one);
    const Vector3<Real> spring = -(share * s.kt) * d;
    const Vector3<Real> none{zero, zero, zero};
    add_tangential(s, unsigned_zeros(spring - select(slides, none, s.gt * velocity)));
    if constexpr (advance) {
      h[0] = share * d.x;
      h[1] = share * d.y;
      h[2] = share * d.z;
      h[3] = select(slides, one, zero);
    }
  }
};

}    // namespace Talus

#endif
