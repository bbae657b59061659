// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The work that contacts take from particles, over all steps in which a compute needs it: of pairs,
// of large bodies and of walls. GranularSystem begins each step; code that computes contacts adds
// its work, and computes read the sum, or receive it by particle (see contact_observer.h).
//
// Energies are in units of the script.

#ifndef TALUS_SYSTEM_CONTACTS_ENERGY_ACCOUNT_H
#define TALUS_SYSTEM_CONTACTS_ENERGY_ACCOUNT_H

#include "base/state_exchange.h"
#include "laws/contact_energy.h"
#include "system/contacts/contact_observer.h"

#include "pointers.h"

#include <vector>

namespace Talus {

class Integrators;

class EnergyAccount : protected LAMMPS_NS::Pointers {
 public:
  EnergyAccount(LAMMPS_NS::LAMMPS *lmp, const Integrators &of_script) :
      Pointers(lmp), integrators(of_script)
  {
  }

  /// In the constructor of a compute, and drop_observer() in its destructor.
  void add_observer(ContactObserver *one) { observers.push_back(one); }
  void drop_observer(const ContactObserver *one);
  bool has_observers() const { return !observers.empty(); }
  /// In this step the work of contacts is accounted for.
  bool is_asked() const;

  /// A pair style begins: nothing has been taken yet.
  void clear() { settled = of_step.sum = EnergyByCause{}; }
  /// Before the contacts of a step are computed, or `again` those of the last one, for the next run.
  /// Returns where the contacts between particles add theirs, or nullptr if no output needs it.
  WorkAccount *begin_step(bool again);
  /// For the contacts of a large body or wall in a step: an empty sum, and the same particles.
  WorkAccount part_of_step() const;
  void exchange_state(StateExchange &x) { x(settled, of_step.sum); }
  /// The sum of such a part.
  void add(const EnergyByCause &of_part) { of_step.sum += of_part; }

  /// What contacts of this rank have taken in steps that were accounted for, up to the time of the
  /// velocities.
  EnergyByCause work() const { return settled + counted_of_last_step() * of_step.sum; }
  /// Of what the last step has taken that part is in the velocities by now: half of it if an
  /// integrator has given the second half of the kick, else nothing.
  double counted_of_last_step() const;

 private:
  double time_at_setup() const;

  const Integrators &integrators;
  std::vector<ContactObserver *> observers;
  EnergyByCause settled;    // before the step
  WorkAccount of_step;
};

}    // namespace Talus

#endif
