// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The words of rolling and spinning resistance.

#include "laws/law_list.h"
#include "laws/rolling/common.h"

namespace Talus {

void read_resistance(LawReader &r, Stage stage)
{
  GivenNumbers &given = r.spec.given;
  ContactLaw &law = r.spec.law;
  const bool rolls = stage == Stage::ROLLING;
  r.set_not_negative(rolls ? "mu_r" : "mu_s");
  const bool delayed = r.words.take("delayed");
  if (given.has("mu_r") && given.has("mu_s") && delayed != law.delayed())
    r.words.fail(1, "rolling and spinning must both be delayed, or both not");
  if (rolls || !law.rolling().acts)
    law.choose(Stage::ROLLING, find_law(Stage::ROLLING, delayed ? "delayed" : "holding"));
  if (!rolls || !law.twisting().acts)
    law.choose(Stage::TWISTING, find_law(Stage::TWISTING, delayed ? "delayed" : "stopping"));
}

}    // namespace Talus
