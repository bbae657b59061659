// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/liquid_of_particles.h"

#include "atom.h"

namespace Talus {

static constexpr const char *property = "liquid";

bool particles_have_liquid(LAMMPS_NS::Atom &atom)
{
  int is_double = 0, columns = 0, ghosts = 0;
  const int index = atom.find_custom_ghost(property, is_double, columns, ghosts);
  return index >= 0 && is_double && columns == 0 && ghosts;
}

double *liquid_of_particles(LAMMPS_NS::Atom &atom)
{
  int is_double = 0, columns = 0;
  return atom.dvector[atom.find_custom(property, is_double, columns)];
}

}    // namespace Talus
