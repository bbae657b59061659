// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Histories of the contacts with a body that touches a particle at one point at most. Few particles
// are near a body, so records exist only for its candidates, side by side in their order: that in
// which a step reads and writes them. Every particle (host's index) has but a number that leads to
// its record: with it histories follow their particles to other places, ranks and restart files.
//
//   particles are renumbered   copy(), forget(), pack(), unpack()
//   new candidates             follow()
//   every step                 record(), impact(), set_touching()

#ifndef TALUS_BODY_CONTACT_SPARSE_HISTORY_H
#define TALUS_BODY_CONTACT_SPARSE_HISTORY_H

#include "base/aligned_vector.h"
#include "particles/record.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace Talus {

class SparseHistory {
 public:
  /// Whether impact records are kept as well, see record.h. Call before anything is stored.
  void keep_impacts(bool yes) { with_impact = yes; }

  void grow(int num_particles) { place.resize(num_particles, nowhere); }
  void copy(int from, int to) { place[to] = place[from]; }
  void forget(int particle) { place[particle] = nowhere; }

  /// For migration and restart: history, and impact if kept. Return the number of doubles.
  int pack(int particle, double *buf) const;
  int unpack(int particle, const double *buf);
  int size_packed() const { return with_impact ? 8 : 4; }

  /// From now on records are those of these particles, in this order; particles that are not among
  /// them have lost theirs.
  void follow(const std::vector<int> &candidates);

  /// Of a candidate, by its place in the list: zero unless it touches.
  Record &record(std::size_t candidate) { return records[candidate]; }
  Record &impact(std::size_t candidate) { return impacts[candidate]; }

  /// Which of the candidates 8 block ... 8 block + 7 touch now, of those whose bits are set in
  /// `asked`: the histories of those that did and do no longer are forgotten. Different candidates
  /// may be set at the same time.
  void set_touching(std::size_t block, unsigned asked, unsigned bits)
  {
    std::atomic<std::uint8_t> &its = touching[block];
    const unsigned changed = (its.load(std::memory_order_relaxed) & asked) ^ bits;
    if (!changed) return;
    if (const unsigned separated = changed & ~bits) clear(block, separated);
    its.fetch_xor(static_cast<std::uint8_t>(changed), std::memory_order_relaxed);
  }

  /// Bits of the candidates of a block that touched when last looked at; 0 beyond the end.
  unsigned touched(std::size_t block) const
  {
    return block < touching.size() ? touching[block].load(std::memory_order_relaxed) : 0;
  }

  /// Of a particle; zero if it has none.
  Record of_particle(int particle) const;

  double memory_usage() const;

 private:
  void clear(std::size_t block, unsigned separated);

  static constexpr int nowhere = -1;
  bool with_impact = false;
  std::vector<int> place;           // by particle: index of its record
  AlignedVector<Record> records;    // of the candidates, then of particles that came since
  AlignedVector<Record> impacts;    // the same, or empty
  // one bit for each candidate: its record may not be zero
  std::vector<std::atomic<std::uint8_t>> touching;
};

}    // namespace Talus

#endif
