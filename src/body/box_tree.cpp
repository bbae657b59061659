// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/box_tree.h"

#include <numeric>

namespace Talus {
namespace {

double coordinate(const Vector3<double> &v, int axis)
{
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

Bounds joined(const Bounds &a, const Bounds &b)
{
  return {
      {std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
      {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

}    // namespace

BoxTree::BoxTree(const std::vector<Bounds> &boxes) : things(boxes.size())
{
  std::iota(things.begin(), things.end(), 0);
  nodes.emplace_back();
  split(0, boxes, 0, static_cast<int>(boxes.size()));
  nodes.shrink_to_fit();
}

void BoxTree::split(int node, const std::vector<Bounds> &boxes, int begin, int end)
{
  Bounds all = boxes[things[begin]];
  for (int k = begin + 1; k < end; k++) all = joined(all, boxes[things[k]]);
  nodes[node] = {all, begin, end - begin};
  if (end - begin <= leaf_size) return;

  const Vector3<double> span = all.high - all.low;
  const int axis = span.x >= span.y && span.x >= span.z ? 0 : span.y >= span.z ? 1 : 2;
  const int half = begin + (end - begin) / 2;
  const auto middle = [&](int thing) {
    return coordinate(boxes[thing].low, axis) + coordinate(boxes[thing].high, axis);
  };
  std::nth_element(things.begin() + begin, things.begin() + half, things.begin() + end,
                   [&](int a, int b) {
                     const double u = middle(a), v = middle(b);
                     return u != v ? u < v : a < b;
                   });
  const int children = static_cast<int>(nodes.size());
  nodes.resize(nodes.size() + 2);
  nodes[node].first = children;
  nodes[node].count = 0;
  split(children, boxes, begin, half);
  split(children + 1, boxes, half, end);
}

double BoxTree::memory_usage() const
{
  return static_cast<double>(nodes.capacity() * sizeof(Node) + things.capacity() * sizeof(int));
}

}    // namespace Talus
