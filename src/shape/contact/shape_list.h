// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The list of all shapes.

#ifndef TALUS_SHAPE_CONTACT_SHAPE_LIST_H
#define TALUS_SHAPE_CONTACT_SHAPE_LIST_H

#include "shape/collisions.h"
#include "shape/shape_description.h"

#include <vector>

namespace Talus {

/// In the order in which messages name them.
const std::vector<ShapeWord> &shape_words();

const Collisions &collisions_of_shapes();

/// Adds a shape of another source file, as a static object of that file: see tests/added_shape.
struct AddedShape {
  AddedShape(const ShapeWord &word, void (*add_collisions)(Collisions &table));
};

}    // namespace Talus

#endif
