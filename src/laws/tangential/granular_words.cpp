// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The words of the laws of LAMMPS' pair granular.

#include "laws/law_list.h"
#include "laws/tangential/granular.h"
#include "laws/twisting/marshall.h"

#include <string>

namespace Talus {

void read_granular_friction(LawReader &r, bool with_kt, bool null_allowed)
{
  GivenNumbers &given = r.spec.given;
  const Law &normal = r.spec.law.normal();
  const int at_kt = r.words.index();
  double kt = 0.0;
  if (with_kt && r.words.not_negative_or_null("kt", kt))
    given["kt"] = null_allowed ? kt * r.pressure_unit : kt;
  else if (with_kt && !null_allowed)
    r.words.fail(r.words.index() - at_kt, "expected a number for kt instead of NULL");
  else if (with_kt && !given.has("E") && !given.has("moduli_of_types"))
    r.words.fail(r.words.index() - at_kt,
                 std::string("expected a number for kt instead of NULL: ") + normal.name +
                     " has no material to take it from");
  r.set_not_negative("xt");
  r.set_not_negative("mu");
}

void MarshallTwist::read(LawReader &r)
{
  r.check_later(r.words.index() - 1, [](const ContactLaw &whole) -> std::string {
    if (whole.tangential().lever_arms) return "";
    return "twisting marshall takes its coefficients from the tangential law: add 'tangential' "
           "with "
           "one of linear_nohistory, linear_history, linear_history_classic or mindlin*";
  });
}

}    // namespace Talus
