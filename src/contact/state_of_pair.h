// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The changes of velocities that a contact of two spheres sees, one pair at a time: for queries.
// The same numbers as ContactChunk gathers.

#ifndef TALUS_CONTACT_STATE_OF_PAIR_H
#define TALUS_CONTACT_STATE_OF_PAIR_H

#include "laws/contact_lanes.h"
#include "particles/change_record.h"

namespace Talus {

/// Sets all three changes from those of the particles, with these radii.
inline void set_changes(ContactState<double> &s, const ChangeRecord &i, const ChangeRecord &j,
                        double ri, double rj)
{
  const Float8 change = change_of_contact(i, j);
  s.velocity_change = {change[0], change[1], change[2]};
  s.rotation_change = {change[4], change[5], change[6]};
  const auto omega_change = [](const ChangeRecord &of, double radius) {
    return Vector3<double>{of.c[4] / radius, of.c[5] / radius, of.c[6] / radius};
  };
  s.omega_change = omega_change(i, ri) - omega_change(j, rj);
}

}    // namespace Talus

#endif
