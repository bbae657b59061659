// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of each particle by name, while they are not with those who compute them: during a
// rebuild, while particles migrate, between two runs, in restart files. A contact is identified by
// the particle that owns the list, its partner, and the feature at which the two touch; it has as
// many values as its laws need.
//
// One format, for messages and for restart files, in doubles:
//
//   number of contacts
//   for each contact: partner, feature (bit patterns), number of values, and these with the signs
//   of the particle
//
// Particles have local index. The owner of the lists moves them as LAMMPS moves particles.

#ifndef TALUS_HISTORY_CONTACT_LISTS_H
#define TALUS_HISTORY_CONTACT_LISTS_H

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace Talus {

class ContactLists {
 public:
  struct Contact {
    std::int64_t partner;     ///< > 0: ID of a particle; else a large body or a wall
    std::uint64_t feature;    ///< distinguishes contacts with one partner; 0 where there is one
    const double *value;
    int values;
  };
  /// In a feature: a contact point of a particle with a shape. Contacts of spheres have another memory.
  static constexpr std::uint64_t of_shape = std::uint64_t{1} << 63;

  /// Room for particles 0 ... n-1; new ones have no contacts.
  void grow(int particles) { first_of.resize(particles), last_of.resize(particles); }
  void copy(int from, int to);
  void forget(int particle) { first_of[particle] = last_of[particle] = 0; }
  /// All contacts of all particles.
  void clear();
  /// Those of all particles, or of one, of which remove(contact) says so.
  template <class Remove> void remove_if(Remove remove);
  template <class Remove> void remove_if(int particle, Remove remove);

  /// A further contact of a particle: its values, which are zero. Valid until the next add().
  double *add(int particle, std::int64_t partner, std::uint64_t feature, int values);

  bool empty() const { return contacts.empty(); }
  bool empty(int particle) const { return first_of[particle] == 0; }
  /// visit(contact) for those of a particle, in the order in which they were added.
  template <class Visit> void for_each(int particle, Visit visit) const
  {
    for (std::uint32_t n = first_of[particle]; n; n = contacts[n - 1].next) visit(contact(n));
  }

  /// Doubles of a list in messages.
  int packed_size(int particle) const;
  /// Largest of the particles 0 ... n-1.
  int largest_packed(int n) const;
  static constexpr int size_head = 1, size_name = 3;

  /// Writes such a list; size() doubles in the end.
  class Writer {
   public:
    explicit Writer(double *to) : begin(to), end(to + size_head) { *begin = 0.0; }
    void add(const Contact &one);
    int size() const { return static_cast<int>(end - begin); }

   private:
    double *begin, *end;
  };
  /// Takes the list of a message in the place of that of a particle, but not what skip(contact) says.
  /// Returns the number of doubles.
  template <class Skip> int unpack(int particle, const double *from, Skip skip);

  double memory_usage() const;

 private:
  struct Link {
    std::int64_t partner;
    std::uint64_t feature;
    std::size_t value;    // the first one
    std::int32_t values;
    std::uint32_t next;    // 1 + the next contact of the same particle; 0: none
  };
  Contact contact(std::uint32_t number) const
  {
    const Link &one = contacts[number - 1];
    return {one.partner, one.feature, numbers.data() + one.value, one.values};
  }
  static Contact read(const double *from);
  void add_copy(int particle, const Contact &one);

  std::vector<std::uint32_t> first_of, last_of;    // by particle: 1 + its contact; 0: none
  std::vector<Link> contacts;
  std::vector<double> numbers;
};

template <class Remove> void ContactLists::remove_if(Remove remove)
{
  if (contacts.empty()) return;
  ContactLists rest;
  rest.grow(static_cast<int>(first_of.size()));
  for (int i = 0; i < static_cast<int>(first_of.size()); i++)
    for_each(i, [&](const Contact &one) {
      if (!remove(one)) rest.add_copy(i, one);
    });
  *this = std::move(rest);
}

template <class Remove> void ContactLists::remove_if(int particle, Remove remove)
{
  std::uint32_t n = first_of[particle];
  forget(particle);
  while (n) {
    const std::uint32_t next = contacts[n - 1].next;
    if (!remove(contact(n))) {
      (last_of[particle] ? contacts[last_of[particle] - 1].next : first_of[particle]) = n;
      last_of[particle] = n;
      contacts[n - 1].next = 0;
    }
    n = next;
  }
}

template <class Skip> int ContactLists::unpack(int particle, const double *from, Skip skip)
{
  forget(particle);
  const double *next = from + size_head;
  for (int n = 0; n < static_cast<int>(*from); n++) {
    const Contact one = read(next);
    if (!skip(one)) add_copy(particle, one);
    next += size_name + one.values;
  }
  return static_cast<int>(next - from);
}

}    // namespace Talus

#endif
