// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which laws can be computed to second order in the time step, and how. See
// tangential/second_order.h.

#ifndef TALUS_LAWS_SECOND_ORDER_LAWS_H
#define TALUS_LAWS_SECOND_ORDER_LAWS_H

#include "laws/contact_law.h"

#include <string>

namespace Talus {

/// "", or why a contact with this law and these coefficients is not of second order, with the cure,
/// as text for messages: it follows on the name of what has the law.
std::string reason_against_second_order(const ContactLaw &law, const ContactCoefficients &row);

/// The same law for integrators of second order. Stages that have none stay what they are: it may
/// be called before reason_against_second_order(), as by a large body that is being defined.
/// Coefficients have to be mixed for it.
ContactLaw second_order_law(ContactLaw law);

}    // namespace Talus

#endif
