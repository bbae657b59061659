// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The canonical order of particles. Floating-point sums depend on their order, so contact forces
// are always summed in ascending (key, tag) of the partner, an order that no decomposition, sorting
// or thread count changes. The key is the place on a Morton curve where the particle was when the
// key was last refreshed: particles that are close in space are close in the order, and so in
// memory.

#ifndef TALUS_PARTICLES_CANONICAL_KEY_H
#define TALUS_PARTICLES_CANONICAL_KEY_H

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace Talus {

/// Spreads the lower 21 bits of v such that two zero bits follow each of them.
inline std::uint64_t spread_bits(std::uint64_t v)
{
  v &= 0x1fffff;
  v = (v | v << 32) & 0x001f00000000ffffULL;
  v = (v | v << 16) & 0x001f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  v = (v | v << 2) & 0x1249249249249249ULL;
  return v;
}

/// Key of a position (length units): cells of edge 1/inverse_cell, 2^20 of them on either side of
/// the origin; whatever lies beyond is counted to the outermost cell. Not-a-number maps to the
/// lowest cell.
inline std::uint64_t canonical_key(const double *x, double inverse_cell)
{
  constexpr double half = 1 << 20;
  std::uint64_t key = 0;
  for (int d = 0; d < 3; d++) {
    const double cell = std::floor(x[d] * inverse_cell) + half;
    const double inside = cell > 0.0 ? std::min(cell, 2.0 * half - 1.0) : 0.0;
    key |= spread_bits(static_cast<std::uint64_t>(inside)) << d;
  }
  return key;
}

}    // namespace Talus

#endif
