// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BASE_NEARLY_SORTED_H
#define TALUS_BASE_NEARLY_SORTED_H

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace Talus {

/// Sorts values that consist of some ascending runs, such as lists that were put behind each other:
/// merges neighbors among the runs until one is left. Any order is sorted.
template <class T, class Before> void merge_runs(std::vector<T> &values, Before before)
{
  std::vector<std::size_t> ends;    // of the runs
  for (std::size_t n = 1; n <= values.size(); n++)
    if (n == values.size() || before(values[n], values[n - 1])) ends.push_back(n);
  std::vector<T> merged(ends.size() > 1 ? values.size() : 0);
  while (ends.size() > 1) {
    std::vector<std::size_t> next;
    std::size_t begin = 0;
    for (std::size_t run = 0; run < ends.size(); run += 2) {
      const std::size_t middle = ends[run], end = ends[std::min(run + 1, ends.size() - 1)];
      const auto from = values.begin();
      std::merge(from + begin, from + middle, from + middle, from + end, merged.begin() + begin,
                 before);
      next.push_back(begin = end);
    }
    values.swap(merged);
    ends.swap(next);
  }
}

/// The same for values of which most stand in ascending order already, as particles do after a few
/// have come from elsewhere or have moved a little: those in the way are taken out, sorted, and
/// merged with the others. It takes room for two more copies.
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
  merge_runs(others, before);
  std::merge(ascending.begin(), ascending.end(), others.begin(), others.end(), values.begin(),
             before);
}

/// Sorts and leaves one of those that are equal.
template <class T> void sort_and_unite(std::vector<T> &values)
{
  merge_runs(values, std::less<T>());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}    // namespace Talus

#endif
