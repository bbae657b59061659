/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "system/loads/constant_gravity.h"

#include "domain.h"
#include "math_const.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace LAMMPS_NS;
using MathConst::DEG2RAD;
using Talus::Vector3;
using Talus::Words;

namespace {

/* ----------------------------------------------------------------------
   a number: a variable would be read once only, and the user would not notice
------------------------------------------------------------------------- */

double constant(Words &words, const std::string &name)
{
  const std::string word = words.peek();
  if (word.compare(0, 2, "v_") == 0)
    words.fail(0, "expected a constant for " + name + " instead of variable '" + word + "'");
  return words.number(name);
}

}    // namespace

/* ---------------------------------------------------------------------- */

void ConstantGravity::parse(Words &words)
{
  words.about("gravity");
  is_given = true;
  const double magnitude = constant(words, "magnitude");
  const int style = words.choice("direction", {"chute", "spherical", "vector"});
  if (style == 0) {
    set(magnitude, 0.0, 180.0 - constant(words, "angle in degrees"));
  } else if (style == 1) {
    const double phi = constant(words, "phi in degrees");
    set(magnitude, phi, constant(words, "theta in degrees"));
  } else {
    const double x = constant(words, "component x"), y = constant(words, "component y");
    set_along(magnitude, {x, y, constant(words, "component z")}, words);
  }
}

/* ----------------------------------------------------------------------
   direction by angles from the z axis, in 2d from the y axis without phi
------------------------------------------------------------------------- */

void ConstantGravity::set(double magnitude, double phi, double theta)
{
  const double s = sin(DEG2RAD * theta), c = cos(DEG2RAD * theta);
  const bool flat = domain->dimension == 2;
  g[0] = magnitude * (flat ? s : s * cos(DEG2RAD * phi));
  g[1] = magnitude * (flat ? c : s * sin(DEG2RAD * phi));
  g[2] = magnitude * (flat ? 0.0 : c);
}

/* ----------------------------------------------------------------------
   squares of components beyond 1e154 are not finite, those below 1e-162 are zero
------------------------------------------------------------------------- */

void ConstantGravity::set_along(double magnitude, Vector3<double> d, Words &words)
{
  if (domain->dimension == 2) d.z = 0.0;
  const double largest = std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
  if (!(largest > 0.0))
    words.fail(3, std::string("the direction must not be zero") +
                      (domain->dimension == 2 ? " in the xy plane" : ""));
  if (!(largest < 1e150 && largest > 1e-150)) d = {d.x / largest, d.y / largest, d.z / largest};
  const double length = Talus::length(d);
  g[0] = magnitude * (d.x / length);
  g[1] = magnitude * (d.y / length);
  g[2] = magnitude * (d.z / length);
}
