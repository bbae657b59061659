// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Forces of LAMMPS between particles that a list names. The styles `zero`, which scripts give where an atom style has a
// topology that they do not use, have none.

#ifndef TALUS_SYSTEM_HOST_BONDED_STYLES_H
#define TALUS_SYSTEM_HOST_BONDED_STYLES_H

#include "system/host/system_style.h"

#include "force.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace Talus {

/// Talus computes the forces of bonds; after init_style().
inline bool computes_bonds(const LAMMPS_NS::Force &force)
{
  const SystemStyle *const bonds = SystemStyle::of(force.bond);
  return bonds && bonds->reason_for_stock().empty();
}

/// Of bonds that Talus does not compute, angles, dihedrals or impropers; the same.
inline bool has_bonded_forces(const LAMMPS_NS::Force &force)
{
  const char *const styles[] = {force.bond && !computes_bonds(force) ? force.bond_style : nullptr,
                                force.angle ? force.angle_style : nullptr,
                                force.dihedral ? force.dihedral_style : nullptr,
                                force.improper ? force.improper_style : nullptr};
  return std::any_of(std::begin(styles), std::end(styles),
                     [](const char *style) { return style && std::strcmp(style, "zero") != 0; });
}

}    // namespace Talus

#endif
