// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What particles remember of their contacts with a body that may touch them at several points. A
// contact is known again by its normal in the frame of the body: from one step to the next it turns
// by far less than the angle between two contacts.

#ifndef TALUS_BODY_CONTACT_CONTACT_MEMORY_H
#define TALUS_BODY_CONTACT_CONTACT_MEMORY_H

#include "base/aligned_vector.h"
#include "body/shape/large_body_shape.h"
#include "particles/record.h"

#include <vector>

namespace Talus {

struct RememberedContact {
  Vector3<double> normal;    ///< frame of the body
  Record history;            ///< displacement (frame of the body) and limit flag
  Record impact;
};

class ContactMemory {
 public:
  /// Doubles of one contact, and the largest number that a particle can need.
  static constexpr int size_contact = 10;
  static constexpr int max_packed = 1 + LargeBodyShape::max_contacts * size_contact;

  void grow(int num_particles) { lists.resize(num_particles, {0, 0}); }
  void copy(int from, int to) { lists[to] = lists[from]; }
  void forget(int particle) { lists[particle] = {0, 0}; }
  int count(int particle) const { return lists[particle].count; }
  const RememberedContact *begin(int particle) const
  {
    return contacts.data() + lists[particle].first;
  }

  /// Starts to load the list of a particle; without histories there are none.
  void call_ahead(int particle) const
  {
    if (!lists.empty()) __builtin_prefetch(&lists[particle]);
  }

  /// The contact of a particle that continues as one with this normal, out of those not yet `taken`
  /// (bits by index), which receives it. -1 if there is none: the contact is new.
  int find(int particle, const Vector3<double> &normal, unsigned &taken) const;

  /// A step makes new lists: the contacts of every particle one after another, in pieces that
  /// different threads may have made.
  void start_step();
  void set_list(int particle, int first, int count) { lists[particle] = {first, count}; }
  int append(AlignedVector<RememberedContact> &piece);    ///< which is used up
  void end_step();

  /// For migration and restart: count, contacts. Returns the number of doubles.
  int pack(int particle, double *buf) const;
  int unpack(int particle, const double *buf);
  int size_packed(int particle) const { return 1 + size_contact * count(particle); }

  double memory_usage() const;

 private:
  struct List {
    int first, count;
  };
  std::vector<List> lists;    // by particle
  AlignedVector<RememberedContact> contacts, next;
};

}    // namespace Talus

#endif
