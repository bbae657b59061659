// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A tree of boxes around things, to find those near a point, or near each other. It lives in the frame of
// its body: however the body moves, the tree stays as it is.

#ifndef TALUS_BODY_SHAPE_BOX_TREE_H
#define TALUS_BODY_SHAPE_BOX_TREE_H

#include "base/linear_algebra.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace Talus {

class BoxTree {
 public:
  /// Things are numbered as their boxes. At least one.
  explicit BoxTree(const std::vector<Eigen::AlignedBox3d> &boxes);

  /// Calls visit(thing) for every thing whose box is nearer to the point than `reach`, perhaps for
  /// some others, in an order that depends on the tree alone.
  template <class Visitor>
  void visit_near(const Vector3<double> &point, double reach, Visitor visit) const
  {
    int stack[max_depth], depth = 0;
    stack[depth++] = 0;
    while (depth) {
      const Node &node = nodes[stack[--depth]];
      if (square_distance(point, node) >= reach * reach) continue;
      for (int k = 0; k < node.count; k++) visit(things[node.first + k]);
      if (node.count) continue;
      stack[depth++] = node.first + 1;
      stack[depth++] = node.first;
    }
  }

  /// Calls visit(a, b) once for each two things whose boxes overlap, perhaps for some others.
  template <class Visitor> void visit_overlaps(Visitor visit) const
  {
    std::vector<std::pair<int, int>> stack(1, {0, 0});
    while (!stack.empty()) {
      const auto [m, n] = stack.back();
      stack.pop_back();
      const Node &a = nodes[m], &b = nodes[n];
      if (m != n && !overlap(a, b)) continue;
      if (a.count && b.count) {
        for (int k = 0; k < a.count; k++)
          for (int l = m == n ? k + 1 : 0; l < b.count; l++)
            visit(things[a.first + k], things[b.first + l]);
      } else if (m == n) {
        stack.insert(stack.end(),
                     {{a.first, a.first}, {a.first + 1, a.first + 1}, {a.first, a.first + 1}});
      } else if (b.count || (!a.count && is_larger(a, b))) {
        stack.insert(stack.end(), {{a.first, n}, {a.first + 1, n}});
      } else {
        stack.insert(stack.end(), {{m, b.first}, {m, b.first + 1}});
      }
    }
  }

  /// The things have other boxes now. Returns whether a new tree would be much faster.
  bool refit(const std::vector<Eigen::AlignedBox3d> &boxes);

  double memory_usage() const;

 private:
  static constexpr int max_depth = 128;    // halves at every level: far more than needed
  static constexpr int leaf_size = 6;

  struct Node {
    float low[3], high[3];    // rounded outward
    int first, count;         // things of a leaf; count 0: children first and first + 1
  };
  void split(int node, const std::vector<Eigen::AlignedBox3d> &boxes, int begin, int end);

  static double square_distance(const Vector3<double> &p, const Node &b)
  {
    const double x = std::max({b.low[0] - p.x, 0.0, p.x - b.high[0]});
    const double y = std::max({b.low[1] - p.y, 0.0, p.y - b.high[1]});
    const double z = std::max({b.low[2] - p.z, 0.0, p.z - b.high[2]});
    return x * x + y * y + z * z;
  }

  static bool overlap(const Node &a, const Node &b)
  {
    for (int d = 0; d < 3; d++)
      if (a.low[d] > b.high[d] || b.low[d] > a.high[d]) return false;
    return true;
  }
  static double size_of(const Node &a)
  {
    return static_cast<double>(a.high[0] - a.low[0]) + static_cast<double>(a.high[1] - a.low[1]) +
           static_cast<double>(a.high[2] - a.low[2]);
  }
  static bool is_larger(const Node &a, const Node &b) { return size_of(a) > size_of(b); }
  double sum_of_sizes() const;

  std::vector<Node> nodes;
  std::vector<int> things;
  double sizes_when_made = 0.0;
};

}    // namespace Talus

#endif
