// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Eight bonds, and what particles have in rows, as lanes: one for each bond.

#ifndef TALUS_BONDS_BOND_ROWS_H
#define TALUS_BONDS_BOND_ROWS_H

#include "base/lanes.h"
#include "base/vector3.h"
#include "particles/particle_rows.h"

#include <algorithm>
#include <cstdint>

namespace Talus {

/// Of one bond: local indices of its particles, `first` with the lower ID, and its type, from 1; of one that is gone, 0.
struct BondEnds {
  int first, second, type;
};

/// Bonds begin ... begin + count - 1; where they are fewer than eight, `ends` has the last one again.
struct EightBonds {
  const BondEnds *ends;
  int begin, count;

  /// Of lane k in what is stored by bond.
  std::int64_t place(int k) const { return begin + std::min(k, count - 1); }
  bool same_type() const
  {
    return std::all_of(ends, ends + lanes,
                       [this](const BondEnds &b) { return b.type == ends->type; });
  }
};

TALUS_INLINE Vector3<Vec8> vector_of(const EightRows &rows)
{
  return {rows.number[0], rows.number[1], rows.number[2]};
}

/// Those of the first particles less those of the second ones.
TALUS_INLINE Vector3<Vec8> differences(const ParticleRows &rows, const BondEnds *ends)
{
  return vector_of(
      lanes_of([=](int k) { return rows.at(ends[k].first) - rows.at(ends[k].second); }));
}

}    // namespace Talus

#endif
