// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Conversion between rows of four numbers, as particles and histories are stored, and SIMD lanes,
// one for each contact, as they are computed; and selection of lanes by bits. A row is whatever
// load4() and store() know, for example a Record.

#ifndef TALUS_BASE_LANES_H
#define TALUS_BASE_LANES_H

#include "base/simd.h"

namespace Talus {

/// Four rows become lanes k ... k+3 of a vector and of a scalar, if this is not nullptr.
template <int width>
inline void to_lanes(Vec4 *rows, double (*vector)[width], double *fourth, int k)
{
  transpose(rows[0], rows[1], rows[2], rows[3]);
  for (int q = 0; q < 3; q++) store(&vector[q][k], rows[q]);
  if (fourth) store(&fourth[k], rows[3]);
}

/// Lanes k ... k+3 become the rows where(0) ... where(3); without a scalar the fourth number is 0.
template <int width, class Where>
inline void to_rows(const double (*vector)[width], const double *fourth, int k, Where where)
{
  Vec4 rows[4];
  for (int q = 0; q < 3; q++) rows[q] = load4(&vector[q][k]);
  rows[3] = fourth ? load4(&fourth[k]) : Vec4{};
  transpose(rows[0], rows[1], rows[2], rows[3]);
  for (int q = 0; q < 4; q++) store(where(q), rows[q]);
}

/// The numbers of eight rows by lane: those of `row(k)`, k = 0 ... 7, become lane k.
struct EightRows {
  Vec8 number[4];
};
/// The same where row(k) is a Vec4.
template <class Row> TALUS_INLINE EightRows lanes_of(Row row)
{
  EightRows to;
  for (int k = 0; k < 4; k++) to.number[k] = join(row(k), row(k + 4));
  transpose(to.number[0], to.number[1], to.number[2], to.number[3]);
  return to;
}
template <class Which> TALUS_INLINE EightRows to_lanes(Which row)
{
  return lanes_of([row](int k) { return load4(row(k)); });
}

/// The reverse: lane k becomes rows[k].
template <class Row> TALUS_INLINE void to_rows(EightRows from, Row *rows)
{
  Vec8 *const v = from.number;
  transpose(v[0], v[1], v[2], v[3]);
  for (int k = 0; k < 4; k++) {
    store(rows[k], low_half(v[k]));
    store(rows[k + 4], high_half(v[k]));
  }
}

/// The lanes of `from` whose bits are set, in a row that begins at `to`; eight places are written
/// in any case, since a branch would be mispredicted. `from` is aligned, `to` need not be.
TALUS_INLINE void pack_lanes(double *to, const double *from, unsigned bits)
{
#if defined(__AVX512F__)
  const __m512d all = _mm512_load_pd(from);
  _mm512_storeu_pd(to, _mm512_maskz_compress_pd(static_cast<__mmask8>(bits), all));
#else
  int count = 0;
  for (int k = 0; k < lanes; k++) {
    to[count] = from[k];
    count += static_cast<int>(bits >> k & 1U);
  }
#endif
}

}    // namespace Talus

#endif
