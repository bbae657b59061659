// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// compute ID all penalty/stats: contacts and the energies that they store and dissipate, pairs of
// particles and large bodies together, of any pair style of Talus. doc/compute_contacts.md is
// the user's page.

#ifndef LMP_COMPUTE_PENALTY_STATS_H
#define LMP_COMPUTE_PENALTY_STATS_H

#include "compute.h"

#include "system/contacts/bond_account.h"
#include "system/step/granular_system.h"

#include <memory>

namespace LAMMPS_NS {

class ComputePenaltyStats : public Compute, private Talus::ContactObserver {
 public:
  ComputePenaltyStats(class LAMMPS *, int, char **);
  ~ComputePenaltyStats() override;
  void init() override;
  void setup() override;

  /// candidate pairs, contacts, largest overlap/radius, elastic energy; energy dissipated since the
  /// first run with this compute by normal damping, by friction, by rolling and spinning
  /// resistance; messages and bytes of one exchange of proxies (all ranks), seconds packing and
  /// unpacking them, seconds waiting for them (mean of ranks): zeros without comm_proxy; energy that
  /// bonds store, and that their damping and breaking have dissipated: zeros without accelerated ones.
  void compute_vector() override;

 private:
  bool asks_for_work() const override { return true; }
  /// Sums over the contacts of this rank.
  struct ContactSums {
    Talus::EnergyByCause stored;
    double contacts = 0.0, deepest_in_body = 0.0;
  };
  double radius_of(int i) const;
  ContactSums sum_contacts() const;
  Talus::BondEnergies energies_of_bonds() const;

  std::shared_ptr<Talus::GranularSystem> system;
  bool started = false;
  Talus::EnergyByCause before;    ///< dissipated when the first run began
  Talus::BondEnergies bonds_before;
};

}    // namespace LAMMPS_NS

#endif
