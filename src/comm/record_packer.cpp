// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "comm/record_packer.h"

#include "particles/particle_records.h"

#include <algorithm>

using namespace Talus;

namespace {
constexpr int ahead = 8;    // slots that are called into the cache: they stand far from each other

inline void copy_row(const double *from, double *to)
{
  for (int d = 0; d < 3; d++) to[d] = from[d];
}
}    // namespace

void RecordPacker::set(ParticleRecords &where, const int *slot_of_atom)
{
  records = &where;
  slots = slot_of_atom;
}

int RecordPacker::stride() const
{
  return records->stride == 2 ? 9 : 6;
}

void RecordPacker::pack(const int *particles, int count, double *out)
{
  const bool spins = records->stride == 2;
  for (int k = 0; k < count; k++) {
    records->call(slots[particles[std::min(k + ahead, count - 1)]]);
    const int s = slots[particles[k]];
    copy_row(records->position[s].c, out);
    copy_row(records->velocity(s).c, out + 3);
    if (spins) copy_row(records->spin(s).c, out + 6);
    out += spins ? 9 : 6;
  }
}

/* The same additions as SpherePacker's, so the same bits. The fourth numbers, radius and inverses
   of mass and radius, do not change between rebuilds. */

void RecordPacker::unpack(const ProxyRun &run, const int *places, const double *message)
{
  const bool spins = records->stride == 2;
  const std::size_t width = spins ? 9 : 6;
  const auto &steps = shifts.of(run.shift);
  for (int k = 0; k < run.count; k++) {
    records->call(slots[run.first + std::min(k + ahead, run.count - 1)]);
    const int s = slots[run.first + k];
    const double *in = message + width * places[k];
    double *x = records->position[s].c;
    copy_row(in, x);
    copy_row(in + 3, records->motion[records->stride * s].c);
    if (spins) copy_row(in + 6, records->motion[records->stride * s + 1].c);
    for (const auto &step : steps)
      for (int d = 0; d < 3; d++) x[d] += step[d];
  }
}
