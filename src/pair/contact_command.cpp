// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "pair/contact_command.h"

#include "error.h"
#include "lammps.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

[[noreturn]] void complain(const CommandWords &w, int iarg, const std::string &text)
{
  const int at = std::min(iarg, w.narg - 1) + w.shift;
  w.lmp->error->all(FLERR, at, "{}: {}", w.command, text);
}

const char *next_word(const CommandWords &w, int &iarg, const std::string &expected)
{
  if (iarg >= w.narg) complain(w, iarg, "missing " + expected);
  return w.arg[iarg++];
}

/// A keyword that may be given once.
void once(const CommandWords &w, int iarg, bool &given)
{
  if (given) complain(w, iarg, fmt::format("keyword '{}' given twice", w.arg[iarg]));
  given = true;
}

/// A number that is not negative.
double number(const CommandWords &w, int &iarg, const char *name)
{
  const std::string expected = std::string(name) + " (a number >= 0)";
  const char *word = next_word(w, iarg, expected);
  const double value = utils::is_double(word) ? std::strtod(word, nullptr) : -1.0;
  if (!(value >= 0.0) || std::isinf(value))
    complain(w, iarg - 1, fmt::format("expected {} instead of '{}'", expected, word));
  return value;
}

/// As number(), or the word NULL for the default.
double number_or_null(const CommandWords &w, int &iarg, const char *name, double default_value)
{
  if (iarg < w.narg && strcmp(w.arg[iarg], "NULL") == 0) {
    iarg++;
    return default_value;
  }
  return number(w, iarg, name);
}

void parse_normal(const CommandWords &w, int &iarg, ContactSpec &spec)
{
  const char *word = next_word(w, iarg, "normal law: hooke or hertz");
  if (strcmp(word, "hooke") == 0)
    spec.law.normal = NormalLaw::HOOKE;
  else if (strcmp(word, "hertz") == 0)
    spec.law.normal = NormalLaw::HERTZ;
  else
    complain(w, iarg - 1, fmt::format("unknown normal law '{}', expected hooke or hertz", word));
  spec.coefficients.kn = number(w, iarg, "kn");
  spec.coefficients.gn = number(w, iarg, "gn");
}

void parse_tangential(const CommandWords &w, int &iarg, ContactSpec &spec)
{
  const std::string modes = "none, dashpot, onestep or multistep";
  const char *word = next_word(w, iarg, "tangential law: " + modes);
  ContactCoefficients &c = spec.coefficients;
  c.kt = c.gt = c.mu = 0.0;

  if (strcmp(word, "none") == 0) {
    spec.law.tangential = TangentialLaw::NONE;
    return;
  }
  if (strcmp(word, "dashpot") == 0)
    spec.law.tangential = TangentialLaw::DASHPOT;
  else if (strcmp(word, "onestep") == 0)
    spec.law.tangential = TangentialLaw::ONESTEP;
  else if (strcmp(word, "multistep") == 0)
    spec.law.tangential = TangentialLaw::MULTISTEP;
  else
    complain(w, iarg - 1, fmt::format("unknown tangential law '{}', expected {}", word, modes));

  // defaults of the stock gran/* styles
  const int iarg_kt = iarg;
  if (spec.law.tangential != TangentialLaw::DASHPOT)
    c.kt = number_or_null(w, iarg, "kt", 2.0 / 7.0 * c.kn);
  c.gt = number_or_null(w, iarg, "gt", 0.5 * c.gn);
  c.mu = number(w, iarg, "mu");
  if (spec.law.has_history() && c.kt == 0.0)
    complain(w, iarg_kt, "tangential multistep needs kt > 0; without a tangential spring use "
             "'tangential dashpot'");
}

double mean(double a, double b)
{
  return 0.5 * (a + b);
}

double mix_friction(double a, double b, FrictionMix rule)
{
  if (rule == FrictionMix::ARITHMETIC) return mean(a, b);
  if (rule == FrictionMix::GEOMETRIC) return std::sqrt(a * b);
  return std::min(a, b);
}

}    // namespace

ContactSpec LAMMPS_NS::parse_contact(const CommandWords &words, int &iarg)
{
  ContactSpec spec;
  parse_normal(words, iarg, spec);
  spec.coefficients.force_floor = -std::numeric_limits<double>::infinity();
  bool with_tangential = false, with_limit = false;
  while (iarg < words.narg) {
    if (strcmp(words.arg[iarg], "tangential") == 0) {
      once(words, iarg, with_tangential);
      parse_tangential(words, ++iarg, spec);
    } else if (strcmp(words.arg[iarg], "limit_damping") == 0) {
      once(words, iarg++, with_limit);
      spec.coefficients.force_floor = 0.0;
    } else
      break;
  }
  return spec;
}

ContactSpec LAMMPS_NS::mix_contacts(const ContactSpec &a, const ContactSpec &b, FrictionMix rule)
{
  const ContactCoefficients &p = a.coefficients, &q = b.coefficients;
  ContactSpec mixed = a;
  mixed.coefficients = {mean(p.kn, q.kn), mean(p.gn, q.gn),
                        mean(p.kt, q.kt), mean(p.gt, q.gt),
                        mix_friction(p.mu, q.mu, rule), std::max(p.force_floor, q.force_floor)};
  return mixed;
}
