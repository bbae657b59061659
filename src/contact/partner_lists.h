// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact history filed by particle: for each owned particle the tags of the partners it touches and
// the history as this particle sees it. Histories live here only while pairs are renumbered: across a
// rebuild, while particles migrate, between runs and in restart files. In between they are stored by
// pair (ContactHistory).

#ifndef TALUS_CONTACT_PARTNER_LISTS_H
#define TALUS_CONTACT_PARTNER_LISTS_H

#include "contact/record.h"

#include <cstdint>
#include <vector>

namespace Talus {

class PartnerLists {
 public:
  struct Partner {
    std::int64_t tag;
    double history[4];    ///< see record.h
  };
  static constexpr int packed_size = 5;    ///< doubles of one packed partner

  /// Room for particles 0 ... capacity-1; new ones have no partners.
  void resize(int capacity);

  /// Refills all lists: begin(), then count() once for every entry, then layout(), then append() for
  /// the same entries.
  void begin();
  void count(int atom) { range[atom].size++; }
  void layout();
  void append(int atom, std::int64_t tag, const Record &history);

  /// History of `atom` with the partner `tag`, or nullptr. Valid until the next refill or unpack.
  const Partner *find(int atom, std::int64_t tag) const;

  int size(int atom) const { return range[atom].size; }
  void clear(int atom) { range[atom] = {0, 0}; }
  void clear_all();
  void copy(int from, int to) { range[to] = range[from]; }

  /// Packing for messages and restart files: returns the number of doubles, 1 + packed_size * partners.
  int pack(int atom, double *buffer) const;
  int unpack(int atom, const double *buffer);

  double memory_usage() const;

 private:
  struct Range {
    std::int64_t begin = 0;
    int size = 0;
  };
  std::vector<Range> range;
  std::vector<Partner> pool;
};

}    // namespace Talus

#endif
