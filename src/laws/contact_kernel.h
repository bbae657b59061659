// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// One kernel is compiled for every combination of laws. A scene picks the ones it needs when a run
// is set up; nothing that a combination does not use is read, computed or branched upon in it.

#ifndef TALUS_LAWS_CONTACT_KERNEL_H
#define TALUS_LAWS_CONTACT_KERNEL_H

#include "laws/contact_batch.h"
#include "laws/contact_law.h"
#include "laws/contact_model.h"

namespace Talus {

/// Computes the contacts begin ... end-1 of a batch; both are multiples of `lanes`.
///   table  coefficients; a uniform kernel uses table[0] for every contact, the others
///          table[batch.coefficients[k]]
///   dt     time step (time units of the caller)
using ContactKernel = void (*)(ContactBatch &batch, int begin, int end,
                               const ContactCoefficients *table, double dt);

/// The kernel of one combination.
///   uniform  every contact has the coefficients table[0]
///   advance  true in a step of a run: the history advances; false while setting up: it is only
///   read
ContactKernel contact_kernel(ContactLaw law, bool uniform, bool advance);

/// One contact alone, history only read: for queries. Same bits as the kernels.
ContactForce<double> single_contact(ContactLaw law, const ContactCoefficients &coefficients,
                                    const ContactState<double> &state, double dt,
                                    const TangentialHistory<double> &history,
                                    const ContactImpact<double> &impact = {});

}    // namespace Talus

#endif
