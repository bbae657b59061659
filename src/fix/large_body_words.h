// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The words of a fix large/body command, read one after another. Bad and missing ones end in
// error->all() naming the command, the word and what was expected.

#ifndef TALUS_FIX_LARGE_BODY_WORDS_H
#define TALUS_FIX_LARGE_BODY_WORDS_H

#include "base/vector3.h"
#include "pointers.h"

#include <string>

namespace LAMMPS_NS {

class LargeBodyWords : protected Pointers {
 public:
  /// `arg` as in the constructor of a fix; reading begins at `first`.
  LargeBodyWords(LAMMPS *lmp, int narg, char **arg, int first);

  int narg;
  char **arg;
  int next;    ///< index of the next word

  /// What is being read, for messages: a shape or keyword. fix large/body `about`: ...
  void about(const std::string &subject) { context = subject; }

  bool at_end() const { return next >= narg; }
  bool is_next(const char *word) const;
  /// Steps over a word if it is the next one.
  bool take(const char *word);
  std::string text(const char *name);
  double number(const char *name);
  double positive(const char *name);
  /// A number, NULL counts as 0.
  double number_or_null(const char *name);
  Talus::Vector3<double> vector(const char *name);
  /// A unit vector.
  Talus::Vector3<double> direction(const char *name);
  int integer(const char *name, int least);

  /// Error at the word that is `back` words behind the next one.
  [[noreturn]] void fail(int back, const std::string &what);

 private:
  std::string context;
};

}    // namespace LAMMPS_NS

#endif
