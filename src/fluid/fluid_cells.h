// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The cells of a partner that computes a fluid, all of them, on every rank: which cells a grain is in, and with which
// share of it. Fields of grains are sums of what they have times their shares, fields of the fluid at grains are sums of
// what cells have times the same shares: the adjoint, so that nothing is lost between both.
//
// Shares of a grain are not negative and add up to 1 to rounding: where cells end, those that are there get all. They
// are a function of the place of the grain, its radius and the cells alone, also to the last bit, and come in an order
// that is.

#ifndef TALUS_FLUID_FLUID_CELLS_H
#define TALUS_FLUID_FLUID_CELLS_H

#include <array>
#include <vector>

namespace Talus {

class FluidCells {
 public:
  struct Share {
    int cell;    ///< number, from 0; one may come twice, across a period
    double weight;
  };
  /// Of the box along x, y, z, where it begins and how long it is; 0: it has no period.
  struct Periods {
    std::array<double, 3> begin, length;
  };

  virtual ~FluidCells() = default;
  virtual int size() const = 0;
  virtual double volume(int cell) const = 0;
  /// Of a grain at x, in any period. Returns whether it is in the cells, else there are no shares.
  virtual bool find_shares(const double *x, double radius, std::vector<Share> &shares) const = 0;
  /// The cell that is nearest to a place outside.
  virtual int nearest_to(const double *x) const = 0;
};

}    // namespace Talus

#endif
