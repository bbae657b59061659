// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/box_tree.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace Talus {
namespace {

float below(double x)
{
  return std::nextafterf(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}

float above(double x)
{
  return std::nextafterf(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

}    // namespace

BoxTree::BoxTree(const std::vector<Eigen::AlignedBox3d> &boxes) : things(boxes.size())
{
  std::iota(things.begin(), things.end(), 0);
  nodes.emplace_back();
  split(0, boxes, 0, static_cast<int>(boxes.size()));
  nodes.shrink_to_fit();
  sizes_when_made = sum_of_sizes();
}

double BoxTree::sum_of_sizes() const
{
  double sum = 0.0;
  for (const Node &node : nodes) sum += size_of(node);
  return sum;
}

/* Children have higher numbers than their parents. */

bool BoxTree::refit(const std::vector<Eigen::AlignedBox3d> &boxes)
{
  constexpr double much = 2.0;
  for (std::size_t n = nodes.size(); n-- > 0;) {
    Node &node = nodes[n];
    if (!node.count) {
      const Node &a = nodes[node.first], &b = nodes[node.first + 1];
      for (int d = 0; d < 3; d++) {
        node.low[d] = std::min(a.low[d], b.low[d]);
        node.high[d] = std::max(a.high[d], b.high[d]);
      }
      continue;
    }
    Eigen::AlignedBox3d all;
    for (int k = 0; k < node.count; k++) all.extend(boxes[things[node.first + k]]);
    for (int d = 0; d < 3; d++) {
      node.low[d] = below(all.min()[d]);
      node.high[d] = above(all.max()[d]);
    }
  }
  return sum_of_sizes() > much * sizes_when_made;
}

void BoxTree::split(int node, const std::vector<Eigen::AlignedBox3d> &boxes, int begin, int end)
{
  Eigen::AlignedBox3d all;
  for (int k = begin; k < end; k++) all.extend(boxes[things[k]]);
  const Eigen::Vector3d &low = all.min(), &high = all.max();
  nodes[node] = {{below(low.x()), below(low.y()), below(low.z())},
                 {above(high.x()), above(high.y()), above(high.z())},
                 begin,
                 end - begin};
  if (end - begin <= leaf_size) return;

  int axis;    // the longest, of equal ones the first
  all.sizes().maxCoeff(&axis);
  const int half = begin + (end - begin) / 2;
  const auto middle = [&](int thing) {
    return boxes[thing].min()(axis) + boxes[thing].max()(axis);
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
