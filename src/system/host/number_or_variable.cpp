// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/host/number_or_variable.h"

#include "base/words.h"
#include "system/host/time_formula.h"

#include "error.h"
#include "input.h"
#include "lammps.h"
#include "variable.h"

using namespace LAMMPS_NS;

namespace Talus {

NumberOrVariable NumberOrVariable::from(Words &words, const char *what)
{
  if (words.peek().compare(0, 2, "v_") == 0) return {0.0, words.text(what).substr(2)};
  return {words.number(what), {}};
}

void NumberOrVariable::check(LAMMPS *lmp, const std::string &command) const
{
  if (!is_variable()) return;
  const int index = lmp->input->variable->find(name.c_str());
  if (index < 0) lmp->error->all(FLERR, "{}: variable '{}' does not exist", command, name);
  if (!lmp->input->variable->equalstyle(index))
    lmp->error->all(FLERR, "{}: variable '{}' is not an equal-style variable", command, name);
}

double NumberOrVariable::evaluate(LAMMPS *lmp) const
{
  if (!is_variable()) return value;
  const int index = lmp->input->variable->find(name.c_str());
  if (index < 0) lmp->error->all(FLERR, "Variable '{}' has been deleted, and a fix needs it", name);
  return lmp->input->variable->compute_equal(index);
}

bool NumberOrVariable::reads_more_than_time(LAMMPS *lmp) const
{
  return is_variable() && !reads_only_time(lmp, name);
}

}    // namespace Talus
