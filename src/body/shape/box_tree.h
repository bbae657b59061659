// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A tree of boxes around things, to find those near a point. It lives in the frame of its body:
// however the body moves, the tree stays as it is.

#ifndef TALUS_BODY_SHAPE_BOX_TREE_H
#define TALUS_BODY_SHAPE_BOX_TREE_H

#include "base/linear_algebra.h"

#include <algorithm>
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

  std::vector<Node> nodes;
  std::vector<int> things;
};

}    // namespace Talus

#endif
