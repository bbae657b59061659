// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A tree of boxes around things, to find those near a point, or near each other. Each node has up to eight
// children, whose boxes are looked at side by side. It lives in the frame of its body: however the body moves,
// the tree stays as it is.

#ifndef TALUS_BODY_SHAPE_BOX_TREE_H
#define TALUS_BODY_SHAPE_BOX_TREE_H

#include "base/aligned_vector.h"
#include "base/linear_algebra.h"
#include "base/simd.h"

#include <array>
#include <cmath>
#include <limits>
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
    visit_leaves_near(point, reach, [&](int leaf, int count) {
      for (int k = 0; k < count; k++) visit(thing(leaf, k));
    });
  }

  /// The same for visit(leaf, number of its things), which are thing(leaf, 0) and so on.
  template <class Visitor>
  void visit_leaves_near(const Vector3<double> &point, double reach, Visitor visit) const
  {
    const Place place(point, reach);
    int stack[max_stack], depth = 0;
    stack[depth++] = 0;
    while (depth) {
      const Node &node = nodes[stack[--depth]];
      for (unsigned bits = near_bits(node, place); bits; bits &= bits - 1U) {
        const int k = __builtin_ctz(bits);
        if (node.count[k])
          visit(node.first[k], node.count[k]);
        else
          stack[depth++] = node.first[k];
      }
    }
  }

  /// A leaf has up to so many things.
  static constexpr int leaf_size = 8;
  int num_leaves() const { return static_cast<int>(things.size()) / leaf_size; }
  /// Thing k of a leaf; -1: it has less.
  int thing(int leaf, int k) const { return things[leaf_size * leaf + k]; }

  /// Calls visit(a, b) once for each two things whose boxes overlap, perhaps for some others.
  template <class Visitor> void visit_overlaps(Visitor visit) const
  {
    Pairs stack;
    add_pairs_within(0, stack);
    while (!stack.empty()) {
      const auto [a, b] = stack.back();
      stack.pop_back();
      const bool same = a.first == b.first && a.count == b.count;
      if (a.count && b.count) {
        for (int k = 0; k < a.count; k++)
          for (int l = same ? k + 1 : 0; l < b.count; l++)
            visit(thing(a.first, k), thing(b.first, l));
      } else if (same) {
        add_pairs_within(a.first, stack);
      } else {
        const bool divide_a = b.count || (!a.count && size_of(a) > size_of(b));
        const Child &whole = divide_a ? a : b, &other = divide_a ? b : a;
        for (int k = 0; k < width; k++)
          if (const Child part = child(whole.first, k); overlap(part, other))
            stack.push_back({part, other});
      }
    }
  }

  /// The things have other boxes now. Returns whether a new tree would be much faster.
  bool refit(const std::vector<Eigen::AlignedBox3d> &boxes);

  double memory_usage() const;

 private:
  static constexpr int width = 8, halvings = 3;
  static constexpr int max_stack =
      128;    // seven at every level, an eighth as large as the one above

  /// By child. Without one: a box that is nowhere.
  struct alignas(32) Node {
    float low[3][width], high[3][width];    // rounded outward
    int first[width], count[width];         // a leaf and its things; count 0: a node
  };
  struct Child {
    float low[3], high[3];
    int first, count;
  };
  using Pairs = std::vector<std::array<Child, 2>>;

  /// In numbers of the boxes: further by more than their rounding.
  struct Place {
    float at[3], square;

    Place(const Vector3<double> &p, double reach) :
        at{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}
    {
      constexpr double rounding = 1.0e-6;
      const double wide =
          (1.0 + rounding) * reach + rounding * (std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z));
      square =
          static_cast<float>((1.0 + rounding) * wide * wide) + std::numeric_limits<float>::min();
    }
  };

  using Boxes = std::vector<Eigen::AlignedBox3d>;
  int grow(const Boxes &boxes, int *begin, int *end);
  int add_leaf(const int *begin, const int *end);
  static void divide(const Boxes &boxes, int *begin, int *end, int times, std::vector<int *> &ends);
  static void set_box(Node &node, int k, const Boxes &boxes, const int *begin, const int *end);
  void add_pairs_within(int node, Pairs &pairs) const;

  static unsigned near_bits(const Node &node, const Place &place)
  {
    using Memory8 = Memory<Float8>;
    Float8 sum{};
    for (int d = 0; d < 3; d++) {
      const Float8 p = place.at[d] - Float8{};
      const Float8 out =
          larger(larger(Memory8::load(node.low[d]) - p, p - Memory8::load(node.high[d])), Float8{});
      sum = sum + out * out;
    }
    return less_bits(sum, place.square - Float8{});
  }

  Child child(int n, int k) const
  {
    const Node &node = nodes[n];
    return {{node.low[0][k], node.low[1][k], node.low[2][k]},
            {node.high[0][k], node.high[1][k], node.high[2][k]},
            node.first[k],
            node.count[k]};
  }
  static bool overlap(const Child &a, const Child &b)
  {
    for (int d = 0; d < 3; d++)
      if (a.low[d] > b.high[d] || b.low[d] > a.high[d]) return false;
    return true;
  }
  static double size_of(const Child &a)
  {
    return static_cast<double>(a.high[0] - a.low[0]) + static_cast<double>(a.high[1] - a.low[1]) +
           static_cast<double>(a.high[2] - a.low[2]);
  }
  double sum_of_sizes() const;

  AlignedVector<Node> nodes;
  std::vector<int> things;
  double sizes_when_made = 0.0;
};

}    // namespace Talus

#endif
