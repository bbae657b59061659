// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A record is four doubles in one aligned 32-byte block, so that whatever a contact needs of a
// particle arrives with one load. The kinds (SI units or any consistent set):
//
//   position record  { x, y, z, r }                      length
//   velocity record  { vx, vy, vz, 1/m }                 velocity, 1/mass
//   omega record      { wx, wy, wz, 1/r }                 1/time, 1/length
//   history record   { ... }                             see HistoryLayout: of most laws the first
//                                                        one is dx, dy, dz (length), at limit
//   force record     { x, y, z, 0 or 1 }                 see ParticleRecords::settle_torque()
//   torque per radius { x, y, z, unused } force; torque = -r times it
//   twisting torque  { x, y, z, unused }
//
// The fourth entries of the first three are chosen such that the sum of two records gives what a
// pair needs: r_i + r_j, 1/m_eff and 1/R_eff. A particle of infinite mass has 1/m = 0.

#ifndef TALUS_PARTICLES_RECORD_H
#define TALUS_PARTICLES_RECORD_H

#include "base/simd.h"

namespace Talus {

struct alignas(32) Record {
  double c[4];
};

inline Vec4 load4(const Record &record)
{
  return load4(record.c);
}
inline void store(Record &record, Vec4 value)
{
  store(record.c, value);
}
TALUS_INLINE void stream(Record &record, Vec4 value)
{
  stream(record.c, value);
}

/// The number in the fourth place of a record, four times.
TALUS_INLINE Vec4 fourth_of(Vec4 record)
{
  return shuffle<3, 3, 3, 3>(record, record);
}
TALUS_INLINE Vec4 clear_fourth(Vec4 record)
{
  return shuffle<0, 1, 2, 4>(record, Vec4{});
}

/// Three doubles of a row of LAMMPS and a fourth number, and back. (Number by number: std::copy
/// would call a function.)
TALUS_INLINE Vec4 record_of(const double *row, double fourth)
{
  return four(row[0], row[1], row[2], fourth);
}
TALUS_INLINE void write_row(Vec4 from, double *row)
{
  for (int d = 0; d < 3; d++) row[d] = from[d];
}

/// The history of a contact as its other body sees it.
inline Record mirrored(const Record &history)
{
  return {{-history.c[0], -history.c[1], -history.c[2], history.c[3]}};
}

}    // namespace Talus

#endif
