// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Diameters of spheres to be made: a distribution by number, or by mass of spheres that all have
// the same density. Words of fill_region and fix pour/rate.

#ifndef TALUS_PACKING_SIZE_DISTRIBUTION_H
#define TALUS_PACKING_SIZE_DISTRIBUTION_H

#include "base/words.h"
#include "packing/random_numbers.h"

#include <vector>

namespace Talus {

class SizeDistribution {
 public:
  /// Reads `D`, `uniform lo hi`, `lognormal median sigma lo hi` or `discrete n D1 w1 ...`, and then
  /// `number` or `mass` if that is the next word.
  void parse(Words &words);
  bool is_set() const { return kind != Kind::NONE; }

  /// The diameter (length) that the share q of the number of spheres does not exceed, 0 < q < 1.
  double quantile(double q) const;
  double smallest() const;
  double largest() const;
  /// How many spheres have that volume together; it may be less than 1. An estimate beyond 1e5.
  double count_of(double volume) const;
  /// As near to the distribution as that many spheres can be, in random order.
  std::vector<double> diameters(int count, RandomNumbers &random) const;

 private:
  double mean_volume(int count) const;
  /// Lognormal: the share of its number that is below d, or, far above its median, minus that above: differences of
  /// shares are what is needed, and each is exact where it is small.
  double share_to(double d) const;

  enum class Kind { NONE, UNIFORM, LOGNORMAL, DISCRETE };

  Kind kind = Kind::NONE;
  bool by_mass = false;
  double lo = 0.0, hi = 0.0, median = 0.0, sigma = 0.0;
  std::vector<double> sizes, shares;    ///< discrete: ascending in no order; cumulated, last is 1
};

}    // namespace Talus

#endif
