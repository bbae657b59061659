// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/large_body_words.h"

#include "error.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

using namespace LAMMPS_NS;
using Talus::Vector3;

LargeBodyWords::LargeBodyWords(LAMMPS *lmp, int n, char **words, int first) :
    Pointers(lmp), narg(n), arg(words), next(first)
{
}

void LargeBodyWords::fail(int back, const std::string &what)
{
  error->all(FLERR, std::min(next - back, narg - 1), "fix large/body {}: {}", context, what);
}

bool LargeBodyWords::is_next(const char *word) const
{
  return next < narg && strcmp(arg[next], word) == 0;
}

bool LargeBodyWords::take(const char *word)
{
  if (!is_next(word)) return false;
  next++;
  return true;
}

std::string LargeBodyWords::text(const char *name)
{
  if (next >= narg) fail(0, fmt::format("missing {}", name));
  return arg[next++];
}

double LargeBodyWords::number(const char *name)
{
  const std::string word = text(name);
  const double value = utils::is_double(word) ? std::strtod(word.c_str(), nullptr) : NAN;
  if (!std::isfinite(value))
    fail(1, fmt::format("expected a number for {} instead of '{}'", name, word));
  return value;
}

double LargeBodyWords::positive(const char *name)
{
  const double value = number(name);
  if (!(value > 0.0)) fail(1, fmt::format("{} must be positive", name));
  return value;
}

double LargeBodyWords::number_or_null(const char *name)
{
  return take("NULL") ? 0.0 : number(name);
}

int LargeBodyWords::integer(const char *name, int least)
{
  const std::string word = text(name);
  const double value = utils::is_integer(word) ? std::strtod(word.c_str(), nullptr) : NAN;
  if (!(value >= least) || value > MAXSMALLINT)
    fail(1, fmt::format("expected a whole number of {} or more for {} instead of '{}'", least, name,
                        word));
  return static_cast<int>(value);
}

Vector3<double> LargeBodyWords::vector(const char *name)
{
  const double x = number(name), y = number(name);
  return {x, y, number(name)};
}

Vector3<double> LargeBodyWords::direction(const char *name)
{
  const Vector3<double> v = vector(name);
  const double length = std::sqrt(dot(v, v));
  if (!(length > 0.0)) fail(3, fmt::format("{} must not be zero", name));
  return 1.0 / length * v;
}
