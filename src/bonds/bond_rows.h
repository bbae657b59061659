// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Eight bonds, and what particles have in rows, as lanes: one for each bond.

#ifndef TALUS_BONDS_BOND_ROWS_H
#define TALUS_BONDS_BOND_ROWS_H

#include "base/lanes.h"
#include "base/vector3.h"
#include "particles/record.h"

#include <algorithm>
#include <cstdint>

namespace Talus {

/// Of one bond: where its particles are, `first` with the lower ID, and its type, from 1; of one that is gone, 0.
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

/// Lane k: the numbers of row(k), a Vec4.
template <class Row> TALUS_INLINE EightRows lanes_of(Row row)
{
  EightRows to;
  for (int k = 0; k < 4; k++) to.number[k] = join(row(k), row(k + 4));
  transpose(to.number[0], to.number[1], to.number[2], to.number[3]);
  return to;
}

TALUS_INLINE Vector3<Vec8> vector_of(const EightRows &rows)
{
  return {rows.number[0], rows.number[1], rows.number[2]};
}

/// One of rows of three, by place of a particle.
TALUS_INLINE Vec4 row_at(const double *rows, int place)
{
  return record_of(rows + 3 * static_cast<std::int64_t>(place), 0.0);
}

/// Those of the first particles less those of the second ones.
TALUS_INLINE Vector3<Vec8> differences(const double *rows, const BondEnds *ends)
{
  return vector_of(
      lanes_of([=](int k) { return row_at(rows, ends[k].first) - row_at(rows, ends[k].second); }));
}

}    // namespace Talus

#endif
