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

struct alignas(32) ChangeRecord {
  float c[8];

  /// In messages: that many doubles, of any content.
  static constexpr int doubles = 4;
};
static_assert(sizeof(ChangeRecord) == ChangeRecord::doubles * sizeof(double));

TALUS_INLINE Float8 load8(const ChangeRecord &record)
{
  return Memory<Float8>::load(record.c);
}

/// The fourth numbers must be 0.
TALUS_INLINE Float8 change_of(Vec4 velocity, Vec4 rotation)
{
  return join(to_floats(velocity), to_floats(rotation));
}

/// From what a kick has changed: records of velocities and angular velocities before and after it,
/// whose fourth numbers are finite and the same. `extrapolation`: see RecordStep.
TALUS_INLINE Float8 change_by_kick(double extrapolation, double radius, Vec4 v_old, Vec4 v,
                                   Vec4 w_old, Vec4 w)
{
  return change_of(extrapolation * (v - v_old), radius * (extrapolation * (w - w_old)));
}

TALUS_INLINE void store(ChangeRecord &record, Float8 value)
{
  store(record.c, value);
}

/// See stream() of records.
TALUS_INLINE void stream(ChangeRecord &record, Float8 value)
{
  stream(record.c, value);
}

/// What the contact of i with j sees: the difference of the velocities of their centers, the sum of
/// those of their surfaces.
TALUS_INLINE Float8 change_of_contact(const ChangeRecord &i, const ChangeRecord &j)
{
  const Float8 difference_and_sum =
      join(Float4{-1.0F, -1.0F, -1.0F, 0.0F}, Float4{1.0F, 1.0F, 1.0F, 0.0F});
  return load8(i) + difference_and_sum * load8(j);
}

/// Four rows become lanes k ... k+3 of two vectors.
template <int width>
TALUS_INLINE void to_lanes(const Float8 (&row)[4], double (*velocity)[width],
                           double (*rotation)[width], int k)
{
  Float8 v[4] = {row[0], row[1], row[2], row[3]};
  transpose(v[0], v[1], v[2], v[3]);
  for (int d = 0; d < 3; d++) {
    store(&velocity[d][k], to_doubles(low_half(v[d])));
    store(&rotation[d][k], to_doubles(high_half(v[d])));
  }
}

}    // namespace Talus

#endif
