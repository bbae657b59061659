// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What a shared library with a shape of a user's own must have, for `fix large/body custom`:
//
//   TALUS_MAKE_SHAPE(int narg, const char *const *arg, char *problem, int size) { ... }
//
// The function makes a shape from the words of the command and returns a pointer to it. If the
// words are wrong it returns nullptr and writes the reason into `problem`, at most `size`
// characters with the final zero. Called once on every rank; Talus deletes the shape. See
// examples/custom_shape.
//
// The name of the function contains the version of large_body_shape.h, so that a library that was
// built with another one is refused instead of being called wrongly.

#ifndef TALUS_BODY_SHAPE_CUSTOM_SHAPE_H
#define TALUS_BODY_SHAPE_CUSTOM_SHAPE_H

#include "body/shape/large_body_shape.h"

#include <string>

/// Raise it with every change of large_body_shape.h that shapes must be compiled again for.
/// 1: talus_make_shape(), without a version in its name.
#define TALUS_SHAPE_VERSION 7

#define TALUS_JOIN_NAMES(a, b) a##b
#define TALUS_VERSIONED_NAME(name, version) TALUS_JOIN_NAMES(name, version)
#define TALUS_MAKE_SHAPE                                                                           \
  extern "C" __attribute__((visibility("default"))) Talus::LargeBodyShape *TALUS_VERSIONED_NAME(   \
      talus_make_shape_, TALUS_SHAPE_VERSION)

namespace Talus {

using MakeShapeFunction = LargeBodyShape *(*) (int narg, const char *const *arg, char *problem,
                                               int size);

constexpr int shape_version = TALUS_SHAPE_VERSION;

/// The function that a library of some version has.
inline std::string make_shape_name(int version)
{
  return version == 1 ? "talus_make_shape" : "talus_make_shape_" + std::to_string(version);
}

}    // namespace Talus

#endif
