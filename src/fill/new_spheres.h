// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Spheres that are there and spheres that are made, as all ranks know them.

#ifndef TALUS_FILL_NEW_SPHERES_H
#define TALUS_FILL_NEW_SPHERES_H

#include "base/vector3.h"

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

struct KnownSphere {
  Talus::Vector3<double> x;
  double radius;
};

/// Those with a part in the box from lo to hi, nearest images included, in the order of their IDs,
/// on all ranks. Collective.
std::vector<KnownSphere> spheres_in_box(LAMMPS *lmp, const Talus::Vector3<double> &lo,
                                        const Talus::Vector3<double> &hi);

/// Makes particles: `spheres` is the same on all ranks. IDs follow the largest one, in this order. What is beyond a
/// shrink-wrapped face is of the rank there, until LAMMPS has made the box larger.
/// Returns the local index of the first. Collective; LAMMPS must then renew its ghosts.
int create_spheres(LAMMPS *lmp, const std::vector<KnownSphere> &spheres, int type, double density);
/// The box is about to be made larger, and a particle of any rank will be of one further away than those that LAMMPS
/// sends it to in a run. Collective.
bool box_grows_too_fast(LAMMPS *lmp);

}    // namespace LAMMPS_NS

#endif
