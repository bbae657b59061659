// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/time_variables.h"

#include "system/private_member.h"

#include "input.h"
#include "lammps.h"
#include "variable.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <iterator>

using namespace LAMMPS_NS;

namespace Talus {

struct VariableFormula {
  using Type = char ***Variable::*;
  friend Type pointer_to(VariableFormula);
};
struct VariableStyle {
  using Type = int *Variable::*;
  friend Type pointer_to(VariableStyle);
};
template struct PrivateMember<VariableFormula, &Variable::data>;
template struct PrivateMember<VariableStyle, &Variable::style>;

namespace {

// what a formula may name, see the variable command of LAMMPS: thermo keywords that count steps,
// constants, and functions of their arguments and the time
const char *const allowed_names[] = {
    "step",     "time",     "dt",     "elapsed", "elaplong",  "PI",      "version", "yes",
    "no",       "on",       "off",    "true",    "false",     "sqrt",    "exp",     "ln",
    "log",      "abs",      "sin",    "cos",     "tan",       "asin",    "acos",    "atan",
    "atan2",    "ceil",     "floor",  "round",   "ternary",   "ramp",    "stagger", "logfreq",
    "logfreq2", "logfreq3", "stride", "stride2", "vdisplace", "swiggle", "cwiggle", "sign"};

bool starts_name(char c)
{
  return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
}
bool continues_name(char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

class Reader {
 public:
  explicit Reader(LAMMPS *lmp) : variables(*lmp->input->variable) {}

  std::string variable(const std::string &name, int depth = 0)
  {
    const int v = variables.find(name.c_str());
    if (v < 0 || depth > 100) return "v_" + name;
    switch ((variables.*pointer_to(VariableStyle{}))[v]) {
    case Variable::INDEX:
    case Variable::LOOP:
    case Variable::STRING:
    case Variable::GETENV:
    case Variable::INTERNAL:
      return "";
    case Variable::EQUAL:
      return formula((variables.*pointer_to(VariableFormula{}))[v][0], depth);
    default:
      return "v_" + name;
    }
  }

  std::string all()
  {
    for (int v = 0; v < variables.nvar; v++) {
      if (!variables.equalstyle(v)) continue;
      const std::string its = variable(variables.names[v]);
      if (!its.empty()) return "v_" + std::string(variables.names[v]) + " reads " + its;
    }
    return "";
  }

 private:
  Variable &variables;

  std::string formula(const char *text, int depth)
  {
    const char *const end = text + std::strlen(text);
    for (const char *c = text; c != end;) {
      if (std::isdigit(static_cast<unsigned char>(*c)) || *c == '.') {
        c = after_number(c, end);
      } else if (starts_name(*c)) {
        const char *const last = std::find_if_not(c, end, continues_name);
        const std::string its = named(std::string(c, last), depth);
        if (!its.empty()) return its;
        c = last;
      } else if (std::strchr(" \t\r\n+-*/^%(),=!<>&|", *c)) {
        c++;
      } else {
        return std::string("'") + *c + "'";    // an index, or something unknown
      }
    }
    return "";
  }

  static const char *after_number(const char *c, const char *end)
  {
    while (c != end && (std::isdigit(static_cast<unsigned char>(*c)) || *c == '.')) c++;
    if (c == end || (*c != 'e' && *c != 'E')) return c;
    c++;
    return c != end && (*c == '+' || *c == '-') ? c + 1 : c;
  }

  std::string named(const std::string &name, int depth)
  {
    if (name.compare(0, 2, "v_") == 0) return variable(name.substr(2), depth + 1);
    const bool known = std::find(std::begin(allowed_names), std::end(allowed_names), name) !=
                       std::end(allowed_names);
    return known ? "" : name;
  }
};

}    // namespace

std::string what_else_variable_reads(LAMMPS *lmp, const std::string &name)
{
  return Reader(lmp).variable(name);
}

std::string what_else_variables_read(LAMMPS *lmp)
{
  return Reader(lmp).all();
}

}    // namespace Talus
