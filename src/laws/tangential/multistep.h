// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The displacement of the surfaces is kept for the life of a contact: F_t = -(kt d_t + gt v_t), not
// longer than mu |F_n|; see sliding.h for what happens to d_t at this limit. Every step adds dt v_t
// and takes away the part of d_t along the normal. A step with dt = 0 is how the stock styles set a
// run up: only the limit acts, and beyond it there is no force without a displacement.
//
// With `midpoint` the update of the displacement is consistent to second order in the time step:
//   * the displacement of a step is taken along the surface half way through it, not at its end;
//   * a contact that began during the step adds only the part of it that it lasted;
//   * the stored displacement keeps its length when it turns with the contact.
// (Xue et al. 2023, CMES 134, 1469, on why the usual update limits a scheme to first order.)

#ifndef TALUS_LAWS_TANGENTIAL_MULTISTEP_H
#define TALUS_LAWS_TANGENTIAL_MULTISTEP_H

#include "laws/approach.h"
#include "laws/tangential/common.h"
#include "laws/tangential/sliding.h"

namespace Talus {

/// Displacement of the surfaces during the step that led here.
template <class Real>
inline Vector3<Real> step_displacement(const ContactLanes<Real> &s, double dt, Real time)
{
  const Vector3<Real> n = normal_half_way(s, splat<Real>(dt));
  const Vector3<Real> slip = s.velocity - dot(s.velocity, n) * n - cross(s.surface_rotation, n);
  return time * slip;
}

/// d in the plane normal to n, with its length.
template <class Real>
inline Vector3<Real> rotated_to_plane(const Vector3<Real> &d, const Vector3<Real> &n)
{
  const Vector3<Real> flat = d - dot(d, n) * n;
  const Real before = dot(d, d), after = dot(flat, flat);
  return select(after > splat<Real>(0.0), square_root(before / after), splat<Real>(0.0)) * flat;
}

/// The rules differ in how far they are from the same limit for small time steps.
const Law *multistep_order_2(bool adhesive);

template <bool midpoint, bool slider> struct Multistep : FrictionLaw {
  static constexpr const char *name =
      slider     ? midpoint ? "multistep slider midpoint" : "multistep slider"
      : midpoint ? "multistep midpoint"
                 : "multistep";
  static constexpr const char *label = name;
  static constexpr int odd_history = 3, even_history = 1;    // see TangentialHistory
  static constexpr bool has_spring = true, is_midpoint = midpoint;
  static const Law *order_2(bool adhesive) { return multistep_order_2(adhesive); }

  template <class Real>
  static Real stored(const ContactLanes<Real> &s, const Row<Real> & /*c*/, const Real *h)
  {
    const Vector3<Real> d{h[0], h[1], h[2]};
    return 0.5 * s.kt * dot(d, d);
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    const Real zero = splat<Real>(0.0);
    TangentialHistory<Real> history{{h[0], h[1], h[2]}, h[3]};
    SlidingInput<Real> in{s.kt, s.gt, surface_velocity(s), c.mu * s.critical_force,
                          splat<Real>(dt)};
    Vector3<Real> d = history.displacement;
    if constexpr (advance && midpoint) {
      in.dt = dt * share_of_step(s, dt);
      d = rotated_to_plane(d, s.normal) +
          rotated_to_plane(step_displacement(s, dt, in.dt), s.normal);
    } else if constexpr (advance)
      d = d + in.dt * in.velocity;
    auto moved = splat<Real>(dt) > zero;    // where time passes, a force beyond the limit has one
    if (!advance || slider || !(dt > 0.0)) moved = dot(d, d) > zero;
    if constexpr (advance && !midpoint)
      if (dt > 0.0) d = d - dot(d, s.normal) * s.normal;
    add_tangential(s, limited_force<advance, slider>(in, d, moved, history));
    h[0] = history.displacement.x;
    h[1] = history.displacement.y;
    h[2] = history.displacement.z;
    h[3] = history.sliding;
  }
};

/// The word multistep: kt gt mu [midpoint] [stock | slider]. The other laws of this file are chosen
/// by the words that follow it.
struct MultistepStock : Multistep<false, false> {
  static void read(LawReader &r);
};

}    // namespace Talus

#endif
