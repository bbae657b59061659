// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "material/contact_spec.h"

#include "base/number_text.h"

#include <initializer_list>
#include <string>

namespace Talus {

ContactCoefficients contact_coefficients(const ContactSpec &a, const ContactSpec &b,
                                         FrictionMix rule)
{
  ContactCoefficients row;
  for (int s = 0; s < num_stages; s++) {
    const Stage stage = static_cast<Stage>(s);
    a.law[stage].mix({a, b, rule}, row.c + a.law.first_coefficient(stage));
  }
  return row;
}

/* Numbers of the normal direction first, then stiffness and damping of the tangential one. */

std::string ContactSides::describe(const std::string &note) const
{
  const ContactCoefficients row = coefficients();
  std::string text = describe_law(law()) + note + ";";
  const auto add = [&](Stage stage, Shown shown) {
    const Law &one = law()[stage];
    for (int n = 0; n < one.num_coefficients; n++) {
      if (one.coefficients[n].shown != shown) continue;
      text += std::string(" ") + one.coefficients[n].name + " " +
              number_text(law().coefficients(stage, row)[n]);
    }
  };
  const auto always = [&](std::initializer_list<Stage> stages) {
    for (Stage stage : stages) add(stage, Shown::ALWAYS);
  };
  always({Stage::NORMAL, Stage::DAMPING});
  if (law().tangential().reads_stiffness)
    for (Stage stage : {Stage::NORMAL, Stage::DAMPING}) add(stage, Shown::WITH_SPRING);
  always({Stage::TANGENTIAL, Stage::ROLLING, Stage::TWISTING, Stage::COHESION, Stage::HEAT});
  return text + (Mixing{a, b, rule}.limits_damping() ? " limit_damping" : "");
}

}    // namespace Talus
