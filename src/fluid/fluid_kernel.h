// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How a grain is spread over the cells of a fluid around its center.

#ifndef TALUS_FLUID_FLUID_KERNEL_H
#define TALUS_FLUID_FLUID_KERNEL_H

#include <algorithm>

namespace Talus {

struct FluidKernel {
  enum class Shape {
    TOP_HAT,    ///< evenly over a ball
    GAUSSIAN    ///< exp(-r^2/width^2), up to `cut` widths
  };
  static constexpr double cut = 3.0;

  Shape shape = Shape::TOP_HAT;
  /// Length, 0 or more: diameter of the ball, which is not smaller than the grain; or that of the Gaussian.
  double width = 0.0;

  /// Radius of the ball of a grain with this radius.
  double ball(double radius) const { return std::max(0.5 * width, radius); }
};

}    // namespace Talus

#endif
