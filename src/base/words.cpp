// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "base/words.h"

#include "base/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale.h>
#include <stdexcept>
#include <stdlib.h>
#include <utility>

namespace Talus {
namespace {

/* "a, b or c" */

std::string list_of(const std::vector<std::string> &words)
{
  std::string text;
  for (std::size_t n = 0; n < words.size(); n++)
    text += (n == 0 ? "" : n + 1 < words.size() ? ", " : " or ") + words[n];
  return text;
}

}    // namespace

/* std::from_chars would do, but libraries older than that of GCC 11 have it for integers only. */

double parse_number(const std::string &word)
{
  static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
  const bool decimal = word.find_first_not_of("0123456789.eE+-") == std::string::npos;
  if (word.empty() || !decimal) return NAN;
  char *stop = nullptr;
  const double value = strtod_l(word.c_str(), &stop, c_locale);
  return stop == word.c_str() + word.size() ? value : NAN;
}

Words::Words(std::string command_name, int n, const char *const *words, int first, Fail fail_with) :
    command(std::move(command_name)), narg(n), arg(words), next(first),
    complain(std::move(fail_with))
{
}

void Words::fail(int back, const std::string &what) const
{
  const std::string subject = context.empty() ? command : command + " " + context;
  complain(std::min(next - back, narg - 1), subject + ": " + what);
  throw std::logic_error("the handler of an error has returned: " + what);
}

bool Words::is_next(const std::string &word) const
{
  return !at_end() && word == arg[next];
}

bool Words::take(const std::string &word)
{
  if (!is_next(word)) return false;
  next++;
  return true;
}

void Words::end() const
{
  if (!at_end()) fail(0, "surplus word '" + peek() + "'");
}

std::string Words::text(const std::string &expected)
{
  if (at_end()) fail(0, "missing " + expected);
  return arg[next++];
}

int Words::choice(const std::string &subject, const std::vector<std::string> &known)
{
  const std::string word = text(subject + ": " + list_of(known));
  const auto found = std::find(known.begin(), known.end(), word);
  if (found == known.end())
    fail(1, "unknown " + subject + " '" + word + "', expected " + list_of(known));
  return static_cast<int>(found - known.begin());
}

double Words::number_in(const std::string &expected, const std::function<bool(double)> &allowed)
{
  const std::string word = text(expected);
  const double value = parse_number(word);
  if (!std::isfinite(value) || !allowed(value))
    fail(1, "expected " + expected + " instead of '" + word + "'");
  return value;
}

double Words::number(const std::string &name)
{
  return number_in(name + " (a number)", [](double) { return true; });
}

double Words::not_negative(const std::string &name)
{
  return number_in(name + " (a number >= 0)", [](double value) { return value >= 0.0; });
}

double Words::positive(const std::string &name)
{
  return number_in(name + " (a number > 0)", [](double value) { return value > 0.0; });
}

double Words::between(const std::string &name, double lo, double hi, bool open)
{
  const std::string range = "a number " + std::string(open ? "above " : "from ") + number_text(lo) +
                            (open ? ", up to " : " to ") + number_text(hi);
  return number_in(name + " (" + range + ")",
                   [=](double value) { return (open ? value > lo : value >= lo) && value <= hi; });
}

bool Words::not_negative_or_null(const std::string &name, double &value)
{
  if (take("NULL")) return false;
  value = not_negative(name);
  return true;
}

double Words::number_or_null(const std::string &name)
{
  return take("NULL") ? 0.0 : number(name);
}

int Words::integer(const std::string &name, int least)
{
  const std::string expected = name + " (a whole number >= " + std::to_string(least) + ")";
  const double largest = std::numeric_limits<int>::max();
  return static_cast<int>(number_in(expected, [=](double value) {
    return value == std::floor(value) && value >= least && value <= largest;
  }));
}

Vector3<double> Words::vector(const std::string &name)
{
  const double x = number(name), y = number(name);
  return {x, y, number(name)};
}

/* Scaled first: squares of very large or very small numbers are not numbers any more. */

Vector3<double> Words::direction(const std::string &name)
{
  const Vector3<double> v = vector(name);
  const double largest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  if (!(largest > 0.0)) fail(3, name + " must not be zero");
  const Vector3<double> scaled{v.x / largest, v.y / largest, v.z / largest};
  const bool plain = largest < 1e150 && largest > 1e-150;    // the usual case keeps its bits
  const Vector3<double> &w = plain ? v : scaled;
  return 1.0 / std::sqrt(dot(w, w)) * w;
}

}    // namespace Talus
