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

/// Tangential laws and those of second order with the same limit.
struct Twin {
  const char *name, *second_order;
};
constexpr Twin twins[] = {
    {"none", "none order 2"},
    {"multistep", "multistep order 2"},
    {"multistep midpoint", "multistep order 2"},
    {"multistep slider", "multistep order 2"},
    {"multistep slider midpoint", "multistep order 2"},
    {"dashpot", "dashpot order 2"},
    {"tanh", "tanh order 2"},
    {"linear_nohistory", "linear_nohistory order 2"},
    {"linear_history", "linear_history order 2"},
    {"mindlin", "mindlin order 2"},
};

const char *twin_of(const Law &tangential)
{
  for (const Twin &one : twins)
    if (is_named(tangential, one.name)) return one.second_order;
  return nullptr;
}

/// All of them have their first coefficient in gn, but for `none`.
bool damps(const ContactLaw &law, const ContactCoefficients &row)
{
  return !is_named(law.damping(), "none") && law.coefficients(Stage::DAMPING, row)[0] != 0.0;
}

/// The spring is set back by the rule "stock", see sliding.h, and there is a dashpot beside it: else
/// the rules are the same.
bool winds_up(const ContactLaw &law, const ContactCoefficients &row)
{
  const Law &tangential = law.tangential(), &damping = law.damping();
  if (tangential.lever_arms)
    return tangential.has_spring && damps(law, row) &&
           law.coefficient(Stage::TANGENTIAL, "xt", row) != 0.0;
  if (!is_named(tangential, "multistep") && !is_named(tangential, "multistep midpoint"))
    return false;
  for (const char *of_gt : {"gt", "tangential damping"})
    if (damping.reads(of_gt)) return law.coefficient(Stage::DAMPING, of_gt, row) != 0.0;
  return damps(law, row);
}

/// The law of a stage for integrators of second order, nullptr if it has none.
const Law *second_order_stage(const Law &law)
{
  return law.acts ? find_law(law.stage, std::string(law.name) + " order 2") : &law;
}

std::string reason_of_resistance(const ContactLaw &law, const ContactCoefficients &row)
{
  if (law.delayed())
    return "has resistance to rolling or spinning that is 'delayed', which begins with a jump and "
           "pushes a body at rest back and forth: leave the word out";
  for (const Law *its : {&law.rolling(), &law.twisting()})
    if (!second_order_stage(*its))
      return std::string("has the ") + name_of(its->stage) + " law " + its->name +
             ": use 'rolling mu' and 'spinning mu'";
  if (law.coefficient(Stage::ROLLING, "roll_min", row) > 0.0 ||
      law.coefficient(Stage::TWISTING, "twist_min", row) > 0.0)
    return "has speeds below which resistance does not act: give 0 as the second and third number "
           "of 'vmin'";
  return "";
}

}    // namespace

std::string reason_against_second_order(const ContactLaw &law, const ContactCoefficients &row)
{
  const Law &normal = law.normal(), &tangential = law.tangential();
  if (normal.lasts_beyond_contact)
    return std::string("has the normal law ") + normal.name +
           ", whose contacts tear: use hertz/material with 'adhesion constant F'";
  if (damps(law, row) && std::isinf(law.coefficient(Stage::DAMPING, "floor", row)))
    return std::string("has damping that may attract, whose force ends with a jump: ") +
           (normal.cohesive ? "use hertz/material with 'adhesion perko S', S = 4 pi gamma, and "
                              "'limit_damping', or no damping"
                            : "add 'limit_damping'");
  const std::string resistance = reason_of_resistance(law, row);
  if (!resistance.empty()) return resistance;
  if (!twin_of(tangential))
    return std::string("has the tangential law ") + tangential.name +
           ": use 'tangential multistep kt gt mu slider midpoint'";
  if (winds_up(law, row))
    return std::string("has the tangential law ") + tangential.name +
           ", which sets a sliding spring back by the rule of stock LAMMPS, with a dashpot that "
           "winds it up: use " +
           (tangential.lever_arms ? "xt = 0"
                                  : "'tangential multistep kt gt mu slider midpoint' or gt = 0");
  return "";
}

ContactLaw second_order_law(ContactLaw law)
{
  law.choose(Stage::TANGENTIAL, find_law(Stage::TANGENTIAL, twin_of(law.tangential())));
  for (const Stage stage : {Stage::ROLLING, Stage::TWISTING})
    law.choose(stage, second_order_stage(law[stage]));
  return law;
}

}    // namespace Talus
