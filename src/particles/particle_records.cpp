// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "particles/particle_records.h"

#include <algorithm>
#include <cstring>

namespace Talus {
namespace {

inline void add_to_row(double *row, Vec4 value)
{
  for (int d = 0; d < 3; d++) row[d] += value[d];
}

}    // namespace

void ParticleRecords::resize(std::size_t n, bool rotation, bool twisting_torques,
                             std::size_t copies, bool changes, bool heat)
{
  stride = rotation ? 2 : 1;
  renew(position, n + copies);
  renew(motion, stride * (n + copies));
  renew(change, changes ? n + copies : 0);
  renew(load, stride * n);
  acted.assign(n, 1);
  renew(twisting_torque, twisting_torques ? n : 0);
  renew(heat_flow, heat ? n : 0);
}

void ParticleRecords::keep_changes(bool yes)
{
  if (yes == keeps_changes()) return;
  renew(change, yes ? position.size() : 0);
  std::fill(change.begin(), change.end(), ChangeRecord{});
}

void ParticleRecords::release_sums()
{
  for (AlignedVector<Record> *records : {&load, &twisting_torque}) release(*records);
  release(heat_flow);
}

/* Eight particles at a time, for the sake of the divisions. */

void ParticleRecords::read(const ParticleOrder &order, const ParticleView &arrays,
                           const SlotChoice &slots)
{
  slots.in_groups([&](const int *slot, int count) { read_eight(order, arrays, slot, count); });
}

inline void ParticleRecords::read_eight(const ParticleOrder &order, const ParticleView &arrays,
                                        const int *slots, int count)
{
  alignas(64) double inverse_mass[lanes], inverse_radius[lanes];
  for (int k = 0; k < lanes; k++) {
    const int a = order.atom_of_slot[slots[std::min(k, count - 1)]];
    const bool replaced = arrays.mass_override && arrays.mass_override[a] > 0.0;
    inverse_mass[k] = replaced ? arrays.mass_override[a] : arrays.mass[a];
    inverse_radius[k] = arrays.radius[a];
  }
  store(inverse_mass, splat<Vec8>(1.0) / load8(inverse_mass));
  store(inverse_radius, splat<Vec8>(1.0) / load8(inverse_radius));

  for (int k = 0; k < count; k++) {
    const std::size_t s = slots[k];
    const std::int64_t a = 3L * order.atom_of_slot[s];
    store(position[s], record_of(arrays.x + a, arrays.radius[order.atom_of_slot[s]]));
    store(motion[stride * s], record_of(arrays.v + a, inverse_mass[k]));
    if (stride == 2) store(motion[2 * s + 1], record_of(arrays.omega + a, inverse_radius[k]));
    if (keeps_changes()) change[s] = arrays.change[order.atom_of_slot[s]];
    begin_sums(s, load4(motion[stride * s]));
  }
}

void ParticleRecords::set_gravity(const double *acceleration)
{
  const Record before = gravity;
  gravity = Record{};
  if (acceleration) std::copy(acceleration, acceleration + 3, gravity.c);
  has_gravity = gravity.c[0] != 0.0 || gravity.c[1] != 0.0 || gravity.c[2] != 0.0;
  if (!std::equal(gravity.c, gravity.c + 3, before.c)) std::fill(acted.begin(), acted.end(), 1);
}

void ParticleRecords::add_to(const ParticleOrder &order, const ParticleView &arrays, int begin,
                             int end) const
{
  const bool rotation = stride == 2;
  for (int s = begin; s < end; s++) {
    const int a = order.atom_of_slot[s];
    if (!order.is_owned(a)) continue;
    add_to_row(arrays.f + 3L * a, load4(load[stride * s]));
    if (rotation) add_to_row(arrays.torque + 3L * a, torque(s));
  }
  add_heat_to(order, arrays, begin, end);
}

void ParticleRecords::add_heat_to(const ParticleOrder &order, const ParticleView &arrays, int begin,
                                  int end) const
{
  if (!arrays.heat_flow) return;
  for (int s = begin; s < end; s++)
    if (const int a = order.atom_of_slot[s]; order.is_owned(a)) arrays.heat_flow[a] += heat_flow[s];
}

double ParticleRecords::memory_usage() const
{
  return static_cast<double>(sizeof(Record) * (position.capacity() + motion.capacity() +
                                               load.capacity() + twisting_torque.capacity()) +
                             sizeof(ChangeRecord) * change.capacity() +
                             sizeof(double) * heat_flow.capacity());
}

}    // namespace Talus
