// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A large body as its command defines it: what the words of fix large/body say. Made by the reader of the words
// (fix/body/large_body_words.h), taken by LargeBodies::add().

#ifndef TALUS_SYSTEM_BODIES_LARGE_BODY_SPEC_H
#define TALUS_SYSTEM_BODIES_LARGE_BODY_SPEC_H

#include "body/shape/large_body_shape.h"
#include "material/contact_spec.h"
#include "system/bodies/body_motion_spec.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Talus {

/// What is told of the surface: loads of the triangles of a mesh, and pictures for ParaView.
struct BodySurfaceSpec {
  bool with_loads = false;
  bool with_heat = false;    ///< the body has a temperature
  bool averages = false;     ///< loads are means over the steps since the last picture
  double wear = 0.0;         ///< depth over shear work by area (1/pressure)
  int interval = 0;          ///< of pictures, in steps; 0: none
  std::string file;          ///< with a * for the step
};

struct LargeBodySpec {
  std::unique_ptr<LargeBodyShape> shape;
  BodyMotionSpec motion;
  BodySurfaceSpec surface;
  /// By type of particles, from 1. Or the laws of pairs with this type, as they are when a run begins; 0: `laws`.
  std::vector<ContactSpec> laws;
  int type_of_laws = 0;
  std::optional<NumberOrVariable> temperature;    ///< of all of it; none: no heat is conducted
};

}    // namespace Talus

#endif
