// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/deferred_forces.h"

namespace Talus {

void DeferredForces::make_room(std::size_t wanted, const ParticleRecords &particles)
{
  const std::size_t couples = particles.couple.empty() ? 0 : wanted;
  if (notes.size() == wanted && stride == particles.stride && couple.size() == couples) return;
  stride = particles.stride;
  clear();
  renew(notes, wanted);
  renew(load, stride * wanted);
  renew(couple, couples);
}

std::size_t DeferredForces::add_before(PairOfSlots limit, std::size_t begin, SlotRange range,
                                       ParticleRecords &particles) const
{
  std::size_t n = begin;
  for (; n < noted && notes[n].pair < limit; n++) {
    if (!range.holds(notes[n].slot)) continue;
    const ContactLoad its{load4(load[stride * n]),
                          stride == 2 ? load4(load[stride * n + 1]) : Vec4{},
                          couple.empty() ? Vec4{} : load4(couple[n])};
    its.add_to(particles, notes[n].slot);
  }
  return n;
}

void DeferredForces::add_both(const DeferredForces &early, const DeferredForces &late,
                              SlotRange range, ParticleRecords &particles)
{
  std::size_t of_early = 0, of_late = 0;
  while (of_late < late.noted) {
    const PairOfSlots next = late.notes[of_late].pair;
    of_early = early.add_before(next, of_early, range, particles);
    const PairOfSlots end = of_early < early.noted ? early.notes[of_early].pair : after_all_pairs;
    of_late = late.add_before(end, of_late, range, particles);
  }
  early.add_before(after_all_pairs, of_early, range, particles);
}

double DeferredForces::memory_usage() const
{
  return static_cast<double>(sizeof(Note) * notes.capacity() +
                             sizeof(Record) * (load.capacity() + couple.capacity()));
}

}    // namespace Talus
