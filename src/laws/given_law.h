// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Input for one pair of materials: a law for each stage, and parameters by name. The names
// are those of the documentation (kn, gn, E, nu, mu, ...); restart files hold the same.

#ifndef TALUS_LAWS_GIVEN_LAW_H
#define TALUS_LAWS_GIVEN_LAW_H

#include "base/words.h"
#include "laws/contact_law.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace Talus {

/// Numbers by name, in units of the kernels.
class GivenNumbers {
 public:
  double &operator[](const std::string &name) { return numbers[name]; }
  void erase(const std::string &name) { numbers.erase(name); }
  bool has(const std::string &name) const { return numbers.count(name) > 0; }
  /// 0, or what is given here, if the number was not given.
  double value(const std::string &name, double otherwise = 0.0) const
  {
    const auto found = numbers.find(name);
    return found == numbers.end() ? otherwise : found->second;
  }
  const std::map<std::string, double> &all() const { return numbers; }

 private:
  std::map<std::string, double> numbers;
};

struct ContactSpec {
  ContactLaw law;
  GivenNumbers given;

  /// Stiffnesses follow from Young's modulus and Poisson's ratio.
  bool is_material() const { return given.has("E"); }
};

/// Rule by which the coefficients of friction and of resistance of unlike materials are found.
enum class FrictionMix : int { MINIMUM, ARITHMETIC, GEOMETRIC };

/// Two materials with the same law, which may be one and the same, for laws that mix their numbers.
struct Mixing {
  const ContactSpec &a, &b;
  FrictionMix rule;

  double mean(const std::string &name) const;
  double geometric(const std::string &name) const;
  double smallest(const std::string &name) const;
  /// `otherwise` stands for a number that was not given.
  double largest(const std::string &name, double otherwise = 0.0) const;
  /// By the rule.
  double friction(const std::string &name) const;
  bool both_have(const std::string &name) const { return a.given.has(name) && b.given.has(name); }
  /// Either asks for it.
  bool limits_damping() const;
};

/// For laws that read their words: the words, and what has been read so far. Keywords come in any
/// order: what depends on two of them is looked at when all have been read.
struct LawReader {
  Words &words;
  ContactSpec &spec;
  double pressure_unit;    ///< the caller's unit of pressure in terms of force and length

  /// Index of the word of the normal law that is the coefficient of whatever damping there will be,
  /// -1: the normal law has a damping of its own, and has read it.
  int damping_at = -1;

  void set_not_negative(const char *name) { spec.given[name] = words.not_negative(name); }

  /// What is wrong with the whole law at the word of this index, "" if nothing is.
  using Check = std::function<std::string(const ContactLaw &)>;
  void check_later(int index, Check check) { checks.push_back({index, std::move(check)}); }

  /// Once, after the last keyword: reads the damping coefficient, and makes the checks.
  void finish();

  struct LateCheck {
    int index;
    Check check;
  };
  std::vector<LateCheck> checks = {};
};

}    // namespace Talus

#endif
