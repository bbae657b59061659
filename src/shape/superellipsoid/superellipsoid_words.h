// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How scripts describe them, and what they touch: for shape/contact/shape_list.h.
//
//   ellipsoid a b c                    half axes
//   superellipsoid a b c n1 n2         with the exponents of superellipsoid.h
//   curvature mean|gaussian|volume     keyword of both, see SurfaceRadius

#ifndef TALUS_SHAPE_SUPERELLIPSOID_SUPERELLIPSOID_WORDS_H
#define TALUS_SHAPE_SUPERELLIPSOID_SUPERELLIPSOID_WORDS_H

#include "shape/collisions.h"
#include "shape/shape_description.h"

#include <vector>

namespace Talus {

std::vector<ShapeWord> superellipsoid_words();

/// With each other, spheres, convex particles, and surfaces of large bodies.
void add_superellipsoid_collisions(Collisions &table);

}    // namespace Talus

#endif
