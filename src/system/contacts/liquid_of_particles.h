// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The liquid of particles, from which bridges have theirs: a property that LAMMPS moves, writes and shows, made by
// `fix property/atom d_liquid ghost yes`. It is in the array of LAMMPS in every step, of owned particles; ghosts have what
// the pair style has sent for the last computation of forces.

#ifndef TALUS_SYSTEM_CONTACTS_LIQUID_OF_PARTICLES_H
#define TALUS_SYSTEM_CONTACTS_LIQUID_OF_PARTICLES_H

namespace LAMMPS_NS {
class Atom;
}    // namespace LAMMPS_NS

namespace Talus {

/// Ghosts have it as well.
bool particles_have_liquid(LAMMPS_NS::Atom &atom);

/// By local index (distance^3), if they have it; nullptr where there are no particles.
double *liquid_of_particles(LAMMPS_NS::Atom &atom);

}    // namespace Talus

#endif
