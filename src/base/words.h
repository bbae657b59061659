// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The words of a command, read one after another; the only reader of words that Talus has. Whatever
// is wrong ends in one call of `fail` with the index of the word and a text that names the command,
// the word and what was expected. No LAMMPS: see system/host/command_words.h for the one that calls
// error->all().

#ifndef TALUS_BASE_WORDS_H
#define TALUS_BASE_WORDS_H

#include "base/vector3.h"

#include <functional>
#include <string>
#include <vector>

namespace Talus {

/// A decimal number, in any locale; not-a-number for everything else. Too small for a double counts
/// as 0, too large is infinite.
double parse_number(const std::string &word);

class Words {
 public:
  /// Index of the word at fault (of the last word if there is none), and the text. Must not return.
  using Fail = std::function<void(int index, const std::string &text)>;

  /// Reads arg[first ... narg-1], which must live as long as this. `command`: as the user knows it,
  /// e.g. "pair_coeff gran/penalty"; messages begin with it.
  Words(std::string command, int narg, const char *const *arg, int first, Fail fail);

  /// What is being read, for messages: "command subject: ...". "" for none.
  void about(const std::string &subject) { context = subject; }

  int index() const { return next; }    ///< of the next word
  bool at_end() const { return next >= narg; }
  /// The next word is this one.
  bool is_next(const std::string &word) const;
  /// Steps over a word if it is the next one.
  bool take(const std::string &word);
  /// The next word without stepping over it, "" at the end.
  std::string peek() const { return at_end() ? "" : arg[next]; }
  void skip(int words) { next += words; }

  /// An error if a word is left.
  void end() const;

  /// The next word, whatever it is; `expected` is named if there is none.
  std::string text(const std::string &expected);
  /// One of some words. `subject`: what they are, e.g. "normal law". Returns which one.
  int choice(const std::string &subject, const std::vector<std::string> &known);

  /// A finite number: any, >= 0, > 0, or lo <= number <= hi (lo < number if `open`).
  double number(const std::string &name);
  double not_negative(const std::string &name);
  double positive(const std::string &name);
  double between(const std::string &name, double lo, double hi, bool open = false);
  /// A number >= 0 to `value`, or the word NULL, which leaves it; returns whether it was a number.
  bool not_negative_or_null(const std::string &name, double &value);
  /// A number; NULL counts as 0.
  double number_or_null(const std::string &name);
  int integer(const std::string &name, int least);
  Vector3<double> vector(const std::string &name);
  /// A unit vector in the direction of three numbers that are not all zero.
  Vector3<double> direction(const std::string &name);

  /// Error at the word that is `back` words before the next one.
  [[noreturn]] void fail(int back, const std::string &what) const;

 private:
  double number_in(const std::string &expected, const std::function<bool(double)> &allowed);

  std::string command, context;
  int narg;
  const char *const *arg;
  int next;
  Fail complain;
};

}    // namespace Talus

#endif
