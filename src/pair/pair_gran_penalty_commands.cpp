// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Pair style gran/penalty: the commands pair_style and pair_coeff.

#include "pair/pair_gran_penalty.h"

#include "laws/contact_words.h"
#include "system/host/command_words.h"

#include "atom.h"
#include "error.h"
#include "force.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace Talus;

void PairGranPenalty::settings(int narg, char **arg)
{
  constexpr FrictionMix rules[] = {FrictionMix::MINIMUM, FrictionMix::ARITHMETIC,
                                   FrictionMix::GEOMETRIC};
  FrictionMix &mix = system->laws().mix;
  mix = FrictionMix::MINIMUM;
  Words words = command_words(lmp, "pair_style gran/penalty", narg, arg, 0, 1);
  if (words.at_end()) return;
  if (!words.take("mix")) words.fail(0, "unknown word '" + words.peek() + "', expected mix");
  mix = rules[words.choice("rule", {"min", "arithmetic", "geometric"})];
  words.end();
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
      if (i == j && takes_moduli_of_types(parsed))
        error->all(FLERR,
                   "pair_coeff gran/penalty: E and nu = NULL are those of types I and J in "
                   "'pair_coeff I J' with I < J: write numbers for types {} and {}",
                   i, i);
      system->laws().set(i, j, parsed);
      setflag[i][j] = 1;
      count++;
    }
  if (count == 0)
    error->all(FLERR,
               "pair_coeff gran/penalty: no pair of types in '{} {}', write the lower type "
               "first",
               arg[0], arg[1]);
}
