// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "material/contact_spec.h"

namespace Talus {

ContactCoefficients contact_coefficients(const ContactSpec &a, const ContactSpec &b,
                                         FrictionMix rule)
{
  ContactCoefficients row;
  for (int s = 0; s < num_stages; s++) {
    const Stage stage = static_cast<Stage>(s);
    a.law[stage].mix({a, b, rule}, row.c + a.law.first_coefficient(stage));
  }
  return row;
}

}    // namespace Talus
