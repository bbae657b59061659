// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The end of a contact to second order in the time step. A force A t^p that ends a time t = theta
// dt after a step is summed by the steps with the error A dt^p zeta(-p, theta), see second_order.h.
// When it ends is only known in the first step without overlap: there it is made up for, by a force
// that acts in this step alone. Contacts of second order last until then:
//
//   last_overlap()     before the laws are computed: that of a step ago takes the place of the one
//                      that is not there any more, and the laws give the forces that end
//   EndOfContact       what to add for them
//
// Damping with `limit_damping` ends the normal force before the overlap, by gn v/kn. A contact
// remembers that it has ended, so that a set-up finds the same force, and is forgotten in the next
// step.

#ifndef TALUS_LAWS_TANGENTIAL_END_OF_CONTACT_H
#define TALUS_LAWS_TANGENTIAL_END_OF_CONTACT_H

#include "base/flagged_number.h"
#include "base/simd.h"
#include "laws/contact_lanes.h"

namespace Talus {

/// Whether a contact without overlap, which remembers `stored` (see second_order.h), lasts for this
/// step: it has ended on the way here, or, in a set-up, in the last step.
inline bool has_just_ended(double stored, bool advance)
{
  return advance ? stored < 0.0 : stored != 0.0;
}

/// Sets `parted`, and in the place of the overlap that of the last step where the bodies are apart.
template <class Real> TALUS_INLINE void last_overlap(ContactState<Real> &s, double dt)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const auto touches = s.overlap > zero;
  const Real before = s.overlap + dt * dot(s.velocity, s.normal);
  s.parted = select(touches, zero, one);
  s.overlap = select(touches, s.overlap, select(before > zero, before, zero));
}

/// Forces of contacts that have parted, and what these remember from now on.
template <class Real> struct EndOfContact {
  bool_of<Real> parted;
  Real normal_force;
  Vector3<Real> tangential;
  Real history[4];

  void replace(ContactLanes<Real> &s, Vector3<Real> &t, Real *h) const
  {
    s.normal_force = select(parted, normal_force, s.normal_force);
    s.critical_force = select(parted, magnitude(normal_force), s.critical_force);
    s.force = select(parted, normal_force * s.normal, s.force);
    t = select(parted, tangential, t);
    for (int n = 0; n < 4; n++) h[n] = select(parted, history[n], h[n]);
  }
};

}    // namespace Talus

#endif
