// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/box_tree.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace Talus {
namespace {

double coordinate(const Vector3<double> &v, int axis)
{
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

float below(double x)
{
  return std::nextafterf(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}

float above(double x)
{
  return std::nextafterf(static_cast<float>(x), std::numeric_limits<float>::infinity());
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
  nodes[node] = {{below(all.low.x), below(all.low.y), below(all.low.z)},
                 {above(all.high.x), above(all.high.y), above(all.high.z)},
                 begin,
                 end - begin};
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
