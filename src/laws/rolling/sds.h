// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Spring, dashpot and slider of rolling, as LAMMPS' pair granular has them (Luding 2008, Granular
// Matter 10, 235; rolling velocity of Wang et al. 2015, Particuology 23, 49): a pseudo-force F_r =
// -(k xi + gamma v_r), v_r = R (omega_1 - omega_2) x n with the effective radius R, not longer than
// mu times critical_force. xi turns with the contact and is set back at the limit like the
// displacement of friction, see granular.h. Torque R n x F_r on body 1, its opposite on body 2. k
// force/length, gamma force/velocity. While a run is set up xi stays as it is.

#ifndef TALUS_LAWS_ROLLING_SDS_H
#define TALUS_LAWS_ROLLING_SDS_H

#include "laws/tangential/granular.h"

namespace Talus {

struct SdsRolling : RollingLaw {
  static constexpr const char *name = "sds", *label = "rolling sds";
  static const Law *order_2(bool adhesive);
  static constexpr bool needs_radius = true;
  static constexpr int even_history = 3;    // v_r is the same for both bodies
  template <class Real> struct Row {
    Real k, gamma, mu;
  };
  static constexpr CoefficientName coefficients[] = {{"k_roll"}, {"gamma_roll"}, {"mu_roll"}};

  static void read(LawReader &r)
  {
    for (const char *number : {"k_roll", "gamma_roll", "mu_roll"}) r.set_not_negative(number);
  }
  static Row<double> mix(const Mixing &m)
  {
    return {m.geometric("k_roll"), m.geometric("gamma_roll"), m.geometric("mu_roll")};
  }
  template <class Real>
  static Real stored(const ContactLanes<Real> & /*s*/, const Row<Real> &c, const Real *h)
  {
    return 0.5 * c.k * (h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    follow<advance, false>(c, s, h, dt);
  }

 protected:
  /// `synchronized`: see tangential/synchronized.h.
  template <bool advance, bool synchronized, class Real>
  TALUS_INLINE static void follow(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    const Real zero = splat<Real>(0.0);
    const SlidingInput<Real> in{c.k, c.gamma, s.radius * cross(s.relative_omega, s.normal),
                                c.mu * s.critical_force, splat<Real>(dt)};
    Vector3<Real> xi{h[0], h[1], h[2]}, force;
    if (advance && dt > 0.0) {
      xi = select(leaves_plane(in, xi, s.normal), rotated_to_plane(xi, s.normal), xi);
      xi = xi + in.dt * in.velocity;
      if constexpr (synchronized)
        xi = select(leaves_plane(in, xi, s.full_normal), rotated_to_plane(xi, s.full_normal), xi);
      TangentialHistory<Real> history = granular_history(xi);
      force = limited_force<advance, false>(in, xi, splat<Real>(dt) > zero, history);
      h[0] = history.displacement.x;
      h[1] = history.displacement.y;
      h[2] = history.displacement.z;
    } else {
      TangentialHistory<Real> history = granular_history(xi);
      force = limited_force<false, false>(in, xi, dot(xi, xi) > zero, history);
    }
    s.twisting_torque = s.twisting_torque + s.radius * cross(s.normal, force);
  }
};

struct SynchronizedSds : SdsRolling {
  static constexpr const char *name = "sds synchronized_verlet", *label = "rolling sds";
  static constexpr std::nullptr_t read = nullptr;

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    follow<advance, true>(c, s, h, dt);
  }
};

}    // namespace Talus

#endif
