// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fluid/drag_law.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

constexpr double pi = 3.14159265358979323846;

double reynolds(const GrainInFluid &g)
{
  return g.density * g.porosity * g.speed * g.diameter / g.viscosity;
}

double stokes(const GrainInFluid &g)
{
  return 3.0 * pi * g.viscosity * g.diameter;
}

/// Of a grain alone, with this Reynolds number: c/(3 pi mu d) = Cd Re/24.
double schiller_naumann_factor(double re)
{
  return re < 1000.0 ? 1.0 + 0.15 * std::pow(re, 0.687) : 0.44 / 24.0 * re;
}

double schiller_naumann(const GrainInFluid &g)
{
  return stokes(g) * schiller_naumann_factor(reynolds(g) / g.porosity);
}

double ganser(const GrainInFluid &g, double sphericity)
{
  const double k1 = 3.0 / (1.0 + 2.0 / std::sqrt(sphericity)),
               k2 = std::pow(10.0, 1.8148 * std::pow(-std::log10(sphericity), 0.5743)),
               re = reynolds(g) / g.porosity, both = re * k1 * k2;
  return stokes(g) * ((1.0 + 0.1118 * std::pow(both, 0.6567)) / k1 +
                      0.4305 * k2 * re * both / (24.0 * (both + 3305.0)));
}

/* Cd = 8/(Re Pc^1/2) + 16/(Re P^1/2) + 3/(Re^1/2 P^3/4) + 0.42 10^(0.4 (-lg P)^0.2)/Pc, P sphericity, Pc crosswise */

double hoelzer_sommerfeld(const GrainInFluid &g)
{
  const double re = reynolds(g) / g.porosity, p = std::min(g.sphericity, 1.0),
               of_pressure = 0.42 * std::pow(10.0, 0.4 * std::pow(-std::log10(p), 0.2));
  return stokes(g) / 24.0 *
         (8.0 / std::sqrt(g.crosswise) + 16.0 / std::sqrt(p) +
          3.0 * std::sqrt(re) * std::pow(p, -0.75) + of_pressure * re / g.crosswise);
}

/* Cd e^(2 - chi) w pi/8 rho d^2 with Cd = (0.63 + 4.8/sqrt(Re))^2. */

double dallavalle_times(double power, const GrainInFluid &g)
{
  const double root = 0.63 * std::sqrt(reynolds(g)) + 4.8;
  return pi / 8.0 * g.viscosity * g.diameter * root * root * std::pow(g.porosity, 1.0 - power);
}

/// exp(-(1.5 - lg Re)^2/2), 0 at Re = 0.
double bell(double re)
{
  const double off = 1.5 - std::log10(re);
  return std::exp(-0.5 * off * off);
}

double di_felice(const GrainInFluid &g)
{
  return dallavalle_times(3.7 - 0.65 * bell(reynolds(g)), g);
}

double rong(const GrainInFluid &g)
{
  const double e = g.porosity;
  return dallavalle_times(2.65 * (e + 1.0) - (5.3 - 3.5 * e) * e * e * bell(reynolds(g)), g);
}

/* beta = 3/4 Cd rho e s w/d e^-2.65 */

double wen_yu(const GrainInFluid &g)
{
  return stokes(g) * schiller_naumann_factor(reynolds(g)) * std::pow(g.porosity, -2.65);
}

/* beta = 150 mu s^2/(e d^2) + 1.75 rho s w/d */

double ergun(const GrainInFluid &g)
{
  const double d = g.diameter, s = 1.0 - g.porosity;
  return pi / 6.0 * d * d *
         (150.0 * g.viscosity * s / (g.porosity * d) + 1.75 * g.density * g.speed);
}

double gidaspow(const GrainInFluid &g)
{
  return g.porosity > 0.8 ? wen_yu(g) : ergun(g);
}

/* beta = 18 mu e^2 s/d^2 (F0 + F3 Re/2) */

double koch_hill(const GrainInFluid &g)
{
  const double e = g.porosity, s = 1.0 - e;
  double f0 = 10.0 * s / (e * e * e);
  if (s < 0.4) {
    const double with_log = s > 0.0 ? 135.0 / 64.0 * s * std::log(s) : 0.0;
    f0 = (1.0 + 3.0 * std::sqrt(0.5 * s) + with_log + 16.14 * s) /
         (1.0 + s * (0.681 + s * (-8.48 + s * 8.16)));
  }
  const double f3 = 0.0673 + 0.212 * s + 0.0232 / std::pow(e, 5.0);
  return stokes(g) * e * e * (f0 + 0.5 * f3 * reynolds(g));
}

/* c = 3 pi mu d e F. The part of F with Re is

     0.413 Re/(24 e^2) (1/e + 3 e s + 8.4 Re^-0.343)/(1 + 10^(3 s)/Re^n)     n = (1 + 4 s)/2

   and has Re^n above and below the line here. */

double beetstra(const GrainInFluid &g)
{
  const double e = g.porosity, s = 1.0 - e, re = reynolds(g), n = 0.5 * (1.0 + 4.0 * s),
               above = std::pow(re, 1.0 + n) * (1.0 / e + 3.0 * e * s) +
                       8.4 * std::pow(re, 1.0 + n - 0.343),
               of_inertia =
                   0.413 / (24.0 * e * e) * above / (std::pow(re, n) + std::pow(10.0, 3.0 * s));
  return stokes(g) * e * (10.0 * s / (e * e) + e * e * (1.0 + 1.5 * std::sqrt(s)) + of_inertia);
}

enum {
  STOKES,
  SCHILLER_NAUMANN,
  GANSER,
  HOELZER_SOMMERFELD,
  DI_FELICE,
  WEN_YU,
  ERGUN,
  GIDASPOW,
  KOCH_HILL,
  BEETSTRA,
  RONG
};

}    // namespace

const std::vector<std::string> &DragLaw::names()
{
  static const std::vector<std::string> all{
      "stokes", "schiller/naumann", "ganser",    "hoelzer/sommerfeld", "difelice", "wen/yu",
      "ergun",  "gidaspow",         "koch/hill", "beetstra",           "rong"};
  return all;
}

DragLaw::DragLaw(int which, double of_shape, bool with_pressure) :
    law(which), sphericity(of_shape), total(with_pressure)
{
}

bool DragLaw::has_sphericity(int which)
{
  return which == GANSER;
}

bool DragLaw::depends_on_porosity() const
{
  return total || law > HOELZER_SOMMERFELD;
}

bool DragLaw::depends_on_shape() const
{
  return law == HOELZER_SOMMERFELD;
}

double DragLaw::coefficient(const GrainInFluid &grain) const
{
  const double c = [&] {
    switch (law) {
    case SCHILLER_NAUMANN:
      return schiller_naumann(grain);
    case GANSER:
      return ganser(grain, sphericity);
    case HOELZER_SOMMERFELD:
      return hoelzer_sommerfeld(grain);
    case DI_FELICE:
      return di_felice(grain);
    case WEN_YU:
      return wen_yu(grain);
    case ERGUN:
      return ergun(grain);
    case GIDASPOW:
      return gidaspow(grain);
    case KOCH_HILL:
      return koch_hill(grain);
    case BEETSTRA:
      return beetstra(grain);
    case RONG:
      return rong(grain);
    default:
      return stokes(grain);
    }
  }();
  return total ? c / grain.porosity : c;
}

}    // namespace Talus
