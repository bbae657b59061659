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
  else if (with_kt && !given.has("E"))
    r.words.fail(r.words.index() - at_kt,
                 std::string("expected a number for kt instead of NULL: ") + normal.name +
                     " has no material to take it from");
  r.set_not_negative("xt");
  r.set_not_negative("mu");
}

void MarshallTwist::read(LawReader &r)
{
  if (!r.spec.law.tangential().lever_arms)
    r.words.fail(1, "twisting marshall takes its coefficients from the tangential law: put one of "
                    "linear_* or mindlin* before it");
}

}    // namespace Talus
