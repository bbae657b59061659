// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/second_order_laws.h"

#include "laws/law_list.h"

#include <cmath>
#include <cstring>

namespace Talus {
namespace {

bool is_named(const Law &law, const char *name)
{
  return std::strcmp(law.name, name) == 0;
}

/// All of them have their first coefficient in gn, but for `none`.
bool damps(const ContactLaw &law, const ContactCoefficients &row)
{
  return !is_named(law.damping(), "none") && law.coefficients(Stage::DAMPING, row)[0] != 0.0;
}

}    // namespace

std::string reason_against_second_order(const ContactLaw &law, const ContactCoefficients &row)
{
  const Law &normal = law.normal(), &damping = law.damping(), &tangential = law.tangential();
  if (normal.cohesive)
    return std::string("has the normal law ") + normal.name +
           ", whose contacts tear: use hertz/material with 'adhesion constant F'";
  if (normal.exponent != 1.0 && normal.exponent != 1.5)
    return std::string("has the normal law ") + normal.name;
  if (law.history().keeps_impact || damping.damping_exponent(normal.exponent) < 0.0)
    return std::string("has the normal law ") + normal.name + " with the damping " + damping.name +
           ", whose begin of a contact is not known: use hooke, hertz or hertz/material";
  if (damps(law, row) && std::isinf(law.coefficient(Stage::DAMPING, "floor", row)))
    return "has damping that may attract, whose force ends with a jump: add 'limit_damping'";
  if (law.resists())
    return "has resistance to rolling or spinning, which holds a body a few time steps late: use "
           "'rolling 0 spinning 0'";
  if (tangential.acts && !is_named(tangential, "multistep slider midpoint"))
    return std::string("has the tangential law ") + tangential.name +
           ": use 'tangential multistep kt gt mu slider midpoint'";
  return "";
}

ContactLaw second_order_law(ContactLaw law)
{
  law.choose(
      Stage::TANGENTIAL,
      find_law(Stage::TANGENTIAL, law.tangential().acts ? "multistep order 2" : "none order 2"));
  return law;
}

}    // namespace Talus
