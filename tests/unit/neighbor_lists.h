// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A half neighbor list as the host keeps it, made of single pairs.

#ifndef TALUS_TEST_NEIGHBOR_LISTS_H
#define TALUS_TEST_NEIGHBOR_LISTS_H

#include "neighbors/neighbor_view.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace slow {

class NeighborLists {
 public:
  explicit NeighborLists(int owned) : owned(owned), lists(owned) {}

  /// At least one of i and j must be owned. Up to four different weights.
  void add(int i, int j, double weight)
  {
    if (i >= owned) std::swap(i, j);
    auto kind = std::find(weights.begin(), weights.end(), weight);
    if (kind == weights.end()) kind = weights.insert(weights.end(), weight);
    if (weights.size() > 4) throw std::logic_error("more than four kinds of pairs");
    lists[i].push_back(j | static_cast<int>(kind - weights.begin()) << shift);
  }

  /// Valid until the next add().
  Talus::NeighborView view()
  {
    order.clear();
    size.assign(owned, 0);
    entries.assign(owned, nullptr);
    for (int i = 0; i < owned; i++) {
      order.push_back(owned - 1 - i);    // the host's rows stand in no special order
      size[i] = static_cast<int>(lists[i].size());
      entries[i] = lists[i].data();
    }
    Talus::NeighborView v{owned, order.data(), size.data(), entries.data(), mask, shift, {}};
    std::copy(weights.begin(), weights.end(), v.scale);
    return v;
  }

 private:
  static constexpr int shift = 24, mask = (1 << shift) - 1;
  int owned;
  std::vector<std::vector<int>> lists;
  std::vector<double> weights{1.0};
  std::vector<int> order, size;
  std::vector<const int *> entries;
};

}    // namespace slow

#endif
