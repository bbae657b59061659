// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "material/run_laws.h"

#include <algorithm>

namespace Talus {
namespace {

/* While a run is set up, the work is that of another time than the step's, and so found apart from
   the forces. A law of order 2 puts in the place of the overlap of a contact that has just ended the
   one that it had before (see find_last_overlap in laws/contact_kernel.cpp): what comes next must
   find that of the positions again. */

void find_work_at_setup(ContactBatch &batch, int law_index, int begin, int end, const LawStep &step)
{
  double overlap[ContactBatch::width];
  std::copy(batch.overlap + begin, batch.overlap + end, overlap);
  step.laws.accounting_kernel(law_index, false)(batch, begin, end, step.laws.coefficients(),
                                                step.account->time_at_setup);
  std::copy(overlap, overlap + (end - begin), batch.overlap + begin);
}

}    // namespace

void run_laws(ContactBatch &batch, int law_index, int begin, int end, const LawStep &step)
{
  const bool sets_up = step.account && step.account->time_at_setup >= 0.0;
  if (sets_up) find_work_at_setup(batch, law_index, begin, end, step);
  const ContactKernel &kernel = step.account && !sets_up
                                    ? step.laws.accounting_kernel(law_index, true)
                                    : step.laws.kernel(law_index, step.advance);
  kernel(batch, begin, end, step.laws.coefficients(), step.dt);
}

}    // namespace Talus
