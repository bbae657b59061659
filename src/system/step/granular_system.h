// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Owner of all state that Talus has of a LAMMPS instance. It makes steps and rebuilds, and gives
// access to its parts, each with one job: laws, masses, large bodies, integrators, the account of
// energies, contacts for outputs, and so on. The commands (pair style, fixes, computes,
// communication, run style) hold a reference and call the part that they need; they do not call
// each other.
//
//   granular_system.cpp   life, the pair style, laws
//   step.cpp              one step, from the move to the forces, and where the particles are
//   rebuild.cpp           from old neighbor lists to new ones
//
// A step is made in the arrays of LAMMPS, or, if only Talus looks at the particles in it, in the
// records of the contacts (see contact/contact_pipeline.h), with the same bits.

#ifndef TALUS_SYSTEM_STEP_GRANULAR_SYSTEM_H
#define TALUS_SYSTEM_STEP_GRANULAR_SYSTEM_H

#include "contact/contact_pipeline.h"
#include "material/pair_coeffs.h"
#include "particles/particle_state.h"
#include "system/bodies/large_bodies.h"
#include "system/contacts/contact_range.h"
#include "system/contacts/effective_masses.h"
#include "system/contacts/energy_account.h"
#include "system/contacts/neighbor_source.h"
#include "system/contacts/run_contacts.h"
#include "system/exchange/direct_exchange.h"
#include "system/exchange/exchange_switch.h"
#include "system/exchange/proxy_states.h"
#include "system/host/system_fix.h"
#include "system/loads/external_loads.h"
#include "system/monitor/contact_monitor.h"
#include "system/monitor/run_monitor.h"
#include "system/monitor/time_step_monitor.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/definitions.h"
#include "system/step/integrators.h"
#include "system/step/largest_move.h"
#include "system/step/made_lists.h"
#include "system/step/steps_in_records.h"
#include "system/step/weights.h"

#include "lmptype.h"
#include "pointers.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Fix;
class FixContactStore;
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
  /// What particles carry along of their contacts; nullptr before the first init_pair_style().
  LAMMPS_NS::FixContactStore *store() const { return contact_store; }
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
  MadeLists &made_lists() { return lists; }
  /// With what the last run was set up.
  Definitions &definitions() { return set_up_with; }

  /// Particles that are not spheres, nullptr: all are. Of one command, from its constructor to its destructor.
  ShapedParticles *shapes() const { return shaped.get(); }
  ShapedParticles &define_shapes(LAMMPS_NS::Fix *command, ShapeTable table);
  void drop_shapes();

  // ---- the pair style

  /// What a pair style demands of the system.
  struct StyleTraits {
    std::string name;    ///< as scripts have it, for messages
    /// The Coulomb limit acts on stored displacements also while a run is set up, as in the stock
    /// styles; else histories are only read then.
    bool limits_at_setup = false;
    /// Runs also where two particles may touch on both sides of a period: with a warning, for the
    /// stock style does not tell these contacts apart either.
    bool allows_small_period = false;
  };
  /// In the constructor of a pair style, and in its destructor. false: there is one already.
  bool attach(LAMMPS_NS::Pair *pair, const StyleTraits &traits);
  void detach(const LAMMPS_NS::Pair *pair);
  bool has_pair_style() const { return pair != nullptr; }
  /// Of the pair style that is attached, or the last one.
  const std::string &style_name() const { return style.name; }
  /// In its init_style().
  void init_pair_style();
  /// The same, before it, collective: "", or why contacts cannot have a history here.
  std::string reason_against_history();
  /// All pairs are computed here: it is not part of hybrid, or the only one. Valid in init() of LAMMPS
  /// and after it.
  bool pair_style_is_alone() const;
  /// "" if it is computed in each step, alone or with other sub-styles, else why not, as text for
  /// messages. The same.
  std::string reason_of_pair_style() const;
  double memory_usage() const
  {
    return contact_pipeline->memory_usage() + neighbor_source.memory_usage();
  }

  // ---- a step

  /// Moves the owned particles of an integrator's group, unless it places them itself: at the latest
  /// while the next compute_contacts() goes on. Called by all integrators of the run in their order.
  /// Members of the groups with these bits do not fall.
  void advance(const LAMMPS_NS::Fix *integrator, const RecordStep &step, int frozen_groups = 0);
  /// Of particles that are to be moved on the way through the records: now, so that they may be
  /// looked at.
  void complete_move() { contact_pipeline->complete_move(); }
  /// After particles have moved: largest distance of an owned particle from where it was when
  /// neighbor lists were made, or a little more; and exactly. Infinity if that is not known.
  double moved_at_most() { return largest_move.at_most(*contact_pipeline); }
  double moved_since_rebuild() { return largest_move.exactly(*contact_pipeline); }
  /// The forces of all contacts between particles. `tally`, if given, is called for each of them.
  void compute_contacts(const std::function<void(const TalliedContact &)> *tally);
  /// Changes of velocities are kept: for second order, and for the work of contacts.
  bool needs_changes() const { return needs_changes(movers.order()); }

  // ---- where particles live

  /// The particles where they are now, for forces other than those between particles, and for those
  /// who move them.
  ParticleState particles();
  /// Lets a fix do its part of a step in the arrays of LAMMPS: now, or when the particles return
  /// there.
  void complete_step_of(SystemFix &fix);
  /// At the start of a run, after set-up. Collective; `pairs_computed`: the run style calls the pair
  /// style.
  void start_run(bool pairs_computed);
  /// Before the forces of a step are computed: whether its particles will be in the arrays of
  /// LAMMPS after it, which then receive forces. `tallied`: energies or virials are asked for in
  /// it.
  bool begin_forces(LAMMPS_NS::bigint step, bool tallied);
  /// Outputs may ask for what the forces of the present step are: LAMMPS looks at it, a fix that
  /// reads at its end, or a group. What computes forces keeps them for that.
  bool may_be_asked() const
  {
    const FixCalls &calls = record_steps.fix_calls();
    return !stays_in_records || calls.somebody_looks() || calls.groups_may_ask();
  }
  /// Updates the proxies, after begin_forces(); pending on return if `overlap`.
  void update_proxies(bool overlap);
  /// Around the pair style in a step in the records: other sub-styles of a hybrid one find particles
  /// in the arrays of LAMMPS, where they add their forces to those of contacts; these are taken
  /// from there in the end. Returns whether that is to come: forces are to be cleared there in
  /// between, and summed up before the end.
  bool begin_pair_styles();
  void end_pair_styles();
  /// Shows particles in the arrays of LAMMPS, and goes on in the records: to those who read them
  /// at the end of a step, or before forces other than those of pairs are added.
  void show_step();
  void show_particles();
  /// New neighbor lists are due: the particles come back to the arrays of LAMMPS.
  void begin_rebuild();
  /// The same between two steps, or at the end of a run, however it ends: with the forces that will
  /// move them in the next step. Returns whether they were in the records.
  bool return_to_arrays();

  // ---- rebuild: called by FixContactStore, in this order

  /// Puts histories aside. Unless the pairs stay they are gone then until renumber_pairs(), and
  /// memory is free for others.
  void keep_history(HistoryStore &to, HistoryStore::Scope scope, bool pairs_stay);
  void release_pairs() { contact_pipeline->release(); }
  /// New neighbor lists are due: finds the pairs, and their histories.
  void renumber_pairs();
  /// A run has ended, and what belongs to particles has been put aside.
  void end_contacts_of_run();

  /// For snapshots, between two runs: what is neither of particles nor of fixes. When it is restored histories are
  /// in the store, and particles in the slots that they had.
  void exchange_state(StateExchange &x);
  /// Pairs as they are; and where they are to be taken from at the next rebuild, nullptr: found.
  std::shared_ptr<const ContactPipeline::Lists> pair_lists() { return contact_pipeline->lists(); }
  void take_pairs_from(const std::shared_ptr<const ContactPipeline::Lists> &lists_of_then)
  {
    given_pairs = lists_of_then;
  }
  /// Of that, contacts between spheres in the last step.
  void exchange_contacts(StateExchange &x) { contact_pipeline->exchange_contacts(x); }

 private:
  explicit GranularSystem(LAMMPS_NS::LAMMPS *lmp);
  void create_store();
  void prepare_laws();
  void find_pairs();

  ParticleView view() const;
  void change_order_of_histories();
  NeighborView without_shapes(const NeighborView &all);
  void complete_step();
  void complete_step_where(bool integrating, bool placing);
  bool needs_changes(int order) const;
  void find_changes(ContactStep &step, int order);
  float weight_of_changes(bool setting_up) const;
  void compute_around_proxies(ContactStep &step);
  void leave_records(bool with_forces);

  // the pair style
  LAMMPS_NS::Pair *pair = nullptr;
  StyleTraits style{"gran/penalty"};
  LAMMPS_NS::FixContactStore *contact_store = nullptr;
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
  ProxyStates proxies;

  std::unique_ptr<ShapedParticles> shaped;
  Weights gravity;
  StepsInRecords record_steps;
  MadeLists lists;
  std::shared_ptr<const ContactPipeline::Lists> given_pairs;
  bool stays_in_records = false;    // after this step
  LAMMPS_NS::bigint shown = -1;     // last step that was
  LargestMove largest_move;
  Definitions set_up_with;
  ExternalLoads loads_of_others;
  LargeBodies large_bodies;    // goes before what it tells of itself
};

}    // namespace Talus

#endif
