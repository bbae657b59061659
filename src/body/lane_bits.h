// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Choosing among eight lanes by bits: which of them, and those alone side by side.

#ifndef TALUS_BODY_LANE_BITS_H
#define TALUS_BODY_LANE_BITS_H

#include "contact/simd.h"

namespace Talus {

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
