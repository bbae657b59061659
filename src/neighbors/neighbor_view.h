// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A half neighbor list as it stands in memory: LAMMPS', without its types, or that of
// NeighborSearch.

#ifndef TALUS_NEIGHBORS_NEIGHBOR_VIEW_H
#define TALUS_NEIGHBORS_NEIGHBOR_VIEW_H

namespace Talus {

/// Every pair of which at least one member is owned stands in the row of one of them. Entries are
/// indices of particles in the lower bits and the kind of the pair in the upper ones; kinds scale
/// the force, and a scale of zero takes the pair out.
struct NeighborView {
  int rows = 0;
  const int *particle = nullptr;          ///< row -> particle; nullptr: the same
  const int *size = nullptr;              ///< particle -> entries
  const int *const *entries = nullptr;    ///< particle -> entries
  int index_mask = ~0,
      kind_shift = 31;    ///< index = entry & index_mask, kind = entry >> shift & 3
  double scale[4] = {1.0, 1.0, 1.0, 1.0};

  double scale_of(int entry) const { return scale[entry >> kind_shift & 3]; }
  /// Not all pairs have a scale of 1.
  bool scales() const
  {
    return scale[0] != 1.0 || scale[1] != 1.0 || scale[2] != 1.0 || scale[3] != 1.0;
  }

  /// Calls visit(i, j, scale) for every pair, in the order of the list.
  template <class Visit> void for_each_pair(Visit visit) const { for_each_pair(0, rows, visit); }

  /// The same for the rows begin ... end-1.
  template <class Visit> void for_each_pair(int begin, int end, Visit visit) const
  {
    for (int r = begin; r < end; r++) {
      const int i = particle ? particle[r] : r;
      const int *row = entries[i];
      for (int n = 0; n < size[i]; n++)
        if (const double weight = scale_of(row[n]); weight != 0.0)
          visit(i, row[n] & index_mask, weight);
    }
  }
};

}    // namespace Talus

#endif
