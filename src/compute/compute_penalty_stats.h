// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// compute ID all penalty/stats: contacts and the energies that they store and dissipate, pairs of
// particles and large bodies together, of any pair style of Talus. doc/compute_penalty_stats.md is the user's page.

#ifndef LMP_COMPUTE_PENALTY_STATS_H
#define LMP_COMPUTE_PENALTY_STATS_H

#include "compute.h"

#include "system/granular_system.h"

#include <memory>

namespace LAMMPS_NS {

class ComputePenaltyStats : public Compute {
 public:
  ComputePenaltyStats(class LAMMPS *, int, char **);
  ~ComputePenaltyStats() override;
  void init() override;

  /// candidate pairs, contacts, largest overlap/radius, elastic energy; energy dissipated since the
  /// first run with this compute by normal damping, by friction, by rolling and spinning
  /// resistance; messages and bytes of one exchange of proxies (all ranks), seconds packing and
  /// unpacking them, seconds waiting for them (mean of ranks): zeros without comm_proxy.
  void compute_vector() override;

 private:
  /// Sums of this rank over the pair style and all bodies.
  struct Energies {
    double elastic = 0.0, normal = 0.0, tangential = 0.0, resistance = 0.0;
  };
  Energies energies_here() const;

  std::shared_ptr<Talus::GranularSystem> system;
  bool started = false;
  Energies before;    ///< when this compute was defined
};

}    // namespace LAMMPS_NS

#endif
