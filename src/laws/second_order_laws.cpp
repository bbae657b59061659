// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/second_order_laws.h"

#include <cmath>
#include <cstring>

namespace Talus {
namespace {

bool is_named(const Law &law, const char *name)
{
  return std::strcmp(law.name, name) == 0;
}

/// The law of a stage for integrators of second order, nullptr if there is none. Without a tangential
/// force there is one, for the normal force.
const Law *counterpart_of(const ContactLaw &law, Stage stage)
{
  const Law &stage_law = law[stage];
  if (!stage_law.acts && stage != Stage::TANGENTIAL) return &stage_law;
  return stage_law.order_2 ? stage_law.order_2(law.normal().cohesive) : nullptr;
}

/// All of them have their first coefficient in gn, but for `none`.
bool damps(const ContactLaw &law, const ContactCoefficients &row)
{
  return !is_named(law.damping(), "none") && law.coefficients(Stage::DAMPING, row)[0] != 0.0;
}

/// The spring is set back by the rule "stock", see sliding.h, and there is a dashpot beside it:
/// else the rules are the same.
bool winds_up(const ContactLaw &law, const ContactCoefficients &row)
{
  const Law &tangential = law.tangential(), &damping = law.damping();
  if (tangential.lever_arms)
    return tangential.odd_history > 0 && damps(law, row) &&
           law.coefficient(Stage::TANGENTIAL, "xt", row) != 0.0;
  if (!is_named(tangential, "multistep") && !is_named(tangential, "multistep midpoint"))
    return false;
  for (const char *of_gt : {"gt", "tangential damping"})
    if (damping.reads(of_gt)) return law.coefficient(Stage::DAMPING, of_gt, row) != 0.0;
  return damps(law, row);
}

/// In words of the command that has the law: those of lever_arms are pair style granular's.
std::string cure_of_tangential(const Law &tangential)
{
  if (tangential.lever_arms) return "use 'tangential linear_history' or 'tangential mindlin'";
  return "use 'tangential multistep kt gt mu slider midpoint'";
}

std::string reason_of_resistance(const ContactLaw &law, const ContactCoefficients &row)
{
  if (law.delayed())
    return "has resistance to rolling or spinning that is 'delayed', which begins with a jump and "
           "pushes a body at rest back and forth: leave the word out";
  if (!counterpart_of(law, Stage::TWISTING))
    return std::string("has the twisting law ") + law.twisting().name +
           ", whose torque jumps from one side to the other where a twist that slides comes to "
           "rest, so that runs with small time steps do not agree: leave 'twisting' out, or use "
           "'spinning mu' of gran/penalty";
  if (law.coefficient(Stage::ROLLING, "roll_min", row) > 0.0 ||
      law.coefficient(Stage::TWISTING, "twist_min", row) > 0.0)
    return "has speeds below which resistance does not act: give 0 as the second and third number "
           "of 'vmin'";
  return "";
}

}    // namespace

std::string reason_against_second_order(const ContactLaw &law, const ContactCoefficients &row)
{
  const Law &tangential = law.tangential();
  if (law.normal().hysteretic)
    return std::string("has the normal law ") + law.normal().name +
           ", whose stiffness jumps where loading turns: use order 1";
  if (law.bridges())
    return std::string("has the adhesion ") + law.cohesion().name +
           ", a bridge that is made and breaks with a jump: use order 1";
  if (law.reaches())
    return std::string("has heat ") + law.heat().name +
           ", which begins and ends with a jump at its reach: use order 1";
  if (!law.normal().cohesive && damps(law, row) &&
      std::isinf(law.coefficient(Stage::DAMPING, "floor", row)))
    return "has damping that may attract, whose force ends with a jump: add 'limit_damping'";
  const std::string resistance = reason_of_resistance(law, row);
  if (!resistance.empty()) return resistance;
  if (!counterpart_of(law, Stage::TANGENTIAL))
    return std::string("has the tangential law ") + tangential.name + ": " +
           cure_of_tangential(tangential);
  if (winds_up(law, row))
    return std::string("has the tangential law ") + tangential.name +
           ", which sets a sliding spring back by the rule of stock LAMMPS, with a dashpot that "
           "winds it up: use " +
           (tangential.lever_arms ? "xt = 0"
                                  : "'tangential multistep kt gt mu slider midpoint' or gt = 0 "
                                    "(in gran/hooke/history: dampflag 0)");
  return "";
}

ContactLaw second_order_law(ContactLaw law)
{
  if (law.tangential().second_order) return law;
  const ContactLaw first_order = law;
  for (const Stage stage : {Stage::TANGENTIAL, Stage::ROLLING, Stage::TWISTING})
    if (const Law *counterpart = counterpart_of(first_order, stage)) law.choose(stage, counterpart);
  return law;
}

}    // namespace Talus
