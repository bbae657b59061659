// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What travels with particles that have a shape, and their part of a snapshot.

#include "system/shapes/shaped_particles.h"

#include "system/bodies/large_body.h"
#include "system/step/granular_system.h"

#include "base/state_exchange.h"

#include "atom.h"
#include "memory.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace Talus {

void ShapedParticles::grow(int particles)
{
  memory->grow(quat, particles, size_orientation, "shape/gran:quat");
}

void ShapedParticles::copy(int from, int to)
{
  std::copy_n(quat[from], size_orientation, quat[to]);
}

/* Radius and mass at once, so that others are put at the right distance. */

void ShapedParticles::begin(int i)
{
  std::fill_n(quat[i], size_orientation, 0.0);
  set_sizes(i, i + 1);
}

int ShapedParticles::pack(int i, double *to) const
{
  std::copy_n(quat[i], size_orientation, to);
  return size_orientation;
}

int ShapedParticles::unpack(int i, const double *from)
{
  std::copy_n(from, size_orientation, quat[i]);
  return size_orientation;
}

/* Points are kept by pair as well: in a periodic box a run goes on with those of both sides as they are. */

void ShapedParticles::exchange_state(StateExchange &x)
{
  if (atom->nlocal) x.array(quat[0], 4L * atom->nlocal);
  pairs_here.exchange_state(x);
  for (LargeBody *body : system.bodies().in_order()) points_of(*body).exchange_state(x);
  if (x.restores()) orientations_were_set = true;
}

double ShapedParticles::memory_usage() const
{
  double bytes = static_cast<double>(size_orientation * sizeof(double)) * atom->nmax +
                 pairs_here.memory_usage() + shapes.memory_usage();
  for (const auto &[body, points] : bodies) bytes += points.memory_usage();
  return bytes;
}

}    // namespace Talus
