// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How the velocities of a particle change in the time by which they are behind positions, in one
// block of 32 bytes:
//
//   change record    { dvx, dvy, dvz, 0, r dwx, r dwy, r dwz, 0 }    velocity
//
// in single precision: as a correction it is itself of first order in the time step, and its
// rounding adds 6e-8 of it. Owners and proxies find the same bits, from the same velocities.

#ifndef TALUS_PARTICLES_CHANGE_RECORD_H
#define TALUS_PARTICLES_CHANGE_RECORD_H

#include "base/simd.h"

namespace Talus {

typedef float Float4 __attribute__((vector_size(16)));
typedef float Float8 __attribute__((vector_size(32)));

struct alignas(32) ChangeRecord {
  float c[8];

  /// In messages: that many doubles, of any content.
  static constexpr int doubles = 4;
};
static_assert(sizeof(ChangeRecord) == ChangeRecord::doubles * sizeof(double));

struct ChangeMemory {
  typedef Float8 Overlay __attribute__((may_alias));
};

TALUS_INLINE Float8 load8(const ChangeRecord &record)
{
  return *reinterpret_cast<const ChangeMemory::Overlay *>(record.c);
}

/// The fourth numbers must be 0.
TALUS_INLINE Float8 change_of(Vec4 velocity, Vec4 rotation)
{
  return __builtin_shufflevector(__builtin_convertvector(velocity, Float4),
                                 __builtin_convertvector(rotation, Float4), 0, 1, 2, 3, 4, 5, 6, 7);
}

TALUS_INLINE void store(ChangeRecord &record, Float8 value)
{
  *reinterpret_cast<ChangeMemory::Overlay *>(record.c) = value;
}

/// See stream() of records.
TALUS_INLINE void stream(ChangeRecord &record, Float8 value)
{
#if defined(__AVX__)
  _mm256_stream_ps(record.c, (__m256) value);
#else
  store(record, value);
#endif
}

/// What the contact of i with j sees: the difference of the velocities of their centers, the sum of
/// those of their surfaces.
TALUS_INLINE Float8 change_of_contact(const ChangeRecord &i, const ChangeRecord &j)
{
  constexpr Float8 difference_and_sum{-1.0F, -1.0F, -1.0F, 0.0F, 1.0F, 1.0F, 1.0F, 0.0F};
  return load8(i) + difference_and_sum * load8(j);
}

/// Four rows become lanes k ... k+3 of two vectors.
template <int width>
TALUS_INLINE void to_lanes(const Float8 (&row)[4], double (*velocity)[width],
                           double (*rotation)[width], int k)
{
  // two matrices of 4 x 4 side by side
  const Float8 ab_low = __builtin_shufflevector(row[0], row[1], 0, 8, 1, 9, 4, 12, 5, 13);
  const Float8 ab_high = __builtin_shufflevector(row[0], row[1], 2, 10, 3, 11, 6, 14, 7, 15);
  const Float8 cd_low = __builtin_shufflevector(row[2], row[3], 0, 8, 1, 9, 4, 12, 5, 13);
  const Float8 cd_high = __builtin_shufflevector(row[2], row[3], 2, 10, 3, 11, 6, 14, 7, 15);
  const Float8 component[3] = {__builtin_shufflevector(ab_low, cd_low, 0, 1, 8, 9, 4, 5, 12, 13),
                               __builtin_shufflevector(ab_low, cd_low, 2, 3, 10, 11, 6, 7, 14, 15),
                               __builtin_shufflevector(ab_high, cd_high, 0, 1, 8, 9, 4, 5, 12, 13)};
  for (int d = 0; d < 3; d++) {
    const Float8 of = component[d];
    store(&velocity[d][k],
          __builtin_convertvector(__builtin_shufflevector(of, of, 0, 1, 2, 3), Vec4));
    store(&rotation[d][k],
          __builtin_convertvector(__builtin_shufflevector(of, of, 4, 5, 6, 7), Vec4));
  }
}

}    // namespace Talus

#endif
