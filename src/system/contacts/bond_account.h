// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What bonds between particles store, and the work that they take from them: a base of bond styles of Talus. The work of a
// step is that of the kick which its forces give, force times the mean of the velocities before and after it (and torques
// with angular velocities), as that of contacts (energy_account.h): half of it is known when forces are computed, the
// other half when particles have moved, which is asked for at the next step, or before particles change places in a
// rebuild.
//
// Energies are in units of the script, of this rank: its own particles, and half of bonds that another rank has as well.

#ifndef TALUS_SYSTEM_CONTACTS_BOND_ACCOUNT_H
#define TALUS_SYSTEM_CONTACTS_BOND_ACCOUNT_H

#include "particles/particle_state.h"

#include <vector>

namespace LAMMPS_NS {
class Bond;
}    // namespace LAMMPS_NS

namespace Talus {

struct BondEnergies {
  double stored = 0.0;
  double damped = 0.0,
         broken = 0.0;    ///< since the first step with work; `broken`: stored when they broke

  friend BondEnergies operator-(const BondEnergies &a, const BondEnergies &b)
  {
    return {a.stored - b.stored, a.damped - b.damped, a.broken - b.broken};
  }
};

class BondAccount {
 public:
  BondAccount() = default;
  BondAccount(const BondAccount &) = delete;
  BondAccount &operator=(const BondAccount &) = delete;
  /// nullptr of styles of LAMMPS, and of none.
  static BondAccount *of(LAMMPS_NS::Bond *bond);

  /// Particles have moved by the last forces, and are about to change places. No other than that does it now.
  void complete_kick(const ParticleState &particles);
  /// Up to the time of the velocities; `counted`: EnergyAccount::counted_of_last_step().
  BondEnergies energies(double counted) const;

 protected:
  ~BondAccount() = default;    // never deleted through this
  /// Before forces are computed: what the last ones have done by now. `again`: in set-up, those of the last step, if
  /// there was one; `counted`: as above.
  void begin_step(const ParticleState &particles, double of_dt, bool again, double counted);
  /// Rows of three by owned particle, zeros after begin_step(), which receive the loads of bonds alone; torques are called for
  /// once in a step, by bonds that have them.
  double *force_of_bonds() { return forces.data(); }
  double *torque_of_bonds();
  void add_broken(double energy) { broken += energy; }
  /// These loads are there, and have been added to particles.
  void end_step(const ParticleState &particles);
  /// Not in this step: nothing is known of its forces.
  void leave_out_step() { forces.clear(); }
  virtual double stored_energy() const = 0;

 private:
  double half_of_work(const ParticleState &particles) const;

  std::vector<double> forces, torques;
  double dt = 0.0;
  bool half_is_done = false;    // by the last run, and is in `settled`
  double settled = 0.0,
         first_half = 0.0;    // taken before the last kick, and by the first half of it
  double broken = 0.0;
};

}    // namespace Talus

#endif
