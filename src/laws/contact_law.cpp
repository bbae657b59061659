// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/contact_law.h"

namespace Talus {

const char *name_of(NormalLaw law)
{
  static const char *const names[num_normal_laws] = {
      "hooke",          "hertz",          "flores",          "plaincoulomb",
      "hooke/material", "hertz/material", "flores/material", "plaincoulomb/material"};
  return names[static_cast<int>(law)];
}

const char *name_of(TangentialLaw law)
{
  static const char *const names[num_tangential_laws] = {"none",
                                                         "dashpot",
                                                         "onestep",
                                                         "multistep",
                                                         "tanh",
                                                         "multistep midpoint",
                                                         "multistep slider",
                                                         "multistep slider midpoint"};
  return names[static_cast<int>(law)];
}

}    // namespace Talus
