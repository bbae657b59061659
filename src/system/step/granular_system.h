// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Owner of all state that Talus has of a LAMMPS instance. It makes steps and rebuilds, and gives
// access to its parts, each with one job: laws, masses, large bodies, integrators, the account of
// energies, contacts for outputs, and so on. The commands (pair style, fixes, computes,
// communication, run style) hold a reference and call the part that they need; they do not call
// each other.
//
// A step is made by Step, from the move to the forces; new neighbor lists by Rebuild.

#ifndef TALUS_SYSTEM_STEP_GRANULAR_SYSTEM_H
#define TALUS_SYSTEM_STEP_GRANULAR_SYSTEM_H

#include "contact/contact_pipeline.h"
#include "history/contact_memory.h"
#include "material/pair_coeffs.h"
#include "particles/particle_state.h"
#include "system/bodies/large_bodies.h"
#include "system/contacts/contact_range.h"
#include "system/contacts/contact_store.h"
#include "system/contacts/effective_masses.h"
#include "system/contacts/energy_account.h"
#include "system/contacts/neighbor_source.h"
#include "system/contacts/run_contacts.h"
#include "system/exchange/direct_exchange.h"
#include "system/exchange/exchange_switch.h"
#include "system/host/system_fix.h"
#include "system/loads/external_loads.h"
#include "system/monitor/contact_monitor.h"
#include "system/monitor/run_monitor.h"
#include "system/monitor/time_step_monitor.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/attached_pair.h"
#include "system/step/integrators.h"
#include "system/step/neighbor_lists.h"
#include "system/step/rebuild.h"
#include "system/step/setup_state.h"
#include "system/step/step.h"
#include "system/step/steps_in_records.h"
#include "system/step/weights.h"

#include "lmptype.h"
#include "pointers.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Fix;
class Pair;
}    // namespace LAMMPS_NS

namespace Talus {

class StateExchange;

class GranularSystem : protected LAMMPS_NS::Pointers {
 public:
  /// The system of a LAMMPS instance: made when it is first asked for, and gone with the last
  /// command that holds it.
  static std::shared_ptr<GranularSystem> of(LAMMPS_NS::LAMMPS *lmp);
  ~GranularSystem() override;
  GranularSystem(const GranularSystem &) = delete;
  GranularSystem &operator=(const GranularSystem &) = delete;

  // ---- parts

  /// Laws between all types, as the script gives them; and with their coefficients as the kernels
  /// have them.
  Talus::PairCoeffs &laws() { return pair_coeffs; }
  const LawTable &law_table();
  /// After init_pair_style(): at which distances particles touch.
  const ContactRange &range() const { return contact_range; }
  /// That contacts feel.
  LAMMPS_NS::EffectiveMasses &masses() { return effective_masses; }
  /// Where pairs that may touch are found.
  const LAMMPS_NS::NeighborSource &neighbors() const { return neighbor_source; }
  /// Contacts between particles as they are computed.
  const ContactPipeline &pipeline() const { return *contact_pipeline; }
  /// What contacts remember.
  ContactMemory &memory() { return contact_memory; }
  /// The fix that moves it with the particles, or nullptr; and where it is made.
  LAMMPS_NS::FixContactStore *store() const { return store_of_memory.get(); }
  ContactStore &contact_store() { return store_of_memory; }
  LargeBodies &bodies() { return large_bodies; }
  const Integrators &integrators() const { return movers; }
  Weights &weights() { return gravity; }
  ExternalLoads &external_loads() { return loads_of_others; }
  EnergyAccount &account() { return energies; }
  /// Of the last step, for outputs.
  const RunContacts &contacts() const { return run_contacts; }
  /// What a run warns about; registered by all who check something.
  LAMMPS_NS::RunMonitor &run_monitor() { return monitors; }
  ExchangeSwitch &exchange() { return exchange_switch; }
  StepsInRecords &steps_in_records() { return record_steps; }
  NeighborLists &lists() { return neighbor_lists; }
  Step &step() { return step_of_run; }
  Rebuild &rebuild() { return rebuild_of_lists; }
  /// With what the last run was set up.
  SetupState &setup_state() { return state_at_setup; }

  /// Particles that are not spheres, nullptr: all are. Of one command, from its constructor to its destructor.
  ShapedParticles *shapes() const { return shaped.get(); }
  ShapedParticles &define_shapes(LAMMPS_NS::Fix *command, ShapeTable table);
  void drop_shapes();

  // ---- the pair style

  const AttachedPair &pair_style() const { return attached; }
  /// In the constructor of a pair style, and in its destructor. false: there is one already.
  bool attach(LAMMPS_NS::Pair *pair, const AttachedPair::Traits &traits);
  void detach(const LAMMPS_NS::Pair *pair);
  /// In its init_style().
  void init_pair_style();
  /// The same, before it, collective: "", or why contacts cannot have a history here.
  std::string reason_against_history();
  double memory_usage() const
  {
    return contact_pipeline->memory_usage() + neighbor_source.memory_usage();
  }

  /// For snapshots, between two runs: what is neither of particles nor of fixes. When it is restored histories are
  /// in the store, and particles in the slots that they had.
  void exchange_state(StateExchange &x);
  /// Of that, contacts between spheres in the last step.
  void exchange_contacts(StateExchange &x) { contact_pipeline->exchange_contacts(x); }

 private:
  explicit GranularSystem(LAMMPS_NS::LAMMPS *lmp);
  void prepare_laws();

  // the pair style
  AttachedPair attached;
  ContactMemory contact_memory;    // goes after those who have something in it
  ContactStore store_of_memory;
  Talus::PairCoeffs pair_coeffs;
  std::optional<int> prepared;    // revision of pair_coeffs that the pipeline has
  std::string announced;          // last description of the laws in the log

  // particles, pairs, contacts
  std::optional<ContactPipeline> contact_pipeline;    // always there; replaced with each pair style
  LAMMPS_NS::NeighborSource neighbor_source;
  LAMMPS_NS::EffectiveMasses effective_masses;
  ContactRange contact_range;
  LAMMPS_NS::ContactMonitor monitor;
  LAMMPS_NS::TimeStepMonitor time_step;
  LAMMPS_NS::RunMonitor monitors;
  Integrators movers;
  EnergyAccount energies;
  RunContacts run_contacts;

  ExchangeSwitch exchange_switch;

  std::unique_ptr<ShapedParticles> shaped;
  Weights gravity;
  StepsInRecords record_steps;
  NeighborLists neighbor_lists;
  SetupState state_at_setup;
  ExternalLoads loads_of_others;
  Step step_of_run;
  Rebuild rebuild_of_lists;
  LargeBodies large_bodies;    // goes before what it tells of itself
};

}    // namespace Talus

#endif
