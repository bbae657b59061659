// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Spheres that overlap are moved apart: the energy of their overlaps, sum of d^2/2, is minimized by
// FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006), a damped motion. The mass of a sphere grows
// with the number of its contacts, so that a large one among a thousand small ones moves as stably,
// with the same time step, as they do. From random places this reaches solid fractions up to that of
// random close packing (O'Hern et al., Phys. Rev. E 68, 011306, 2003): .64 for equal spheres. One
// thread; the same bits on all machines that run the same program.

#ifndef TALUS_PACKING_SPHERE_PACKING_H
#define TALUS_PACKING_SPHERE_PACKING_H

#include "base/vector3.h"
#include "packing/nearest_image.h"
#include "packing/random_numbers.h"
#include "packing/sphere_grid.h"

#include <utility>
#include <vector>

namespace Talus {

/// Where spheres may be.
class PackingSpace {
 public:
  /// A center may be here.
  virtual bool contains(const Vector3<double> &x) const = 0;
  /// Somewhere in a box that has all of the space in it, each place as likely.
  virtual Vector3<double> draw(RandomNumbers &random) const = 0;
  /// Walls that a sphere reaches into: unit vector away from the wall, and overlap (length).
  virtual void find_walls(const Vector3<double> &x, double radius,
                          std::vector<std::pair<Vector3<double>, double>> &walls) const = 0;
  /// All of the space, and which directions are periodic: then with the period hi - lo.
  Vector3<double> lo, hi;
  bool periodic[3];
  GridBox box() const { return {lo, hi, {periodic[0], periodic[1], periodic[2]}}; }

 protected:
  ~PackingSpace() = default;    // never deleted through this interface
};

class SpherePacking {
 public:
  /// The spheres from number `fixed_from` on stay where they are.
  SpherePacking(const PackingSpace &space, std::vector<Vector3<double>> places,
                std::vector<double> radii, int fixed_from);

  /// Until no overlap is larger than `limit` times the smaller radius, at most that many steps.
  /// Gives up earlier if overlaps do not get smaller. Returns whether the limit holds.
  bool relax(double limit, int most_steps);

  /// The largest overlap over the smaller radius, as of the last step.
  double largest_overlap() const { return largest; }
  int steps() const { return step; }
  /// A measure of the work: cells and spheres that searches looked at, and pairs in all steps.
  long work() const { return looked; }
  /// In the order in which they were given.
  std::vector<Vector3<double>> places() const;

 private:
  struct Pair {
    int i, j;
  };
  void sort(double mean_radius);
  void find_pairs();
  void compute_forces();
  void move();

  const PackingSpace &space;
  NearestImage nearest;
  std::vector<Vector3<double>> x, v, f, x_of_list;
  std::vector<double> radius, mass;
  std::vector<int> contacts;
  std::vector<int> number;    // of each of the spheres that move, as it was given
  int movable;
  double skin;
  std::vector<Pair> pairs;
  std::vector<std::pair<Vector3<double>, double>> walls;
  double largest = 0.0;
  int step = 0;
  long looked = 0;

  // FIRE
  double dt = 0.1, mixing = 0.1;
  int downhill = 0;
};

}    // namespace Talus

#endif
