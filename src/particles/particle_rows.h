// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Three numbers of each particle, such as its position, wherever they are stored: in an array of LAMMPS or in the records
// (see ParticleState, which gives them). Read by local index.

#ifndef TALUS_PARTICLES_PARTICLE_ROWS_H
#define TALUS_PARTICLES_PARTICLE_ROWS_H

#include "particles/record.h"

#include <cstdint>

namespace Talus {

struct ParticleRows {
  const double *first;
  int width = 3;                 ///< numbers from one row to the next; of records at least 4
  const int *slots = nullptr;    ///< by local index; nullptr: rows are in that order

  const double *row(int i) const
  {
    return first + width * static_cast<std::int64_t>(slots ? slots[i] : i);
  }
  /// The fourth number is any.
  TALUS_INLINE Vec4 at(int i) const
  {
    const double *const from = row(i);
    return slots ? Memory<Vec4>::load_anywhere(from) : record_of(from, 0.0);
  }
};

}    // namespace Talus

#endif
