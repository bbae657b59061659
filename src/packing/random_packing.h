// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A random packing of spheres of any sizes, made from the largest to the smallest. Spheres that differ
// by less than a factor of two are a stage: they are put to random places, beside those that are there
// as far as these leave room, and are then relaxed together with them. So small spheres start in the
// voids of large ones and not within them, from where they would have a long way. A stage has a few
// times as many spheres as the one before where the sizes matter, and each costs in proportion to its
// number.

#ifndef TALUS_PACKING_RANDOM_PACKING_H
#define TALUS_PACKING_RANDOM_PACKING_H

#include "packing/random_numbers.h"
#include "packing/sphere_packing.h"

#include <vector>

namespace Talus {

class SphereGrid;

class RandomPacking {
 public:
  /// Spheres to be packed, by their radii (length), beside others that stay where they are. `space`
  /// must outlive this.
  RandomPacking(const PackingSpace &space, std::vector<double> radii,
                std::vector<Vector3<double>> fixed, std::vector<double> fixed_radii);

  /// Places all spheres so that no overlap is larger than `limit` times the smaller radius, with at
  /// most that many steps of relaxation. Returns false, with places of no use, if that fails.
  bool pack(RandomNumbers &random, double limit, int most_steps);

  /// Centers, in the order of the radii.
  std::vector<Vector3<double>> places() const;
  /// The largest overlap over the smaller radius, as of the last step.
  double largest_overlap() const { return largest; }
  /// Of all stages.
  int steps() const { return step; }
  /// A measure of the work, as SpherePacking has it.
  long work() const { return looked; }

 private:
  void place(int end, RandomNumbers &random);
  Vector3<double> find_place(const SphereGrid &grid, double r, RandomNumbers &random);
  double overlap_at(const SphereGrid &grid, const Vector3<double> &at, double r, double enough);
  bool relax(double limit, int most_steps);

  const PackingSpace &space;
  NearestImage nearest;
  std::vector<int> order;    // from the largest sphere to the smallest, as they were given
  // those that stay, and behind them those that are packed, in this order
  std::vector<Vector3<double>> x;
  std::vector<double> radius;
  int num_fixed;
  double largest = 0.0;
  int step = 0;
  long looked = 0;
};

}    // namespace Talus

#endif
