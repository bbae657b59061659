// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Histories when a run continues with the other order of the integrator: springs of friction and of
// rolling are kept, and so are impacts; the rest is reset. For a law of second order the normal
// force of the last step, which is not in the history of first order, counts as unknown.

#ifndef TALUS_LAWS_CHANGE_OF_ORDER_H
#define TALUS_LAWS_CHANGE_OF_ORDER_H

#include "laws/contact_law.h"

namespace Talus {

/// Changes the history `values` (all indices, see ContactBatch::history) of a contact that touches.
/// `law`: that of order 1; `order`: of the run that begins.
void change_order(const ContactLaw &law, int order, HistoryValues &values);

}    // namespace Talus

#endif
