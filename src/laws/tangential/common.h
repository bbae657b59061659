// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What tangential laws have in common: a force F_t along the surface, and its torque per radius n x
// F_t.

#ifndef TALUS_LAWS_TANGENTIAL_COMMON_H
#define TALUS_LAWS_TANGENTIAL_COMMON_H

#include "laws/law_definition.h"

namespace Talus {

/// Relative surface velocity of body 1 against body 2 in the tangent plane:
/// v_t = v - (v.n) n - (r_1 omega_1 + r_2 omega_2) x n  (lever arms are the full radii).
template <class Real> TALUS_INLINE Vector3<Real> surface_velocity(const ContactLanes<Real> &s)
{
  return s.velocity - s.normal_velocity * s.normal - cross(s.surface_rotation, s.normal);
}

/// Shortens a trial force to the limit; forces within it pass unchanged.
template <class Real> inline Vector3<Real> capped(Vector3<Real> trial, Real limit)
{
  const Real square = dot(trial, trial);
  const auto exceeds = square > limit * limit;
  if (!any(exceeds)) return trial;
  return select(exceeds, limit / square_root(square), splat<Real>(1.0)) * trial;
}

template <class Real>
TALUS_INLINE void add_tangential(ContactLanes<Real> &s, const Vector3<Real> &force)
{
  s.tangential = force;
  s.force = s.force + force;
  s.torque_per_radius = cross(s.normal, force);
}

/// The same for laws whose lever arms end in the middle of the overlap, r - overlap/2: the
/// difference to torque_per_radius, which is multiplied by the radii, is on unlike spheres in
/// twisting_torque.
template <class Real>
TALUS_INLINE void add_tangential_in_overlap(ContactLanes<Real> &s, const Vector3<Real> &force)
{
  add_tangential(s, force);
  s.twisting_torque = s.arm_difference * s.torque_per_radius;
  s.torque_per_radius = (splat<Real>(1.0) - s.arm_loss) * s.torque_per_radius;
}

template <class Real> struct FrictionRow {
  Real mu;
};

/// Reads [kt] gt mu; NULL leaves kt or gt to normal law and damping. A spring that is kept must not
/// be missing.
void read_friction(LawReader &r, bool with_kt, bool needs_spring);

struct FrictionLaw : TangentialLaw {
  template <class Real> using Row = FrictionRow<Real>;
  static constexpr CoefficientName coefficients[] = {{"mu"}};
  static constexpr bool reads_stiffness = true;

  static FrictionRow<double> mix(const Mixing &m) { return {m.friction("mu")}; }
};

}    // namespace Talus

#endif
