// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Two warnings about a large body, once per run each, as for pairs of particles:
//
//   overlap   a particle overlaps the body by more than a tenth of its radius: the laws are those
//             of small overlaps
//   move      a particle near a body that moves goes by more than a tenth of its radius past it in
//             a time step: it may be deep in the body, or through it, before it feels a force
//
// Looked for when the neighbor lists have been rebuilt and at the end of a run, not in every step:
// each rank takes look(), the largest values of all ranks and their particles are found, and
// whoever finds exceeded() prints text().

#ifndef TALUS_BODY_CONTACT_BODY_WARNINGS_H
#define TALUS_BODY_CONTACT_BODY_WARNINGS_H

#include "body/contact/body_contacts.h"

#include <string>

namespace Talus {

class BodyWarnings {
 public:
  enum Kind { OVERLAP, MOVE };
  static constexpr int num_kinds = 2;
  static constexpr double limit[num_kinds] = {0.1, 0.1};    ///< over the radius

  /// What one rank has found: the largest value over the radius of its particle, and that (host's
  /// index). A value that is not a number counts as zero: it is another trouble.
  struct Finding {
    double value = 0.0;
    int atom = 0;
  };

  /// A run begins: both may be said again.
  void start() { said[OVERLAP] = said[MOVE] = false; }

  /// Whether to look for it still; the same on all ranks. `moves`: the body does.
  bool wants(Kind kind, bool moves) const { return !said[kind] && (kind == OVERLAP || moves); }

  static Finding look(Kind kind, const BodyFindings &found, double dt);

  /// Of the largest value of all ranks: whether it is to be said, this once.
  bool exceeded(Kind kind, double value)
  {
    return !said[kind] && (said[kind] = value > limit[kind]);
  }

  static std::string text(Kind kind, const std::string &id, double value, long long tag,
                          long long step);

 private:
  bool said[num_kinds] = {false, false};
};

}    // namespace Talus

#endif
