// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Shares of the grains of this rank in the cells of a fluid, found once for as long as grains stay where they are: an
// exchange asks for them some eight times. Each cell that is touched has a slot, from 0 as they come.

#ifndef TALUS_FLUID_GRAIN_SHARES_H
#define TALUS_FLUID_GRAIN_SHARES_H

#include "fluid/fluid_cells.h"
#include "fluid/touched_cells.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Talus {

class GrainShares {
 public:
  struct Grain {
    double x[3], radius;    ///< length
    bool in_fluid;          ///< those that are not have shares if they are asked for them

    bool operator==(const Grain &other) const;
  };
  /// Cells live as long. `most`: how many shares are kept (12 bytes each); those of more grains are found each time.
  explicit GrainShares(const FluidCells &cells, std::size_t most = 20'000'000);

  /// The grains by index. To be called before all else; does nothing if they are those of before.
  void update(std::vector<Grain> now);
  /// Index of the first grain in the fluid that is outside of all cells, -1: none is. Its share is the nearest cell's.
  int first_outside() const { return outside; }

  /// visit(slot, share) for each cell of a grain; the same order each time.
  template <class Visit> void for_each(int grain, Visit visit)
  {
    if (first[grain] == first[grain + 1]) {
      find(grains[grain]);
      for (const FluidCells::Share &share : shares) visit(touched.slot(share.cell), share.weight);
      return;
    }
    for (std::size_t at = first[grain]; at < first[grain + 1]; at++) visit(slots[at], weights[at]);
  }
  /// Of each slot the cell. All that grains in the fluid touch are there from update() on.
  const std::vector<int> &touched_cells() const { return touched.cells(); }
  /// Grains whose shares were found, since the beginning; for tests and measurements.
  std::int64_t num_found() const { return found; }

 private:
  bool find(const Grain &grain);

  const FluidCells &cells;
  std::size_t most_kept;
  std::vector<Grain> grains;
  std::vector<std::size_t>
      first;    // of grain g: from first[g] to before first[g+1]; none: not kept
  std::vector<int> slots;
  std::vector<double> weights;
  TouchedCells touched;
  int outside = -1;
  std::int64_t found = 0;
  std::vector<FluidCells::Share> shares;    // of the last grain
};

}    // namespace Talus

#endif
