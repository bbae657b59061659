// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/contact/contact_points.h"

#include <algorithm>

namespace Talus {

void ContactPoints::set_list(std::vector<Pair> pairs, int owned_here, int pairs_of_chunk)
{
  owned = owned_here;
  list = std::move(pairs);
  chunks.clear();
  const int all = static_cast<int>(list.size());
  for (int begin = 0; begin < all; begin += pairs_of_chunk)
    chunks.push_back({begin, std::min(begin + pairs_of_chunk, all)});
}

void ContactPoints::save(ContactLists &to) const
{
  for_each_point([&](const Pair &pair, const PointContact &point) {
    if (pair.first < owned) keep_history(point, pair.first, pair.name[1], to);
    if (pair.second < owned) keep_history(point, pair.second, pair.name[0], to);
  });
}

void ContactPoints::account_for_work(WorkAccount &to) const
{
  for_each_point([&](const Pair &pair, const PointContact &point) {
    to.sum += share(pair) * point.work;
    const double of_each = pair.second == large_body ? 1.0 : 0.5;
    for (const int i : {pair.first, pair.second})
      if (i < owned) add_work(to, i, point.work, of_each);
  });
}

DeepestContact ContactPoints::deepest_since_set() const
{
  DeepestContact deepest{DeepestContact::watched};
  for (const Chunk &chunk : chunks) deepest = std::max(deepest, chunk.deepest);
  return deepest;
}

double ContactPoints::memory_usage() const
{
  std::size_t bytes = list.capacity() * sizeof(Pair);
  for (const Chunk &chunk : chunks)
    bytes += (chunk.points.capacity() + chunk.before.capacity()) * sizeof(PointContact);
  return static_cast<double>(bytes);
}

}    // namespace Talus
