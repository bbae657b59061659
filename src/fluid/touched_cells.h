// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The few of many cells that grains of this rank are in, numbered as they come.

#ifndef TALUS_FLUID_TOUCHED_CELLS_H
#define TALUS_FLUID_TOUCHED_CELLS_H

#include <vector>

namespace Talus {

class TouchedCells {
 public:
  explicit TouchedCells(int all) : slots(all, -1) {}

  /// The place of a cell among those touched, which it is from now on.
  int slot(int cell)
  {
    int &known = slots[cell];
    if (known < 0) {
      known = static_cast<int>(touched.size());
      touched.push_back(cell);
    }
    return known;
  }
  const std::vector<int> &cells() const { return touched; }
  void clear()
  {
    for (const int cell : touched) slots[cell] = -1;
    touched.clear();
  }

 private:
  std::vector<int> slots, touched;
};

}    // namespace Talus

#endif
