// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A large body whose surface deforms, as programs see it that move its vertices (coupling/): what the command that
// defines it offers.

#ifndef TALUS_SYSTEM_DEFORMING_BODY_H
#define TALUS_SYSTEM_DEFORMING_BODY_H

#include "base/vector3.h"

#include <cstdint>
#include <string>
#include <vector>

namespace Talus {

/// Impulses of particles on vertices since the last exchange (force times time), of those that were
/// touched, ascending; the work done on all, and the time.
struct VertexImpulses {
  std::vector<std::int64_t> vertices;
  std::vector<Vector3<double>> impulses;
  double work = 0.0, time = 0.0;
};

class DeformingBody {
 public:
  using Places = std::vector<Vector3<double>>;

  /// Between two steps, collective, the same on all ranks: vertices are to be at these places, with these
  /// velocities (nullptr: those of the way), in so many steps; 0: at once. Returns "", or why not.
  virtual std::string guide_vertices(const Places &places, const Places *velocities, int steps) = 0;
  /// Between two steps, collective: begins anew.
  virtual VertexImpulses take_impulses() = 0;

 protected:
  ~DeformingBody() = default;    // never deleted through this interface
};

}    // namespace Talus

#endif
