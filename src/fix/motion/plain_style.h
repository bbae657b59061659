/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#ifndef LMP_PLAIN_STYLE_H
#define LMP_PLAIN_STYLE_H

#include "fix.h"

namespace LAMMPS_NS {

/* The name of the style that an accelerated fix stands for, in post_constructor(): what other
   commands look for, and what restart files name, so that they go both ways. */

inline void restore_style(Fix *fix, const char *plain)
{
  delete[] fix->style;
  fix->style = utils::strdup(plain);
}

}    // namespace LAMMPS_NS

#endif
