// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A large body as programs see it that steer it from outside (coupling/, fix_modify state): what the command that defines
// it offers. Its load is that of LargeBody.

#ifndef TALUS_SYSTEM_STEERED_BODY_H
#define TALUS_SYSTEM_STEERED_BODY_H

#include "body/motion/body_state.h"

#include <string>

namespace Talus {

class SteeredBody {
 public:
  /// As it is in this step.
  virtual const BodyState &present_state() const = 0;
  /// Between two steps, collective, the same on all ranks: the body is to have this state in so many
  /// steps, 0: at once. Returns "", or why not.
  virtual std::string guide(const BodyState &state, int steps) = 0;

 protected:
  ~SteeredBody() = default;    // never deleted through this interface
};

}    // namespace Talus

#endif
