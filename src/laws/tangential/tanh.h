// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Chrono's PlainCoulomb: F_t = -mu F_n tanh(5 |v_t|) v_t/|v_t|, with the sign of F_n; the 5 has the
// unit 1/velocity and is not scaled by `units`. None below a speed. Comes with the normal laws of
// that name.

#ifndef TALUS_LAWS_TANGENTIAL_TANH_H
#define TALUS_LAWS_TANGENTIAL_TANH_H

#include "laws/tangential/common.h"

namespace Talus {

struct Tanh : TangentialLaw {
  static constexpr const char *name = "tanh", *label = name;
  template <class Real> struct Row {
    Real mu, slip_min;
  };
  static constexpr CoefficientName coefficients[] = {{"mu"}, {"slip_min", Shown::NEVER}};
  static constexpr double default_slip_min = 1.0e-4;    // Chrono's
  static const Law *order_2(bool adhesive);

  static Row<double> mix(const Mixing &m)
  {
    return {m.friction("mu"), m.largest("slip_min", default_slip_min)};
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    add_tangential(s, force(c, s.normal_force, surface_velocity(s)));
  }

  template <class Real>
  TALUS_INLINE static Vector3<Real> force(const Row<Real> &c, Real normal_force,
                                          const Vector3<Real> &velocity)
  {
    const Real speed = square_root(dot(velocity, velocity));
    const auto slips = (speed >= c.slip_min) & (speed > splat<Real>(0.0));
    const Real pull = c.mu * normal_force * hyperbolic_tangent(5.0 * speed) / speed;
    return select(slips, -pull, splat<Real>(0.0)) * velocity;
  }
};

}    // namespace Talus

#endif
