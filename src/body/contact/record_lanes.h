// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Between records and eight lanes, and choosing among lanes by bits.

#ifndef TALUS_BODY_CONTACT_RECORD_LANES_H
#define TALUS_BODY_CONTACT_RECORD_LANES_H

#include "particles/record.h"

namespace Talus {

/// The numbers of eight records by lane: those of `record(k)`, k = 0 ... 7, become lane k.
struct EightRecords {
  Vec8 number[4];
};
template <class Which> TALUS_INLINE EightRecords to_lanes(Which record)
{
  EightRecords to;
#if defined(__AVX512F__)
  for (int k = 0; k < 4; k++) to.number[k] = join(load4(record(k)), load4(record(k + 4)));
  transpose(to.number[0], to.number[1], to.number[2], to.number[3]);
#else
  for (int k = 0; k < lanes; k += 4) {
    Vec4 rows[4];
    for (int q = 0; q < 4; q++) rows[q] = load4(record(k + q));
    transpose(rows[0], rows[1], rows[2], rows[3]);
    for (int q = 0; q < 4; q++) store(reinterpret_cast<double *>(&to.number[q]) + k, rows[q]);
  }
#endif
  return to;
}

/// The reverse.
TALUS_INLINE void to_records(EightRecords from, Record *records)
{
#if defined(__AVX512F__)
  Vec8 *const v = from.number;
  transpose(v[0], v[1], v[2], v[3]);
  for (int k = 0; k < 4; k++) {
    store(records[k], __builtin_shufflevector(v[k], v[k], 0, 1, 2, 3));
    store(records[k + 4], __builtin_shufflevector(v[k], v[k], 4, 5, 6, 7));
  }
#else
  for (int k = 0; k < lanes; k += 4) {
    Vec4 rows[4];
    for (int q = 0; q < 4; q++)
      rows[q] = load4(reinterpret_cast<const double *>(&from.number[q]) + k);
    transpose(rows[0], rows[1], rows[2], rows[3]);
    for (int q = 0; q < 4; q++) store(records[k + q], rows[q]);
  }
#endif
}

/// One bit for each lane: set where a < b.
TALUS_INLINE unsigned bits_of_less(Vec8 a, Vec8 b)
{
#if defined(__AVX512F__)
  return less_bits(a, b);
#else
  alignas(64) double of_a[lanes], of_b[lanes];
  store(of_a, a);
  store(of_b, b);
  return less_bits(load4(of_a), load4(of_b)) | less_bits(load4(of_a + 4), load4(of_b + 4)) << 4;
#endif
}

/// The lanes of `from` whose bits are set, in a row that begins at `to`; eight places are written
/// in any case, since nobody could foresee a branch. `from` is aligned, `to` need not be.
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
