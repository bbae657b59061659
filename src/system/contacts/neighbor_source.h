// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Where the pair style has its neighbors from: its own search on all threads, made for spheres in
// the order in which they stand here; or LAMMPS' list, where LAMMPS knows something of pairs
// that the search does not.

#ifndef TALUS_SYSTEM_CONTACTS_NEIGHBOR_SOURCE_H
#define TALUS_SYSTEM_CONTACTS_NEIGHBOR_SOURCE_H

#include "neighbors/neighbor_search.h"
#include "pointers.h"

#include <functional>
#include <string>

namespace LAMMPS_NS {

class NeighborSource : protected Pointers {
 public:
  explicit NeighborSource(LAMMPS *lmp) : Pointers(lmp) {}

  /// To be called by the pair style's init_style(). Asks for a list of LAMMPS if that is needed,
  /// and says in the log who finds the neighbors if it is not the one of the last run.
  void init(class Pair *pair);

  /// At a rebuild. `list`: the pair style's, not read if the search is ours. `pulloff_distance`:
  /// how far contacts last beyond zero overlap. Valid until release().
  Talus::NeighborView find(const class NeighList *list, double pulloff_distance);
  /// Takes pairs out of what find() has found, see NeighborSearch; only of neighbors found here.
  Talus::NeighborView take_out(const std::function<bool(int, int)> &take)
  {
    search.take_out(take);
    return search.view();
  }
  void release() { search.clear(); }

  /// "" if neighbors are found here, else why the lists are those of LAMMPS.
  std::string reason_for_lammps_lists() const;
  double memory_usage() const { return search.memory_usage(); }

 private:
  bool excludes(int i, int j) const;
  void leave_bins_out();

  Talus::NeighborSearch search;
  bool searches = false, bins_left_out = false, types_excluded = false;
  int groups_excluded = 0, molecules_excluded = 0;
  std::string said;
};

}    // namespace LAMMPS_NS

#endif
