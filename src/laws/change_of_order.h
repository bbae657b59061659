// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What a contact remembers when a run goes on with the other order of the integrator: springs of
// friction and of rolling stay as they are, and so do impacts; the rest begins anew. A law of second
// order takes the normal force of the last step, which that of first order does not remember, for
// one that is not known.

#ifndef TALUS_LAWS_CHANGE_OF_ORDER_H
#define TALUS_LAWS_CHANGE_OF_ORDER_H

#include "laws/contact_law.h"

namespace Talus {

/// The history of a contact that touches, `values`: all
/// places, see ContactBatch::history. `law`: that
/// of order 1; `order`: of the run that begins.
void change_order(const ContactLaw &law, int order, HistoryValues &values);

}    // namespace Talus

#endif
