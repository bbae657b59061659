// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The words `move`, `servo`, `gravity`, `load` and `surface_velocity` of fix large/body, see
// doc/large_bodies.md.

#ifndef TALUS_FIX_BODY_BODY_MOTION_WORDS_H
#define TALUS_FIX_BODY_BODY_MOTION_WORDS_H

#include "base/words.h"
#include "body/shape/large_body_shape.h"
#include "system/bodies/body_motion_spec.h"

#include "pointers.h"

namespace Talus {

class BodyMotionWords : protected LAMMPS_NS::Pointers {
 public:
  BodyMotionWords(LAMMPS_NS::LAMMPS *lmp, Words &words) : Pointers(lmp), words(words) {}

  /// One of them with its arguments, if that is the next word. Errors end in Words::fail().
  bool parse(BodyMotionSpec &spec);
  /// After all words: whether they go together, and with the shape; an error of LAMMPS if not.
  void check(const BodyMotionSpec &spec, LargeBodyShape &shape) const;

 private:
  void parse_move(BodyMotionSpec &spec);
  void parse_variable(BodyMotionSpec &spec);
  void parse_free(BodyMotionSpec &spec);
  void parse_servo(BodyMotionSpec &spec);
  NumberOrVariable quantity(const char *name);
  Vector3<double> vector_or_null(const char *name);

  Words &words;
};

}    // namespace Talus

#endif
