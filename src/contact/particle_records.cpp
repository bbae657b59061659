// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/particle_records.h"

#include <algorithm>
#include <cstring>

namespace Talus {
namespace {

/// Three doubles of a row and a fourth number.
inline Vec4 record_of(const double *row, double fourth)
{
  return Vec4{row[0], row[1], row[2], fourth};
}

inline void add_to_row(double *row, Vec4 value)
{
  for (int d = 0; d < 3; d++) row[d] += value[d];
}

}    // namespace

void ParticleRecords::resize(int n, int spare, bool spins, bool couples)
{
  stride = spins ? 2 : 1;
  const std::size_t slots = static_cast<std::size_t>(n) + spare;
  position.resize(n);
  motion.resize(stride * n);
  load.resize(stride * slots);
  couple.resize(couples ? slots : 0);
}

/* Eight particles at a time, for the sake of the divisions. */

void ParticleRecords::read(const ParticleOrder &order, const ParticleView &host, int begin, int end,
                           Which which)
{
  const bool spins = stride == 2;
  const Vec4 zero{};
  for (int base = begin; base < end; base += lanes) {
    const int count = std::min(lanes, end - base);
    alignas(64) double inverse_mass[lanes], inverse_radius[lanes];
    for (int k = 0; k < lanes; k++) {
      const int a = order.atom_of_slot[base + std::min(k, count - 1)];
      const bool replaced = host.mass_override && host.mass_override[a] > 0.0;
      inverse_mass[k] = replaced ? host.mass_override[a] : host.mass[a];
      inverse_radius[k] = host.radius[a];
    }
    store(inverse_mass, splat<Vec8>(1.0) / load8(inverse_mass));
    store(inverse_radius, splat<Vec8>(1.0) / load8(inverse_radius));

    for (int k = 0; k < count; k++) {
      const int s = base + k, a = order.atom_of_slot[s];
      if (which != Which::ALL && (which == Which::OWNED) != order.is_owned(a)) continue;
      const double r = host.radius[a];
      Record *moves = &motion[stride * s], *loads = &load[stride * s];
      store(position[s], record_of(host.x + 3L * a, r));
      store(moves[0], record_of(host.v + 3L * a, inverse_mass[k]));
      store(loads[0], zero);
      if (!couple.empty()) store(couple[s], zero);
      if (!spins) continue;
      const double *w = host.omega + 3L * a;
      store(moves[1], Vec4{r * w[0], r * w[1], r * w[2], inverse_radius[k]});
      store(loads[1], zero);
    }
  }
}

void ParticleRecords::add_to(const ParticleOrder &order, const ParticleView &host, int begin,
                             int end) const
{
  const bool spins = stride == 2;
  for (int s = begin; s < end; s++) {
    const int a = order.atom_of_slot[s];
    if (!order.is_owned(a)) continue;
    const Record *loads = &load[stride * s];
    add_to_row(host.f + 3L * a, load4(loads[0]));
    if (!spins) continue;
    double *torque = host.torque + 3L * a;
    add_to_row(torque, -position[s].c[3] * load4(loads[1]));
    if (!couple.empty()) add_to_row(torque, load4(couple[s]));
  }
}

double ParticleRecords::memory_usage() const
{
  return static_cast<double>(sizeof(Record) * (position.capacity() + motion.capacity() +
                                               load.capacity() + couple.capacity()));
}

}    // namespace Talus
