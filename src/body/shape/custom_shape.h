// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What a shared library with a shape of a user's own must have, for `fix large/body custom`:
//
//   extern "C" Talus::LargeBodyShape *talus_make_shape(int narg, const char *const *arg,
//                                                      char *problem, int size)
//
// makes a shape from the words of the command. If they are wrong it returns nullptr and writes the
// reason into `problem`, at most `size` characters with the final zero. Called once on every rank;
// Talus deletes the shape. See examples/custom_shape.

#ifndef TALUS_BODY_SHAPE_CUSTOM_SHAPE_H
#define TALUS_BODY_SHAPE_CUSTOM_SHAPE_H

#include "body/shape/large_body_shape.h"

namespace Talus {

using MakeShapeFunction = LargeBodyShape *(*) (int narg, const char *const *arg, char *problem,
                                               int size);

#define TALUS_MAKE_SHAPE_NAME "talus_make_shape"

}    // namespace Talus

#endif
