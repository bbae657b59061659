// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "pair/contact_command.h"

#include "error.h"
#include "force.h"
#include "lammps.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

constexpr double default_threshold =
    1.0e-4;    // Chrono's, for speeds of slip, delayed roll and spin

class Parser {
 public:
  Parser(const CommandWords &words, int &iarg) : w(words), i(iarg) {}

  ContactSpec parse()
  {
    ContactCoefficients &c = spec.given;
    c.slip_min = default_threshold;
    normal();
    while (i < w.narg && keyword(w.arg[i])) {
    }
    // resistance that holds a body needs no threshold
    const bool given = std::find(seen.begin(), seen.end(), "vmin") != seen.end();
    if (spec.law.delayed && !given) c.roll_min = c.twist_min = default_threshold;
    return spec;
  }

 private:
  [[noreturn]] void complain(int at, const std::string &text)
  {
    w.lmp->error->all(FLERR, std::min(at, w.narg - 1) + w.shift, "{}: {}", w.command, text);
  }

  const char *next(const std::string &expected)
  {
    if (i >= w.narg) complain(i, "missing " + expected);
    return w.arg[i++];
  }

  bool at(const char *word) const { return i < w.narg && strcmp(w.arg[i], word) == 0; }

  /// A number with lo <= number <= hi, or lo < number if `open`.
  double number(const char *name, const char *range, double lo, double hi, bool open = false)
  {
    const std::string expected = std::string(name) + " (" + range + ")";
    const char *word = next(expected);
    const bool is_number = utils::is_double(word);
    const double value = is_number ? std::strtod(word, nullptr) : 0.0;
    const bool inside = (open ? value > lo : value >= lo) && value <= hi && !std::isinf(value);
    if (!is_number || !inside)
      complain(i - 1, fmt::format("expected {} instead of '{}'", expected, word));
    return value;
  }
  double not_negative(const char *name) { return number(name, "a number >= 0", 0.0, INFINITY); }
  double positive(const char *name) { return number(name, "a number > 0", 0.0, INFINITY, true); }

  /// A number, or the word NULL for the default; returns whether it was a number.
  bool number_or_null(const char *name, double &value)
  {
    if (at("NULL")) {
      i++;
      return false;
    }
    value = not_negative(name);
    return true;
  }

  void normal()
  {
    std::string known;
    for (int n = 0; n < num_normal_laws; n++)
      known += std::string(n ? ", " : "") + name_of(static_cast<NormalLaw>(n));
    const char *word = next("normal law: " + known);
    int n = 0;
    while (n < num_normal_laws && strcmp(word, name_of(static_cast<NormalLaw>(n))) != 0) n++;
    if (n == num_normal_laws)
      complain(i - 1, fmt::format("unknown normal law '{}', expected {}", word, known));
    spec.law.normal = static_cast<NormalLaw>(n);
    if (spec.is_material())
      material();
    else
      coefficients();
    if (is_plaincoulomb()) {
      spec.given.mu = not_negative("mu");
      spec.law.tangential = TangentialLaw::TANH;
    }
  }

  bool is_plaincoulomb() const
  {
    return spec.law.normal == NormalLaw::PLAINCOULOMB ||
           spec.law.normal == NormalLaw::PLAINCOULOMB_MATERIAL;
  }

  /// LAMMPS' unit of pressure in terms of force and distance.
  double pressure_unit() const { return 1.0 / w.lmp->force->nktv2p; }

  void coefficients()
  {
    spec.given.kn = not_negative("kn");
    spec.given.gn = not_negative("gn");
    if (spec.law.normal != NormalLaw::HOOKE) spec.given.kn *= pressure_unit();
  }

  void material()
  {
    spec.young = positive("Young's modulus E") * pressure_unit();
    spec.restitution = number("restitution e", "a number from 0 to 1", 0.0, 1.0);
    spec.poisson = number("Poisson's ratio nu", "a number from -1 to .5", -1.0, 0.5, true);
    const bool with_speed = spec.law.normal == NormalLaw::HOOKE_MATERIAL ||
                            spec.law.normal == NormalLaw::FLORES_MATERIAL;
    if (with_speed) spec.given.speed = positive("characteristic speed vchar");
  }

  /// Parses one keyword with its arguments; false if the word is none.
  bool keyword(const std::string &word)
  {
    using Method = void (Parser::*)();
    static const std::vector<std::pair<std::string, Method>> known = {
        {"tangential", &Parser::tangential},
        {"rolling", &Parser::rolling},
        {"spinning", &Parser::spinning},
        {"adhesion", &Parser::adhesion},
        {"vmin", &Parser::vmin},
        {"limit_damping", &Parser::limit_damping}};
    for (const auto &entry : known) {
      if (entry.first != word) continue;
      if (std::find(seen.begin(), seen.end(), word) != seen.end())
        complain(i, fmt::format("keyword '{}' given twice", word));
      seen.push_back(word);
      i++;
      (this->*entry.second)();
      return true;
    }
    return false;
  }

  void tangential()
  {
    const std::vector<std::pair<std::string, TangentialLaw>> known = {
        {"none", TangentialLaw::NONE},
        {"dashpot", TangentialLaw::DASHPOT},
        {"onestep", TangentialLaw::ONESTEP},
        {"multistep", TangentialLaw::MULTISTEP}};
    const std::string modes = "none, dashpot, onestep or multistep";
    if (is_plaincoulomb())
      complain(i - 1, fmt::format("'{}' has a tangential force of its own: remove 'tangential'",
                                  name_of(spec.law.normal)));
    const std::string word = next("tangential law: " + modes);
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const auto &entry) { return entry.first == word; });
    if (found == known.end())
      complain(i - 1, fmt::format("unknown tangential law '{}', expected {}", word, modes));
    spec.law.tangential = found->second;
    if (spec.law.tangential != TangentialLaw::NONE) tangential_numbers();
    if (spec.law.tangential == TangentialLaw::MULTISTEP) multistep_words();
  }

  /// [midpoint] [stock | slider], in any order. hooke and hertz with numbers follow the stock
  /// styles gran/hooke/history and gran/hertz/history.
  void multistep_words()
  {
    bool midpoint = false;
    std::string rule;
    while (at("midpoint") || at("stock") || at("slider")) {
      const std::string word = w.arg[i];
      if (word == "midpoint" ? midpoint : !rule.empty())
        complain(i, fmt::format("surplus word '{}' after tangential multistep", word));
      if (word == "midpoint")
        midpoint = true;
      else
        rule = word;
      i++;
    }
    const bool like_stock =
        spec.law.normal == NormalLaw::HOOKE || spec.law.normal == NormalLaw::HERTZ;
    if (rule.empty() ? like_stock : rule == "stock")
      spec.law.tangential = midpoint ? TangentialLaw::MIDPOINT : TangentialLaw::MULTISTEP;
    else
      spec.law.tangential = midpoint ? TangentialLaw::SLIDER_MIDPOINT : TangentialLaw::SLIDER;
  }

  void tangential_numbers()
  {
    ContactCoefficients &c = spec.given;
    const int at_kt = i;
    if (spec.law.tangential != TangentialLaw::DASHPOT) spec.kt_given = number_or_null("kt", c.kt);
    const int at_gt = i;
    spec.gt_given = number_or_null("gt", c.gt);
    c.mu = not_negative("mu");
    if (!spec.gt_given && spec.law.normal == NormalLaw::FLORES)
      complain(at_gt, "expected a number for gt instead of NULL: gn of flores has another unit, "
                      "1/(time distance^2), than gt, 1/(time distance)");
    if (spec.kt_given && spec.law.normal == NormalLaw::HOOKE_MATERIAL)
      complain(at_kt, "expected NULL for kt: hooke/material takes kt = kn from the material");
    if (spec.law.normal != NormalLaw::HOOKE) c.kt *= pressure_unit();
    const bool no_spring = spec.kt_given ? c.kt == 0.0 : !spec.is_material() && c.kn == 0.0;
    if (spec.law.has_history() && no_spring)
      complain(at_kt, "tangential multistep needs kt > 0; without a tangential spring use "
                      "'tangential dashpot'");
  }

  void resistance(double &mu, const char *name)
  {
    mu = not_negative(name);
    const bool delayed = at("delayed");
    if (delayed) i++;
    if (spec.law.resists && delayed != spec.law.delayed)
      complain(i - 1, "rolling and spinning must both be delayed, or both not");
    spec.law.resists = true;
    spec.law.delayed = delayed;
  }
  void rolling() { resistance(spec.given.mu_roll, "mu_r"); }
  void spinning() { resistance(spec.given.mu_twist, "mu_s"); }

  void adhesion()
  {
    const char *word = next("adhesion: constant, dmt or perko");
    ContactCoefficients &c = spec.given;
    if (strcmp(word, "constant") == 0)
      c.adhesion = not_negative("adhesive force F");
    else if (strcmp(word, "dmt") == 0)
      c.adhesion_dmt = not_negative("adhesion W");
    else if (strcmp(word, "perko") == 0)
      c.adhesion_perko = not_negative("adhesion S");
    else
      complain(i - 1, fmt::format("unknown adhesion '{}', expected constant, dmt or perko", word));
    spec.law.adheres = true;
  }

  void vmin()
  {
    spec.given.slip_min = not_negative("slip speed");
    spec.given.roll_min = not_negative("roll speed");
    spec.given.twist_min = not_negative("spin speed");
  }

  void limit_damping() { spec.limit_damping = true; }

  const CommandWords &w;
  int &i;
  ContactSpec spec;
  std::vector<std::string> seen;
};

}    // namespace

ContactSpec LAMMPS_NS::parse_contact(const CommandWords &words, int &iarg)
{
  return Parser(words, iarg).parse();
}
