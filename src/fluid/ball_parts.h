// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Volumes that planes along the axes cut out of a ball, in closed form: how a grain is divided among the cells of a
// grid (fluid/grid_cells.h).

#ifndef TALUS_FLUID_BALL_PARTS_H
#define TALUS_FLUID_BALL_PARTS_H

namespace Talus {

/// Of the ball of radius 1 around 0: volume where x <= a, y <= b and z <= c, to 1e-15 of the ball. Planes may be
/// outside of it.
double ball_below(double a, double b, double c);

}    // namespace Talus

#endif
