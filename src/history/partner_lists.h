// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact history filed by particle: for each owned particle the tags of the partners it touches
// and the history as this particle sees it. Histories live here in restart files, while particles
// migrate, and in periodic boxes whenever pairs are renumbered. Elsewhere they are stored by pair
// (ContactHistory, KeptContacts).

#ifndef TALUS_HISTORY_PARTNER_LISTS_H
#define TALUS_HISTORY_PARTNER_LISTS_H

#include "base/aligned_vector.h"

#include <cstdint>
#include <vector>

namespace Talus {

class PartnerLists {
 public:
  /// Numbers kept for each partner: 4 (history record), or 8 (and impact record). What is filed
  /// already is converted: new numbers are zero, surplus ones are dropped.
  void set_values(int n);
  int num_values() const { return values; }

  /// Room for particles 0 ... capacity-1; new ones have no partners.
  void resize(int capacity);

  /// Refills all lists: begin(), then count() once for every entry, then layout(), then append()
  /// for the same entries; append() returns where to write the values of the entry.
  void begin();
  void count(int atom) { range[atom].size++; }
  void layout();
  double *append(int atom, std::int64_t tag);

  /// Empties all lists, and gives their memory back if it is much.
  void release();

  /// Values of `atom` with the partner `tag`, or nullptr. Valid until the next refill or unpack.
  const double *find(int atom, std::int64_t tag) const;

  double *find(int atom, std::int64_t tag)
  {
    return const_cast<double *>(static_cast<const PartnerLists *>(this)->find(atom, tag));
  }

  /// Copies entry n of a list: the tag, as the bits of a double, and the values.
  void copy_entry(int atom, int n, double *to) const;

  int size(int atom) const { return range[atom].size; }
  /// All lists are empty.
  bool empty() const { return pool.empty(); }
  void clear(int atom) { range[atom] = {0, 0}; }
  void copy(int from, int to) { range[to] = range[from]; }

  /// Packing for messages and restart files: returns the number of doubles, packed_size(atom).
  int pack(int atom, double *buffer) const;
  int unpack(int atom, const double *buffer);
  int packed_size(int atom) const { return packed_size_of(size(atom)); }
  int packed_size_of(int entries) const { return 1 + stride() * entries; }
  /// One packed entry; returns where the next one goes.
  static double *write_entry(double *to, std::int64_t tag, const double *values, int num_values);

  double memory_usage() const;

 private:
  int stride() const { return 1 + values; }    // the tag, as the bits of a double, and the values

  struct Range {
    std::int64_t begin = 0;    // in entries
    int size = 0;
  };
  int values = 4;
  std::vector<Range> range;
  AlignedVector<double> pool;
};

}    // namespace Talus

#endif
