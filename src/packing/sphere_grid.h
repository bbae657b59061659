// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Finds spheres near a place, of any mixture of sizes, at a cost that does not depend on how many
// there are. Each size class, of radii that differ by less than a factor of two, has cells of its own
// width, so that a cell holds a few spheres and few cells are looked into. Cells that hold something
// are found by a hash of their numbers: the box may be much larger than what is in it.

#ifndef TALUS_PACKING_SPHERE_GRID_H
#define TALUS_PACKING_SPHERE_GRID_H

#include "base/vector3.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace Talus {

/// A box, and in which directions it is periodic.
struct GridBox {
  Vector3<double> lo, hi;
  bool periodic[3];
};

class SphereGrid {
 public:
  /// `largest`: radius of the largest sphere; `skin`: surfaces that are not further apart are near
  /// (length, >= 0); `expected`: number of spheres, or a
  /// guess.
  SphereGrid(const GridBox &box, double largest, double skin, std::size_t expected);

  /// Number of size classes: 0 has the largest spheres.
  int num_classes() const { return static_cast<int>(classes.size()); }
  int class_of(double radius) const;

  /// A sphere in the box or near it. Those that are added last are visited first.
  void add(int number, const Vector3<double> &x, double radius);

  /// Calls visit(number) for each sphere of a size class that may be near to one with this place and
  /// radius, and for some others, once each. Returns how many cells and spheres were looked at.
  template <class Visit>
  long visit_near(int size_class, const Vector3<double> &x, double radius, Visit visit) const
  {
    const SizeClass &cells = classes[size_class];
    if (!cells.count) return 0;
    long looked = 0;
    int from[3], to[3];
    range_of(cells, x, radius + cells.largest + skin, from, to);
    for (int c = from[2]; c <= to[2]; c++)
      for (int b = from[1]; b <= to[1]; b++)
        for (int a = from[0]; a <= to[0]; a++) {
          const std::uint64_t key =
              key_of(size_class, wrapped(cells, a, 0), wrapped(cells, b, 1), wrapped(cells, c, 2));
          looked++;
          for (int n = first[bucket_of(key)]; n >= 0; n = entries[n].next) {
            looked++;
            if (entries[n].key == key) visit(entries[n].number);
          }
        }
    return looked;
  }

 private:
  struct SizeClass {
    double largest;    // radius
    int cells[3];
    double per_length[3];
    int count = 0;
  };
  struct Entry {
    std::uint64_t key;
    int number, next;
  };
  static std::uint64_t key_of(int size_class, int a, int b, int c)
  {
    constexpr int bits = 19;
    const auto part = [](int k) { return static_cast<std::uint64_t>(k) & ((1U << bits) - 1U); };
    return ((static_cast<std::uint64_t>(size_class) << bits | part(a)) << bits | part(b)) << bits |
           part(c);
  }
  std::size_t bucket_of(std::uint64_t key) const
  {
    return static_cast<std::size_t>((key * 0x9e37'79b9'7f4a'7c15U) >> shift);
  }
  static int wrapped(const SizeClass &cells, int k, int d)
  {
    return k < cells.cells[d] ? k : k - cells.cells[d];
  }
  void make_buckets(std::size_t least);
  void link(int entry);
  int cell_of(const SizeClass &cells, double at, int d) const;
  void range_of(const SizeClass &cells, const Vector3<double> &x, double reach, int (&from)[3],
                int (&to)[3]) const;

  GridBox box;
  double skin;
  std::vector<SizeClass> classes;
  std::vector<int> first;    // by bucket
  std::vector<Entry> entries;
  int shift;
};

}    // namespace Talus

#endif
