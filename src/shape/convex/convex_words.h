// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Convex particles in scripts, and what they touch. See doc/fix_shape_gran.md.

#ifndef TALUS_SHAPE_CONVEX_CONVEX_WORDS_H
#define TALUS_SHAPE_CONVEX_CONVEX_WORDS_H

#include "shape/collisions.h"
#include "shape/shape_description.h"

#include <vector>

namespace Talus {

/// box a b c, polyhedron FILE, vertices N x y z ...; with the keywords rounded and scale.
std::vector<ShapeWord> convex_words();

/// With each other, spheres, and all surfaces of large bodies.
void add_convex_collisions(Collisions &table);

}    // namespace Talus

#endif
