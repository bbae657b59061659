// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/outgoing_forces.h"

namespace Talus {

void OutgoingForces::make_room(std::size_t contacts, const ParticleRecords &particles)
{
  const std::size_t couples = particles.couple.empty() ? 0 : contacts;
  if (slots.size() == contacts && stride == particles.stride && couple.size() == couples) return;
  stride = particles.stride;
  clear();
  renew(slots, contacts);
  renew(load, stride * contacts);
  renew(couple, couples);
}

void OutgoingForces::add_to(ParticleRecords &particles, ParticleOrder::Range range) const
{
  const auto add = [](Record &sum, const Record &one) { store(sum, load4(sum) + load4(one)); };
  for (std::size_t n = 0; n < noted; n++) {
    const std::size_t s = slots[n];
    if (slots[n] < range.begin || slots[n] >= range.end) continue;
    for (std::size_t k = 0; k < stride; k++)
      add(particles.load[stride * s + k], load[stride * n + k]);
    if (!couple.empty()) add(particles.couple[s], couple[n]);
  }
}

double OutgoingForces::memory_usage() const
{
  return static_cast<double>(sizeof(int) * slots.capacity() +
                             sizeof(Record) * (load.capacity() + couple.capacity()));
}

}    // namespace Talus
