/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "constant_gravity.h"

#include "domain.h"
#include "error.h"
#include "math_const.h"

#include <cmath>
#include <cstdlib>
#include <string>

using namespace LAMMPS_NS;
using MathConst::DEG2RAD;

/* ---------------------------------------------------------------------- */

ConstantGravity::ConstantGravity(LAMMPS *lmp, const char *command) : Pointers(lmp), command(command)
{
}

/* ---------------------------------------------------------------------- */

int ConstantGravity::parse(int narg, char **arg, int iarg)
{
  need(narg, arg, iarg, 2, "magnitude and one of chute, spherical, vector");
  const double magnitude = number(arg, iarg + 1, "the magnitude");
  const std::string style = arg[iarg + 2];
  const int first = iarg + 3;

  if (style == "chute") {
    need(narg, arg, iarg + 2, 1, "the angle in degrees");
    const double angle = number(arg, first, "the angle in degrees");
    set(magnitude, 0.0, 180.0 - angle);
    return words = 4;
  }

  if (style == "spherical") {
    need(narg, arg, iarg + 2, 2, "phi and theta in degrees");
    const double phi = number(arg, first, "phi in degrees");
    const double theta = number(arg, first + 1, "theta in degrees");
    set(magnitude, phi, theta);
    return words = 5;
  }

  if (style == "vector") {
    need(narg, arg, iarg + 2, 3, "the components x y z");
    const double x = number(arg, first, "component x");
    const double y = number(arg, first + 1, "component y");
    double z = number(arg, first + 2, "component z");
    if (domain->dimension == 2) z = 0.0;
    const double length = sqrt(x * x + y * y + z * z);
    if (!(length > 0.0))
      error->all(FLERR, first, "{} gravity vector: expected a direction of non-zero length{}",
                 command, domain->dimension == 2 ? " in the xy plane" : "");
    set(magnitude, x / length, y / length, z / length);
    return words = 6;
  }

  error->all(FLERR, iarg + 2, "{} gravity: expected chute, spherical or vector instead of '{}'",
             command, style);
}

/* ----------------------------------------------------------------------
   error unless n more words follow the one at iarg
------------------------------------------------------------------------- */

void ConstantGravity::need(int narg, char **arg, int iarg, int n, const char *what)
{
  if (iarg + n >= narg)
    error->all(FLERR, iarg, "{} gravity: expected {} after '{}'", command, what, arg[iarg]);
}

/* ----------------------------------------------------------------------
   the finite number at iarg
------------------------------------------------------------------------- */

double ConstantGravity::number(char **arg, int iarg, const char *what)
{
  if (utils::strmatch(arg[iarg], "^v_"))
    error->all(FLERR, iarg, "{} gravity: expected a constant for {} instead of variable '{}'",
               command, what, arg[iarg]);
  const double value = utils::is_double(arg[iarg]) ? strtod(arg[iarg], nullptr) : NAN;
  if (!std::isfinite(value))
    error->all(FLERR, iarg, "{} gravity: expected a number for {} instead of '{}'", command, what,
               arg[iarg]);
  return value;
}

/* ----------------------------------------------------------------------
   direction by angles from the z axis, in 2d from the y axis without phi
------------------------------------------------------------------------- */

void ConstantGravity::set(double magnitude, double phi, double theta)
{
  const double s = sin(DEG2RAD * theta), c = cos(DEG2RAD * theta);
  if (domain->dimension == 2)
    set(magnitude, s, c, 0.0);
  else
    set(magnitude, s * cos(DEG2RAD * phi), s * sin(DEG2RAD * phi), c);
}

void ConstantGravity::set(double magnitude, double x, double y, double z)
{
  g[0] = magnitude * x;
  g[1] = magnitude * y;
  g[2] = magnitude * z;
}
