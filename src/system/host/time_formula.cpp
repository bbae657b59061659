// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/host/time_formula.h"

#include "system/host/lammps_compat.h"
#include "system/host/private_members.h"

#include "input.h"
#include "lammps.h"
#include "region.h"
#include "variable.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <set>

using namespace LAMMPS_NS;

namespace Talus {
namespace {

bool holds(const std::vector<std::string> &words, const std::string &word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_known(const std::string &word)
{
  static const std::vector<std::string> known = {
      "step",    "time",     "dt",       "elapsed", "elaplong", "PI",        "version", "yes",
      "no",      "on",       "off",      "true",    "false",    "sqrt",      "exp",     "ln",
      "log",     "abs",      "sign",     "sin",     "cos",      "tan",       "asin",    "acos",
      "atan",    "atan2",    "ceil",     "floor",   "round",    "ternary",   "ramp",    "stagger",
      "logfreq", "logfreq2", "logfreq3", "stride",  "stride2",  "vdisplace", "swiggle", "cwiggle"};
  return holds(known, word);
}

bool is_digit(char c)
{
  return std::isdigit(static_cast<unsigned char>(c));
}

/// The end of a number that begins at `c`, its exponent included.
const char *end_of_number(const char *c)
{
  while (is_digit(*c) || *c == '.') c++;
  if (*c != 'e' && *c != 'E') return c;
  const char *exponent = c + 1;
  if (*exponent == '+' || *exponent == '-') exponent++;
  if (!is_digit(*exponent)) return c;
  while (is_digit(*exponent)) exponent++;
  return exponent;
}

bool is_in_word(char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

bool reads_only_time(Variable &all, const std::string &name, std::set<std::string> &met)
{
  if (!met.insert(name).second) return true;    // met before, or an error later
  const int n = all.find(name.c_str());
  if (n < 0) return false;
  // values that stay what they are during a run
  static const std::vector<std::string> fixed = {"index",  "loop",     "world", "string",
                                                 "getenv", "universe", "uloop"};
  const std::string style = style_of(all, n);
  if (holds(fixed, style)) return true;
  std::vector<std::string> inner;
  if (style != "equal" || !formula_reads_only_time(formula_of(all, n), inner)) return false;
  return std::all_of(inner.begin(), inner.end(), [&](const std::string &variable) {
    return reads_only_time(all, variable, met);
  });
}

}    // namespace

bool formula_reads_only_time(const std::string &formula, std::vector<std::string> &variables)
{
  const char *c = formula.c_str();
  while (*c) {
    if (is_digit(*c) || *c == '.') {
      c = end_of_number(c);
    } else if (is_in_word(*c)) {
      const char *begin = c;
      while (is_in_word(*c)) c++;
      const std::string word(begin, c);
      if (word.compare(0, 2, "v_") == 0)
        variables.push_back(word.substr(2));
      else if (!is_known(word))
        return false;
    } else if (std::string("[]{}\"'$?@").find(*c) != std::string::npos) {
      return false;
    } else {
      c++;
    }
  }
  return true;
}

bool reads_only_time(LAMMPS *lmp, const std::string &variable)
{
  std::set<std::string> met;
  return reads_only_time(*lmp->input->variable, variable, met);
}

bool is_composite(const Region &region)
{
  return std::strcmp(region.style, "union") == 0 || std::strcmp(region.style, "intersect") == 0;
}

std::map<std::string, int> equal_style_variables(LAMMPS *lmp)
{
  Variable &all = *lmp->input->variable;
#if TALUS_HOST_TELLS_FORMULAS
  const int count = all.get_nvar();
  const auto name = [&all](int n) { return all.get_name(n); };
#else
  const int count = all.nvar;
  const auto name = [&all](int n) { return all.names[n]; };
#endif
  std::map<std::string, int> found;
  for (int n = 0; n < count; n++)
    if (all.equalstyle(n)) found[name(n)] = n;
  return found;
}

static std::string variable_of_more_than_time(LAMMPS *lmp)
{
  for (const auto &[name, index] : equal_style_variables(lmp))
    if (!reads_only_time(lmp, name)) return name;
  return "";
}

/* The variables of a shape are known to each style alone: all must do. */

std::string variable_that_may_read_particles(LAMMPS *lmp, const Region &region)
{
  if (region.varshape) return variable_of_more_than_time(lmp);
  if (is_composite(region)) {
    for (int n = 0; n < region.nregion; n++) {
      const std::string variable = variable_that_may_read_particles(lmp, *region.reglist[n]);
      if (!variable.empty()) return variable;
    }
    return "";
  }
  if (!region.dynamic) return "";
  for (const char *name : variables_of(region))
    if (name && !reads_only_time(lmp, name)) return name;
  return "";
}

}    // namespace Talus
