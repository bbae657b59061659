// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The one place where the contacts of a batch become forces: set-up of a run and accounting for
// work are handled here alone. The callers (pairs of spheres, spheres and large bodies, points of
// shapes) fill the batch and distribute the results.

#ifndef TALUS_MATERIAL_RUN_LAWS_H
#define TALUS_MATERIAL_RUN_LAWS_H

#include "laws/contact_batch.h"
#include "laws/contact_energy.h"
#include "material/law_table.h"

namespace Talus {

/// What is the same for all contacts of a step.
struct LawStep {
  const LawTable &laws;
  double dt;                               ///< time step (time units of LAMMPS)
  bool advance;                            ///< false while a run is set up: histories are only read
  const WorkAccount *account = nullptr;    ///< if given, ContactBatch::work is computed as well
};

/// Computes the contacts begin ... end-1 of a batch, multiples of `lanes`, by one law of the table.
/// Forces and histories have the same bits with and without an account.
void run_laws(ContactBatch &batch, int law_index, int begin, int end, const LawStep &step);

}    // namespace Talus

#endif
