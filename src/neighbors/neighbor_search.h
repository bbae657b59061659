// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Finds the pairs of spheres that may touch before the next rebuild: all with
// |x_i - x_j| < r_i + r_j + skin of which at least one is owned, and a few that are slightly
// further apart. Does the work of LAMMPS' neighbor lists for contacts, on all threads.
//
// Spheres are sorted into cells by the reach of a usual one. Each looks for those around it
// with a lower index, so that a pair is found once and where the candidate list will have it. If
// sizes differ much, it looks for the smaller ones instead: a large sphere among many small ones
// looks into many cells, which is better than every small one looking far. A row of cells along x
// stands in one piece of memory and is compared 16 spheres at a time, in single precision: places
// in units of that reach in the box around all spheres, with a reach that is wider by more than the
// rounding. Cells are the thicker the thinner spheres are sown, so that these pieces are not nearly
// empty.

#ifndef TALUS_NEIGHBORS_NEIGHBOR_SEARCH_H
#define TALUS_NEIGHBORS_NEIGHBOR_SEARCH_H

#include "base/aligned_vector.h"
#include "neighbors/neighbor_view.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace Talus {

class NeighborSearch {
 public:
  /// Arrays of LAMMPS: rows of three doubles and radii, owned particles first, then ghosts.
  struct Spheres {
    int owned, total;
    const double *x, *radius;
    double skin;
    int first_row = 0;    ///< rows of spheres before this one stay empty
  };

  /// `excluded(i, j)`, if given: pairs that are left out; called from all threads. Throws
  /// std::domain_error if a position is not a number.
  void find(const Spheres &spheres, int threads, const std::function<bool(int, int)> &excluded);

  /// The pairs of the last find(), each in the row of one of its spheres, which may be a ghost.
  /// Valid until the next find() or clear().
  NeighborView view() const;

  /// Takes pairs out of the last find(), in the order of their rows: those for which take(i, j),
  /// which is asked once for each, is true.
  void take_out(const std::function<bool(int, int)> &take);

  /// Drops the pairs, and gives all memory back if it is much.
  void clear();

  double memory_usage() const;

 private:
  struct Grid {
    double low[3], per_length;    ///< lowest corner of the cells; places per length
    double per_place[3];          ///< cells per unit of place
    double largest;               ///< radius (in cells)
    int cells[3];
    float alike;    ///< the largest radius (in cells) if sizes differ little, else 0

    int cell(double place, int d) const;
    std::int64_t row(int y, int z) const
    {
      return (static_cast<std::int64_t>(z) * cells[1] + y) * cells[0];
    }
    double place(const Spheres &s, int a, int d) const
    {
      return (s.x[3L * a + d] - low[d]) * per_length;
    }
  };
  struct Extent;
  /// What one thread finds: the rows of its particles, one after the other. In a cache line of its
  /// own, for the count is written all the time.
  struct alignas(64) Chunk {
    AlignedVector<int> entries;
    std::size_t count = 0;
  };
  static Extent extent_of(const Spheres &spheres, int threads);
  static Grid make_grid(const Spheres &spheres, int threads);
  static void choose_cells(Grid &grid, const Extent &extent, double edge, int spheres);
  void sort_into_cells(const Spheres &spheres, int threads);
  void release_cells();
  void find_rows(const Spheres &spheres, Chunk &mine, int begin, int end,
                 const std::function<bool(int, int)> &excluded);
  void find_row(const Spheres &spheres, int particle, Chunk &found) const;
  void compare(const float *place_and_radius, int particle, int below, std::int64_t begin,
               std::int64_t end, Chunk &found) const;

  Grid grid{};
  float slack = 0.0F, skin = 0.0F;                              // in cells
  using CellCounts = std::vector<std::vector<std::int32_t>>;    // of several threads
  void find_starts(CellCounts &counts);

  std::vector<std::int32_t> start;         // of each cell in the arrays below, and one more
  AlignedVector<float> x, y, z, radius;    // in cells, sorted by cell
  AlignedVector<std::int32_t> index;
  std::vector<Chunk> chunks;             // by thread
  AlignedVector<int> size;               // by particle
  AlignedVector<const int *> entries;    // by particle
};

}    // namespace Talus

#endif
