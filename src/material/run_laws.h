// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The one place where contacts of a batch become forces: whether the run is being set up, and whether
// somebody wants to know their work, is known here alone. Sources of contacts (pairs of spheres,
// spheres and large bodies, points of shapes) fill the batch and hand out what they find in it.

#ifndef TALUS_MATERIAL_RUN_LAWS_H
#define TALUS_MATERIAL_RUN_LAWS_H

#include "laws/contact_batch.h"
#include "laws/contact_energy.h"
#include "material/law_table.h"

namespace Talus {

/// What is the same for all contacts of a step.
struct LawStep {
  const LawTable &laws;
  double dt;                               ///< time step (time units of the host)
  bool advance;                            ///< false while a run is set up: histories are only read
  const WorkAccount *account = nullptr;    ///< given: ContactBatch::work is found as well
};

/// Computes the contacts begin ... end-1 of a batch, multiples of `lanes`, by one law of the table.
/// Forces and histories have the same bits with and without an account.
void run_laws(ContactBatch &batch, int law_index, int begin, int end, const LawStep &step);

}    // namespace Talus

#endif
