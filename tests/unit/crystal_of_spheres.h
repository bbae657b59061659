// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A face-centered crystal of 108 spheres of diameter 1 that overlap a little, with a spin each: 12
// contacts hold a sphere inside. For second_order_reference.h.

#ifndef TALUS_TESTS_CRYSTAL_OF_SPHERES_H
#define TALUS_TESTS_CRYSTAL_OF_SPHERES_H

#include "second_order_reference.h"

#include <cmath>
#include <vector>

namespace second_order {

inline std::vector<Particle> crystal_of_spheres()
{
  const double edge = std::sqrt(2.0) * 0.9995;
  const Vec basis[] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  std::vector<Particle> particles;
  for (int cell = 0; cell < 27; cell++)
    for (const Vec &site : basis) {
      const Vec corner{cell / 9 * 1.0, cell / 3 % 3 * 1.0, cell % 3 * 1.0};
      const Vec spin{std::sin(1.0 + 37.0 * cell + site[0]), std::sin(2.0 + 91.0 * cell + site[1]),
                     std::sin(3.0 + 17.0 * cell + site[2])};
      particles.push_back(sphere(edge * (corner + site), {}, 0.02 * spin));
    }
  return particles;
}

/// Root mean square spin.
inline double spin_of(const std::vector<Particle> &particles)
{
  double sum = 0.0;
  for (const Particle &p : particles) sum += inner(p.w, p.w);
  return std::sqrt(sum / static_cast<double>(particles.size()));
}

}    // namespace second_order

#endif
