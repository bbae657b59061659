// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fluid/heat_law.h"

#include <cmath>

namespace Talus {
namespace {

enum { RANZ_MARSHALL, GUNN };

}    // namespace

const std::vector<std::string> &HeatLaw::names()
{
  static const std::vector<std::string> all{"ranz/marshall", "gunn"};
  return all;
}

bool HeatLaw::depends_on_porosity() const
{
  return law == GUNN;
}

double HeatLaw::nusselt(const GrainInFluid &g, double prandtl) const
{
  const double free = g.density * g.speed * g.diameter / g.viscosity, root = std::cbrt(prandtl);
  if (law == RANZ_MARSHALL) return 2.0 + 0.6 * std::sqrt(free) * root;
  const double e = g.porosity, re = e * free;
  return (7.0 + e * (-10.0 + 5.0 * e)) * (1.0 + 0.7 * std::pow(re, 0.2) * root) +
         (1.33 + e * (-2.4 + 1.2 * e)) * std::pow(re, 0.7) * root;
}

}    // namespace Talus
