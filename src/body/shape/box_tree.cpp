// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/box_tree.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace Talus {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

float below(double x)
{
  return std::nextafterf(static_cast<float>(x), -infinity);
}

float above(double x)
{
  return std::nextafterf(static_cast<float>(x), infinity);
}

}    // namespace

BoxTree::BoxTree(const Boxes &boxes)
{
  std::vector<int> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  grow(boxes, order.data(), order.data() + order.size());
  nodes.shrink_to_fit();
  things.shrink_to_fit();
  sizes_when_made = sum_of_sizes();
}

double BoxTree::sum_of_sizes() const
{
  double sum = 0.0;
  for (std::size_t n = 0; n < nodes.size(); n++)
    for (int k = 0; k < width; k++) sum += std::max(size_of(child(static_cast<int>(n), k)), 0.0);
  return sum;
}

/* Children have higher numbers than their parents, so that 0 is no child. */

bool BoxTree::refit(const Boxes &boxes)
{
  constexpr double much = 2.0;
  for (std::size_t n = nodes.size(); n-- > 0;) {
    Node &node = nodes[n];
    for (int k = 0; k < width; k++) {
      if (node.count[k]) {
        const int *const begin = &things[leaf_size * node.first[k]];
        set_box(node, k, boxes, begin, begin + node.count[k]);
        continue;
      }
      if (!node.first[k]) continue;
      const Node &below_it = nodes[node.first[k]];
      for (int d = 0; d < 3; d++) {
        node.low[d][k] = *std::min_element(below_it.low[d], below_it.low[d] + width);
        node.high[d][k] = *std::max_element(below_it.high[d], below_it.high[d] + width);
      }
    }
  }
  return sum_of_sizes() > much * sizes_when_made;
}

void BoxTree::set_box(Node &node, int k, const Boxes &boxes, const int *begin, const int *end)
{
  Eigen::AlignedBox3d all;
  for (const int *thing = begin; thing != end; thing++) all.extend(boxes[*thing]);
  for (int d = 0; d < 3; d++) {
    node.low[d][k] = below(all.min()[d]);
    node.high[d][k] = above(all.max()[d]);
  }
}

/// A node of these things, with all below it; returns its number.
int BoxTree::grow(const Boxes &boxes, int *begin, int *end)
{
  const int number = static_cast<int>(nodes.size());
  Node node{};
  for (int d = 0; d < 3; d++) {
    std::fill(node.low[d], node.low[d] + width, infinity);
    std::fill(node.high[d], node.high[d] + width, -infinity);
  }
  nodes.push_back(node);
  std::vector<int *> ends;
  divide(boxes, begin, end, halvings, ends);
  for (std::size_t n = 0; n < ends.size(); n++) {
    const int k = static_cast<int>(n), count = static_cast<int>(ends[n] - begin);
    const bool is_leaf = count <= leaf_size;
    const int first = is_leaf ? add_leaf(begin, ends[n]) : grow(boxes, begin, ends[n]);
    nodes[number].first[k] = first;
    nodes[number].count[k] = is_leaf ? count : 0;
    set_box(nodes[number], k, boxes, begin, ends[n]);
    begin = ends[n];
  }
  return number;
}

int BoxTree::add_leaf(const int *begin, const int *end)
{
  const int leaf = num_leaves();
  things.insert(things.end(), begin, end);
  things.resize(static_cast<std::size_t>(leaf_size) * (leaf + 1), -1);
  return leaf;
}

/* In halves, along the longest axis, of equal ones the first, and those again; such that leaves are full.
   Appends their ends. */

void BoxTree::divide(const Boxes &boxes, int *begin, int *end, int times, std::vector<int *> &ends)
{
  if (times == 0 || end - begin <= leaf_size) {
    ends.push_back(end);
    return;
  }
  Eigen::AlignedBox3d all;
  for (const int *thing = begin; thing != end; thing++) all.extend(boxes[*thing]);
  int axis;
  all.sizes().maxCoeff(&axis);
  const std::ptrdiff_t leaves = (end - begin + leaf_size - 1) / leaf_size;
  int *const half = begin + leaves / 2 * leaf_size;
  const auto middle = [&](int thing) {
    return boxes[thing].min()(axis) + boxes[thing].max()(axis);
  };
  std::nth_element(begin, half, end, [&](int a, int b) {
    const double u = middle(a), v = middle(b);
    return u != v ? u < v : a < b;
  });
  divide(boxes, begin, half, times - 1, ends);
  divide(boxes, half, end, times - 1, ends);
}

void BoxTree::add_pairs_within(int node, Pairs &pairs) const
{
  for (int k = 0; k < width; k++)
    for (int l = k; l < width; l++) {
      const Child a = child(node, k), b = child(node, l);
      if (overlap(a, b)) pairs.push_back({a, b});
    }
}

double BoxTree::memory_usage() const
{
  return static_cast<double>(nodes.capacity() * sizeof(Node) + things.capacity() * sizeof(int));
}

}    // namespace Talus
