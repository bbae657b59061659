// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The words of fix large/body, see doc/fix_large_body.md. Errors end in Words::fail() or an error of LAMMPS, on all ranks.

#ifndef TALUS_FIX_BODY_LARGE_BODY_WORDS_H
#define TALUS_FIX_BODY_LARGE_BODY_WORDS_H

#include "base/words.h"
#include "system/bodies/large_body_spec.h"

#include "pointers.h"

#include <vector>

namespace Talus {

class LargeBodyWords : protected LAMMPS_NS::Pointers {
 public:
  LargeBodyWords(LAMMPS_NS::LAMMPS *lmp, Words &words) : Pointers(lmp), words(words) {}

  /// All of them, behind ID, group and style. Collective.
  LargeBodySpec parse();

 private:
  bool find_two_sided() const;
  void parse_contact();
  void parse_type();
  bool parse_surface();
  void parse_picture();
  void need_mesh() const;
  [[noreturn]] void refuse_two_laws(int back) const;
  void need_all_laws() const;
  void check_heat();

  Words &words;
  LargeBodySpec spec;
  std::vector<bool> has_law;    // by type
};

}    // namespace Talus

#endif
