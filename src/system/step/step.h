// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// One step, as the run style makes it (the order is that of the Verlet loop of LAMMPS):
//
//   advance()             the integrator moves the particles
//   begin_forces()        may they be in the records after this step?
//   update_proxies()      messages leave; with overlap they are on their way during
//   compute_contacts()    forces between particles, and of bodies that join, in canonical order
//
// and where the particles are. In the arrays of LAMMPS particles are moved at once, and proxies are those of LAMMPS. In
// the records steps are made that StepsInRecords tells, with the same bits (see contact/contact_pipeline.h). The
// particles come back to the arrays for every step with output, a fix of LAMMPS at its end or new neighbor lists, and at
// the end of a run, also of one that ends in an error.
//
//   step.cpp          the step
//   particle_home.cpp where the particles are

#ifndef TALUS_SYSTEM_STEP_STEP_H
#define TALUS_SYSTEM_STEP_STEP_H

#include "contact/contact_pipeline.h"
#include "particles/particle_state.h"
#include "system/contacts/run_contacts.h"
#include "system/exchange/proxy_states.h"
#include "system/host/system_fix.h"
#include "system/monitor/time_step_monitor.h"
#include "system/step/integrators.h"
#include "system/step/largest_move.h"

#include "lmptype.h"
#include "pointers.h"

#include <functional>
#include <optional>
#include <vector>

namespace LAMMPS_NS {
class Fix;
}

namespace Talus {

class GranularSystem;

class Step : protected LAMMPS_NS::Pointers {
 public:
  /// What it changes of the system, which owns all of it, and this.
  struct Parts {
    std::optional<ContactPipeline> &contacts;    ///< there whenever Step is called
    Integrators &movers;
    RunContacts &for_outputs;
    LAMMPS_NS::TimeStepMonitor &time_step;
  };
  Step(LAMMPS_NS::LAMMPS *lmp, GranularSystem &owner, const Parts &parts);

  // ---- a step

  /// Moves the owned particles of an integrator's group, unless it places them itself: at the latest
  /// while the next compute_contacts() goes on. Called by all integrators of the run in their order.
  /// Members of the groups with these bits do not fall.
  void advance(const LAMMPS_NS::Fix *integrator, const RecordStep &step, int frozen_groups = 0);
  /// Of particles that are to be moved on the way through the records: now, so that they may be
  /// looked at.
  void complete_move() { contacts().motion().complete(); }
  /// After particles have moved: largest distance of an owned particle from where it was when
  /// neighbor lists were made, or a little more; and exactly. Infinity if that is not known.
  double moved_at_most() { return largest_move.at_most(contacts()); }
  double moved_since_rebuild() { return largest_move.exactly(contacts()); }
  /// Others have moved particles, at the end of a step.
  void forget_moves() { largest_move.forget(); }
  /// The forces of all contacts between particles. `tally`, if given, is called for each of them; `virial` is made
  /// that of them all, if it is given, which needs no tally and has no part of particles with a shape.
  void compute_contacts(const std::function<void(const TalliedContact &)> *tally,
                        VirialSums *virial);
  /// Changes of velocities are kept: for second order, and for the work of contacts.
  bool needs_changes() const { return needs_changes(parts.movers.order()); }

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
  bool may_be_asked() const { return !stays_in_records || others_look(); }
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
  /// Some of them, ghosts as well: their state.
  void show(const std::vector<int> &some);
  /// On the way of a step, when proxies are under way or have come: this rank is about to number pairs again, and has to
  /// find all particles in the arrays.
  void leave_records_for_pairs();
  /// New neighbor lists are due: the particles come back to the arrays of LAMMPS.
  void begin_rebuild();
  /// The same between two steps, or at the end of a run, however it ends: with the forces that will
  /// move them in the next step. Returns whether they were in the records.
  bool return_to_arrays();

 private:
  ContactPipeline &contacts() { return *parts.contacts; }
  const ContactPipeline &contacts() const { return *parts.contacts; }
  ParticleView view() const;
  bool others_look() const;
  void make_pairs_known();
  void complete_step();
  void complete_step_where(bool integrating, bool placing);
  bool needs_changes(int order) const;
  void find_changes(ContactStep &step, int order, bool ghosts_in_arrays);
  float weight_of_changes(bool setting_up) const;
  void compute_around_proxies(ContactStep &step);
  void leave_records(bool with_forces);

  GranularSystem &system;
  Parts parts;
  ProxyStates proxies;
  LargestMove largest_move;
  bool stays_in_records = false;    // after this step
  bool brought = false;             // this rank alone has left the records in this step
  LAMMPS_NS::bigint shown = -1;     // last step that was
};

}    // namespace Talus

#endif
