// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Particles that are named by their IDs, the same list on all ranks: where each of them is.

#ifndef TALUS_SYSTEM_HOST_PARTICLES_BY_ID_H
#define TALUS_SYSTEM_HOST_PARTICLES_BY_ID_H

#include "pointers.h"

#include <cstdint>
#include <string>
#include <vector>

namespace Talus {

class ParticlesById : protected LAMMPS_NS::Pointers {
 public:
  /// Between two steps; valid until particles move to other ranks.
  ParticlesById(LAMMPS_NS::LAMMPS *lmp, const std::vector<std::int64_t> &ids);

  /// Collective: "", or which particle does not exist, or is named twice although each is to be
  /// named `once`; for messages.
  std::string problem(bool once) const;

  std::size_t size() const { return here.size(); }
  /// visit(k, i) for each that this rank owns: its place in the list, and local index.
  template <class Visit> void for_each(Visit visit) const
  {
    for (std::size_t k = 0; k < here.size(); k++)
      if (here[k] >= 0) visit(k, here[k]);
  }

 private:
  const std::vector<std::int64_t> &named;
  std::vector<int> here;    // local index of each, -1: not on this rank
};

}    // namespace Talus

#endif
