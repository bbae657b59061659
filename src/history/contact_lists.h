// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Histories of the contacts of each particle while there are no pairs and no candidates: during a
// rebuild, while particles migrate, between two runs, in restart files. A contact is identified by
// the particle that owns the list, its partner, and the feature at which the two touch; it has as
// many values as the laws of its owner need.
//
// One format, for messages and for restart files, in doubles:
//
//   number of contacts, numbers of each contact
//   for each contact: partner, feature (bit patterns), and its values with the signs of the
//   particle
//
// Particles have local index. The owner of the lists moves them as LAMMPS moves particles.

#ifndef TALUS_HISTORY_CONTACT_LISTS_H
#define TALUS_HISTORY_CONTACT_LISTS_H

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Talus {

class ContactLists {
 public:
  struct Contact {
    std::int64_t partner;     ///< > 0: ID of a particle; else a large body
    std::uint64_t feature;    ///< distinguishes contacts with one partner; 0 where there is one
    const double *value;      ///< values() numbers
  };

  /// Numbers of each contact from now on: those of contacts that are there stay, further ones are
  /// zero.
  void keep(int values);
  int values() const { return num_values; }

  /// Room for particles 0 ... n-1; new ones have no contacts.
  void grow(int particles) { first_of.resize(particles), last_of.resize(particles); }
  void copy(int from, int to);
  void forget(int particle) { first_of[particle] = last_of[particle] = 0; }
  /// All contacts of all particles.
  void clear();

  /// A further contact of a particle: its numbers, which are zero. Valid until the next add().
  double *add(int particle, std::int64_t partner, std::uint64_t feature = 0);

  bool empty() const { return contacts.empty(); }
  bool empty(int particle) const { return first_of[particle] == 0; }
  int count(int particle) const;
  /// visit(contact) for those of a particle, in the order in which they were added.
  template <class Visit> void for_each(int particle, Visit visit) const
  {
    for (std::uint32_t n = first_of[particle]; n; n = contacts[n - 1].next)
      visit(Contact{contacts[n - 1].partner, contacts[n - 1].feature,
                    numbers.data() + (n - 1) * static_cast<std::size_t>(num_values)});
  }

  /// Doubles of a list of so many contacts.
  int size_of_list(int count) const { return size_head + count * (size_name + num_values); }
  int packed_size(int particle) const { return size_of_list(count(particle)); }
  /// Largest of the particles 0 ... n-1.
  int largest_packed(int n) const;
  /// Both return the number of doubles. What is read may have other numbers of each contact.
  int pack(int particle, double *to) const;
  int unpack(int particle, const double *from);

  /// Sizes of parts of a list (doubles): before its contacts, and before the values of each
  /// contact.
  static constexpr int size_head = 2, size_name = 2;
  static void write_name(std::int64_t partner, std::uint64_t feature, double *to);

  double memory_usage() const;

 private:
  struct Link {
    std::int64_t partner;
    std::uint64_t feature;
    std::uint32_t next;    // 1 + the next contact of the same particle; 0: none
  };
  int num_values = 0;
  std::vector<std::uint32_t> first_of, last_of;    // by particle: 1 + its contact; 0: none
  std::vector<Link> contacts;
  std::vector<double> numbers;
};

}    // namespace Talus

#endif
