// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Pair style gran/penalty: the commands pair_style and pair_coeff.

#include "pair/pair_gran_penalty.h"

#include "laws/contact_words.h"
#include "system/command_words.h"

#include "atom.h"
#include "error.h"
#include "force.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace Talus;

void PairGranPenalty::settings(int narg, char **arg)
{
  FrictionMix &mix = system->laws().mix;
  mix = FrictionMix::MINIMUM;
  if (narg == 0) return;
  if (strcmp(arg[0], "mix") != 0)
    error->all(FLERR, 1, "pair_style gran/penalty: unknown word '{}', expected mix", arg[0]);
  if (narg < 2)
    error->all(FLERR, 1,
               "pair_style gran/penalty: missing rule after mix: "
               "min, arithmetic or geometric");
  if (strcmp(arg[1], "min") == 0)
    mix = FrictionMix::MINIMUM;
  else if (strcmp(arg[1], "arithmetic") == 0)
    mix = FrictionMix::ARITHMETIC;
  else if (strcmp(arg[1], "geometric") == 0)
    mix = FrictionMix::GEOMETRIC;
  else
    error->all(FLERR, 2,
               "pair_style gran/penalty: unknown rule '{}' after mix, "
               "expected min, arithmetic or geometric",
               arg[1]);
  if (narg > 2) error->all(FLERR, 3, "pair_style gran/penalty: surplus word '{}'", arg[2]);
}

void PairGranPenalty::coeff(int narg, char **arg)
{
  if (!allocated) allocate();
  // under pair hybrid the name of the style has been taken out of the words
  const int shift = utils::strmatch(force->pair_style, "^hybrid") ? 1 : 0;
  if (narg < 3)
    error->all(FLERR, "pair_coeff gran/penalty: expected two types and a contact law, e.g. "
                      "'pair_coeff * * hertz kn gn tangential multistep NULL NULL mu'");

  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);

  Words words = command_words(lmp, "pair_coeff gran/penalty", narg, arg, 2, shift);
  const ContactSpec parsed = parse_contact(words, 1.0 / force->nktv2p);
  if (!words.at_end())
    words.fail(0, "unknown word '" + words.peek() + "', expected " + contact_keywords);

  int count = 0;
  for (int i = ilo; i <= ihi; i++)
    for (int j = std::max(jlo, i); j <= jhi; j++) {
      system->laws().set(i, j, parsed);
      setflag[i][j] = 1;
      count++;
    }
  if (count == 0)
    error->all(FLERR,
               "pair_coeff gran/penalty: no pair of types in '{} {}', write the lower type "
               "first",
               arg[0], arg[1]);
  system->laws_have_changed();
}
