// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Histories of the contacts of particles with one large body or wall. Few particles are near it, so
// only its candidates have room for histories: slots side by side in the order of the candidates,
// which is that in which a step reads and writes them. A candidate has as many slots as it may have
// contacts at the same time; where that is one, its slot has its own number. While particles get other
// indices histories rest in ContactMemory.
//
//   candidates are known       follow()
//   every step                 begin_step(), set_touching() or continue_contacts(), then record()
//
// Slots of different candidates may be used by different threads at the same time.

#ifndef TALUS_BODY_CONTACT_BODY_HISTORY_H
#define TALUS_BODY_CONTACT_BODY_HISTORY_H

#include "base/aligned_vector.h"
#include "body/shape/large_body_shape.h"
#include "history/contact_memory.h"
#include "history/history_rows.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace Talus {

class BodyHistory : public ContactMemory::Holder {
 public:
  BodyHistory() { keep_records(HistoryRows::most_records); }    // laws are not known yet
  ~BodyHistory();
  BodyHistory(const BodyHistory &) = delete;
  BodyHistory &operator=(const BodyHistory &) = delete;

  /// `several`: a particle may have more than one contact with the body. `normals`: what
  /// replace_normal() asks for, without several. Call before anything is stored.
  void keep(bool several, bool normals = false)
  {
    with_several = several;
    with_normals = several || normals;
  }
  /// Contacts are known by the parts that they touch, as those of walls of LAMMPS.
  void keep_parts(bool several)
  {
    with_several = several;
    with_parts = true;
  }
  /// Of each contact from now on, see HistoryRows::keep().
  void keep_records(int records);

  /// They are those of the partner with this name, see ContactMemory::name_of(): of each its normal, zero if
  /// it is not kept, and its history. Without a memory they are lost when particles get other indices.
  void rest_in(ContactMemory &memory, std::int64_t partner);
  /// No longer; what is at rest is dropped.
  void leave_memory();
  bool has_memory() const { return memory != nullptr; }
  /// One that is to be kept there.
  void add(ContactLists &to, int particle, std::uint64_t feature, const Vector3<double> &normal,
           const HistoryValues &values) const;
  /// The history of one that is.
  static HistoryValues values_of(const ContactLists::Contact &one);

  /// From now on slots are those of these particles, in this order; particles that are not among
  /// them have lost theirs. `room`: of each, how many contacts it may have; not asked for without
  /// several().
  void follow(const std::vector<int> &candidates, const std::vector<std::uint8_t> &room);
  /// Of the first `owned` ones: those with contacts, ascending.
  std::vector<int> particles_in_contact(int owned) const;

  // ContactMemory::Holder
  bool owns(const ContactLists::Contact &one) const override
  {
    return one.partner == name && !(one.feature & ContactLists::of_shape);
  }
  void put_aside(ContactLists &to) override;

  /// Before the histories of candidates change.
  void begin_step()
  {
    if (rests()) memory->are_taken(*this);
  }

  bool several() const { return with_several; }
  bool by_parts() const { return with_parts; }
  int num_records() const { return rows.records(); }
  /// First slot of a candidate.
  std::uint32_t first_slot(std::size_t candidate) const
  {
    return with_several ? first[candidate] : static_cast<std::uint32_t>(candidate);
  }
  /// Zero where a contact is new.
  Record &record(std::size_t slot, int k = 0) { return rows.record(slot, k); }
  HistoryValues values(std::size_t slot) const { return rows.values(slot); }
  void set_values(std::size_t slot, const HistoryValues &values) { rows.set_values(slot, values); }

  /// Without several(): which of the candidates 8 block ... 8 block + 7 touch now, of those whose
  /// bits are set in `asked`. Histories of those that touched and no longer do are cleared.
  void set_touching(std::size_t block, unsigned asked, unsigned bits)
  {
    std::atomic<std::uint8_t> &touching_bits = touching[block];
    const unsigned changed = (touching_bits.load(std::memory_order_relaxed) & asked) ^ bits;
    if (!changed) return;
    if (const unsigned separated = changed & ~bits) clear(block, separated);
    touching_bits.fetch_xor(static_cast<std::uint8_t>(changed), std::memory_order_relaxed);
  }
  /// Bits of the candidates of a block that touched in the last set_touching(); 0 beyond the end.
  unsigned touched(std::size_t block) const
  {
    return block < touching.size() ? touching[block].load(std::memory_order_relaxed) : 0;
  }

  /// With several(): the contacts that a candidate has now. Returns how many of `found` there are then,
  /// and fills in the slot of each; by_parts() says which of the following two does it.
  struct Ends;
  int continue_found(std::size_t candidate, SurfaceContact *found, int count, std::uint32_t *slots,
                     Vector3<double> *before, const Ends *ends, bool reaches = false)
  {
    if (with_parts) {
      continue_parts(candidate, found, count, slots);
      return count;
    }
    const int left = goes_on(candidate, found, count, before, reaches)
                         ? count
                         : continue_contacts(candidate, found, count, before, ends, reaches);
    for (int k = 0; k < left; k++) slots[k] = first[candidate] + k;
    return left;
  }
  /// A contact continues another one if its normal has turned by less (37 degrees), which is more than
  /// facets of a smooth patch differ.
  static constexpr double least_cosine = 0.8;
  /// Whether a candidate has one contact and had that before, or none and had none, as most; this is all
  /// that continue_contacts() would find and do.
  bool goes_on(std::size_t candidate, const SurfaceContact *found, int count,
               Vector3<double> *before, bool reaches)
  {
    if (counts[candidate] != count || count > 1) return false;
    if (count == 0) return true;
    Vector3<double> &normal = normals[first[candidate]];
    if (!((reaches || found->overlap > 0.0) && dot(normal, found->normal) > least_cosine))
      return false;
    if (before) *before = normal;
    normal = found->normal;
    return true;
  }
  /// By their normals: slot k of the candidate is that of found[k]. A contact continues that with the nearest normal, in the frame of the body: from one step to the
  /// next it turns by far less than the angle between two contacts. Contacts without overlap that
  /// continue none are taken out of `found`; returns how many are left, and leaves room for
  /// LargeBodyShape::max_contacts. `before`: nullptr, or receives the normals that they had, zero of
  /// new ones. `ends`: of laws of second order, whose contacts last for the step in which they end. `reaches`: they begin
  /// without overlap.
  struct Ends {
    bool advance;    ///< see has_just_ended()
    /// As LargeBodyShape::find_contacts(), also of what is a little further away, with overlaps below
    /// zero. Called only where a contact has ended.
    std::function<int(SurfaceContact *found)> look_further;
  };
  int continue_contacts(std::size_t candidate, SurfaceContact *found, int count,
                        Vector3<double> *before = nullptr, const Ends *ends = nullptr,
                        bool reaches = false);
  /// By their parts: a contact continues that with the same one. Fills in the slot of each.
  void continue_parts(std::size_t candidate, const SurfaceContact *found, int count,
                      std::uint32_t *slots)
  {
    const std::uint32_t slot = first[candidate];
    bool same = counts[candidate] == count;
    for (int k = 0; k < count; k++) {
      same = same && parts[slot + k] == found[k].part;
      slots[k] = slot + k;
    }
    if (!same) match_parts(candidate, found, count, slots);
  }

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
    if (with_several) return;
    std::fill(normals.begin(), normals.end(), Vector3<double>{0.0, 0.0, 0.0});
    forgets_those_at_rest = true;
  }

  /// Contacts that a candidate has.
  int count(std::size_t candidate) const;

  double memory_usage() const;

 private:
  struct Known;
  Vector3<double> normal_at(std::size_t slot) const
  {
    return with_normals ? normals[slot] : Vector3<double>{0.0, 0.0, 0.0};
  }
  void set_zero(std::size_t slot);
  bool rests() const { return memory && is_at_rest(); }
  int count_in(const ContactLists &lists, int particle) const;
  void match_parts(std::size_t candidate, const SurfaceContact *found, int count,
                   std::uint32_t *slots);
  int drop_ended_parts(std::size_t slot, int known, const SurfaceContact *found, int count);
  void take_back(std::size_t candidate, const ContactLists &from);
  void clear(std::size_t block, unsigned separated);

  bool with_several = false, with_normals = false, with_parts = false;
  bool forgets_those_at_rest = false;    // normals
  ContactMemory *memory = nullptr;
  std::int64_t name = 0;
  std::vector<int> owners;    // of candidates: local indices
  // by candidate, only with several contacts: first slot, contacts
  std::vector<std::uint32_t> first;
  std::vector<std::uint8_t> counts;
  // by slot: history; normal, or empty; part, only of walls with several contacts
  HistoryRows rows;
  std::vector<Vector3<double>> normals;
  std::vector<int> parts;
  // one bit for each candidate, only with one contact: its record may not be zero
  std::vector<std::atomic<std::uint8_t>> touching;
};

}    // namespace Talus

#endif
