// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The words of rolling and spinning resistance.

#include "laws/law_list.h"
#include "laws/rolling/common.h"

namespace Talus {

void read_resistance(LawReader &r, const char *mu)
{
  GivenNumbers &given = r.spec.given;
  ContactLaw &law = r.spec.law;
  r.set_not_negative(mu);
  const bool delayed = r.words.take("delayed");
  if (given.has("mu_r") && given.has("mu_s") && delayed != law.delayed())
    r.words.fail(1, "rolling and spinning must both be delayed, or both not");
  law.choose(Stage::ROLLING, find_law(Stage::ROLLING, delayed ? "delayed" : "holding"));
  law.choose(Stage::TWISTING, find_law(Stage::TWISTING, delayed ? "delayed" : "stopping"));
}

}    // namespace Talus
