// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Histories of the contacts of particles with one large body. Few particles are near a body, so
// only its candidates have room for histories: slots side by side in the order of the candidates,
// which is that in which a step reads and writes them. A candidate has as many slots as it may have
// contacts at the same time; where that is one, its slot has its own number. Every particle (host's
// index) has but a number that leads to its candidate: with it histories follow their particles to
// other places, ranks and restart files.
//
//   particles are renumbered   copy(), forget(), pack(), unpack()
//   new candidates             follow()
//   every step                 touching() or continue_contacts(), then record() and impact()
//
// Slots of different candidates may be used by different threads at the same time.

#ifndef TALUS_BODY_CONTACT_BODY_HISTORY_H
#define TALUS_BODY_CONTACT_BODY_HISTORY_H

#include "base/aligned_vector.h"
#include "body/shape/large_body_shape.h"
#include "particles/record.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace Talus {

class BodyHistory {
 public:
  /// `several`: a particle may have more than one contact with the body. `impacts`: impact records
  /// are kept as well, see record.h; `normals`: what replace_normal() asks for, without several.
  /// Call before anything is stored.
  void keep(bool several, bool impacts, bool normals = false)
  {
    with_several = several;
    with_impact = impacts;
    with_normals = several || normals;
  }

  /// Later: laws of second order remember more than those that a body was defined with. Impacts of
  /// contacts that are stored already are zero.
  void keep_impacts()
  {
    with_impact = true;
    impacts.resize(records.size(), Record{});
  }

  void grow(int num_particles) { entry_of.resize(num_particles, nowhere); }
  void copy(int from, int to) { entry_of[to] = entry_of[from]; }
  void forget(int particle) { entry_of[particle] = nowhere; }

  /// For migration and restart: the number of contacts, then of each its normal (if kept),
  /// history and impact. Return the number of doubles.
  static constexpr int size_contact = 11;
  static constexpr int max_packed = 1 + LargeBodyShape::max_contacts * size_contact;
  int pack(int particle, double *buf) const;
  int unpack(int particle, const double *buf);
  int size_packed(int particle) const { return 1 + size_contact * count(particle); }

  /// From now on slots are those of these particles, in this order; particles that are not among
  /// them have lost theirs. `room`: of each, how many contacts it may have; not asked for without
  /// several().
  void follow(const std::vector<int> &candidates, const std::vector<std::uint8_t> &room);

  bool several() const { return with_several; }
  bool keeps_impacts() const { return with_impact; }
  /// First slot of a candidate.
  std::uint32_t first_slot(std::size_t candidate) const
  {
    return with_several ? first[candidate] : static_cast<std::uint32_t>(candidate);
  }
  /// Zero where a contact is new.
  Record &record(std::size_t slot) { return records[slot]; }
  Record &impact(std::size_t slot) { return impacts[slot]; }

  /// Without several(): which of the candidates 8 block ... 8 block + 7 touch now, of those whose
  /// bits are set in `asked`. Histories of those that did and do no longer are forgotten.
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

  /// With several(): the contacts that a candidate has now; slot k of it is that of found[k]. A
  /// contact continues that with the nearest normal, in the frame of the body: from one step to the
  /// next it turns by far less than the angle between two contacts. Contacts without overlap that
  /// continue none are taken out of `found`; returns how many are left, and leaves room for
  /// LargeBodyShape::max_contacts. `before`: nullptr, or receives the normals that they had, zero of
  /// new ones. `ends`: of laws of second order, whose contacts last for the step in which they end.
  class Ends {
   public:
    /// Whether a contact with this history goes on without overlap.
    virtual bool lasts(const Record &history) const = 0;
    /// As LargeBodyShape::find_contacts(), also of what is a little further away, with overlaps below
    /// zero. Called only where a contact has ended.
    virtual int look_further(SurfaceContact *found) const = 0;

   protected:
    ~Ends() = default;
  };
  int continue_contacts(std::size_t candidate, SurfaceContact *found, int count,
                        Vector3<double> *before = nullptr, const Ends *ends = nullptr);

  /// Without several(), and if asked for: stores the normal of a contact, in the frame of the body,
  /// and returns the one before it, zero of a new one.
  bool keeps_normals() const { return with_normals; }
  Vector3<double> replace_normal(std::size_t slot, const Vector3<double> &now)
  {
    return std::exchange(normals[slot], now);
  }
  /// Where they were not stored in every step.
  void forget_normals()
  {
    if (!with_several) std::fill(normals.begin(), normals.end(), Vector3<double>{0.0, 0.0, 0.0});
  }

  /// Contacts of a particle, and history of the first; zero if it has none.
  int count(int particle) const;
  Record of_particle(int particle) const;

  double memory_usage() const;

 private:
  static constexpr int nowhere = -1;
  struct Contact {
    Vector3<double> normal;
    Record history, impact;
  };
  int count_of_entry(std::size_t entry) const;
  Contact contact_at(std::size_t slot) const;
  struct Known;
  void put(std::size_t slot, const Contact &contact);
  void resize_slots(std::size_t n);
  void clear(std::size_t block, unsigned separated);

  bool with_several = false, with_impact = false, with_normals = false;
  std::size_t num_candidates = 0;
  std::vector<int> entry_of;    // by particle: its candidate, or what came since, behind those
  // by entry, only with several contacts: first slot, contacts
  std::vector<std::uint32_t> first;
  std::vector<std::uint8_t> counts;
  // by slot: history; impact, or empty; normal, or empty
  AlignedVector<Record> records, impacts;
  std::vector<Vector3<double>> normals;
  // one bit for each candidate, only with one contact: its record may not be zero
  std::vector<std::atomic<std::uint8_t>> touching;
};

}    // namespace Talus

#endif
