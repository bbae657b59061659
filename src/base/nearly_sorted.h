// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BASE_NEARLY_SORTED_H
#define TALUS_BASE_NEARLY_SORTED_H

#include <algorithm>
#include <vector>

namespace Talus {

/// Sorts values of which most stand in ascending order already, as particles do after a few have
/// come from elsewhere or have moved a little: those in the way are taken out, sorted, and merged
/// with the others. Any order is sorted; it takes room for two more copies.
template <class T, class Before> void sort_nearly_sorted(std::vector<T> &values, Before before)
{
  std::vector<T> ascending, others;
  ascending.reserve(values.size());
  for (const T &value : values) {
    if (ascending.empty() || !before(value, ascending.back())) {
      ascending.push_back(value);
    } else if (ascending.size() > 1 && !before(value, *(ascending.end() - 2))) {
      others.push_back(ascending.back());    // it was too large, alone
      ascending.back() = value;
    } else {
      others.push_back(value);
    }
  }
  std::sort(others.begin(), others.end(), before);
  std::merge(ascending.begin(), ascending.end(), others.begin(), others.end(), values.begin(),
             before);
}

}    // namespace Talus

#endif
