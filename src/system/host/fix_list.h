// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SYSTEM_HOST_FIX_LIST_H
#define TALUS_SYSTEM_HOST_FIX_LIST_H

#include "modify.h"

#include <vector>

namespace Talus {

/// All fixes in the order of the script. A copy, to loop over: LAMMPS makes the list that
/// Modify::get_fix_list() refers to again whenever it is asked for, also from within such a loop.
inline std::vector<LAMMPS_NS::Fix *> fix_list(LAMMPS_NS::Modify &modify)
{
  return modify.get_fix_list();
}

}    // namespace Talus

#endif
