// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// One large body, owner of all that it is: shape, motion, law for each type of particles, contacts with their histories,
// the load that it bears, its vertices if they move, and the energies of its contacts. The command that defines it (fix
// large/body) hands over a spec and calls at the hooks of LAMMPS:
//
//   at the start of a run     init(), place()
//   new neighbor lists        find_particles()
//   particles have moved      advance()
//   forces                    [join_step(), add_to_slots(), by the system], compute()
//
//   large_body.cpp          life and steps
//   large_body_contacts.cpp lists of particles, questions
//   large_body_laws.cpp     laws of the types of particles
//   large_body_load.cpp     sums over ranks
//   large_body_state.cpp    restart files and snapshots
//
// Units are those of the script.

#ifndef TALUS_SYSTEM_BODIES_LARGE_BODY_H
#define TALUS_SYSTEM_BODIES_LARGE_BODY_H

#include "body/contact/body_contacts.h"
#include "body/contact/impulse_account.h"
#include "body/shape/large_body_shape.h"
#include "laws/given_law.h"
#include "material/contact_spec.h"
#include "system/bodies/large_body_monitor.h"
#include "system/bodies/large_body_motion.h"
#include "system/bodies/large_body_side.h"
#include "system/bodies/large_body_spec.h"
#include "system/bodies/large_body_surface.h"
#include "system/bodies/large_body_vertices.h"
#include "system/contacts/effective_masses.h"
#include "vtk/poly_data.h"

#include "pointers.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {
class Fix;
}

namespace Talus {

class GranularSystem;
class PairCoeffs;
class StateExchange;

class LargeBody : protected LAMMPS_NS::Pointers {
 public:
  /// `fix`: the command, whose group is that of the particles that the body touches.
  LargeBody(const LAMMPS_NS::Fix *fix, GranularSystem &system, LargeBodySpec spec,
            LAMMPS_NS::LAMMPS *lmp);
  ~LargeBody() override;
  LargeBody(const LargeBody &) = delete;
  LargeBody &operator=(const LargeBody &) = delete;

  const LAMMPS_NS::Fix *command() const { return fix; }
  int group_bits() const;
  /// For messages.
  std::string name() const;

  LargeBodyShape &shape() { return *body_shape; }
  const LargeBodyMotion &motion() const { return body_motion; }
  LargeBodySurface &surface() { return *body_surface; }
  /// nullptr: it is no mesh whose vertices move.
  LargeBodyVertices *vertices() { return moved_vertices.get(); }
  /// What it knows of the past, besides the histories of its contacts, which it has if keeps_history().
  bool has_state() const;
  bool keeps_history() const { return with_history; }
  /// As it is in this step; and the laws, after init().
  const BodyFrame &frame() const { return body_motion.frame(); }
  const LawTable &law_table() const { return contacts.law_table(); }

  // ---- hooks

  void init();
  /// Before the first forces of a run: to where it is at this step.
  void place() { body_motion.place(); }
  /// There are new neighbor lists. Collective.
  void find_particles();
  /// To this step from the one before, when particles have moved: its place, its vertices.
  void advance();
  /// No step is to come: a minimization.
  void stand_still();
  /// At the beginning of a step in the records: whether its forces will be added by add_to_slots().
  /// If not, nor are those of the bodies defined after it: forces on a particle are summed in the
  /// order of the commands.
  bool join_step();
  /// Adds the forces on the particles of slots begin ... end-1. Called by several threads at the
  /// same time, for ranges that together hold all owned particles.
  void add_to_slots(int thread, int begin, int end) { contacts.add_to_slots(thread, begin, end); }
  /// The forces of a step, unless they have been added so. `advance`: histories go on; `virial`:
  /// nullptr, or six for each owned particle, added to.
  void compute(bool advance, double *virial);
  /// "", or why contacts with the body are not of second order, and the cure.
  std::string reason_against_second_order();
  /// "", or where contacts with the body are not of second order nevertheless, as text for
  /// messages.
  std::string note_on_second_order() const;
  /// Why steps with this body cannot be made in the records; "" if they can.
  std::string needs_arrays() const;

  // ---- steered from outside, by programs and fix_modify state. Between two steps, collective, the same on all ranks. Both
  // return "", or why not.

  /// The body is to have this state in so many steps, 0: at once.
  std::string guide(const BodyState &state, int steps);
  /// Of a mesh whose vertices move: they are to be at these places, with these velocities (nullptr: those of the way).
  std::string guide_vertices(const MovingVertices::Places &places,
                             const MovingVertices::Places *velocities, int steps);

  // ---- load: force, torque about the reference point, contacts, of the last step

  /// Collective. Force and torque without rounding; only of bodies whose load is summed exactly.
  const BodyLoad &exact_load();
  /// Collective.
  const BodyLoad &load();

  // ---- what the particles have given to the body over many steps

  /// Between two steps: counts from the next set-up or step on, see ImpulseAccount. Collective, as all
  /// that follow.
  /// By one of several, by number; the point is that of the last one.
  void watch(const Vector3<double> &point, int watcher);
  bool is_watched() const { return impulses.has_value(); }
  /// Its last watcher ends it.
  void unwatch(int watcher);
  /// Between two steps, up to the velocities that particles have; to be read, begun anew or saved.
  ImpulseAccount &settled_impulses();

  /// For snapshots, between two runs. When it is restored list_particles() has to follow.
  void exchange_state(StateExchange &x);
  void list_particles();
  /// For restart files: of all ranks, collective; and the same read. `error`, `warning`: what does not fit, for messages.
  std::vector<double> state_of_all_ranks();
  struct RestartProblem {
    std::string error, warning;
  };
  RestartProblem restart_from(const double *begin, const double *end);

  // ---- energies and questions

  /// Collective: energy stored in the contacts, and the work they have taken from the particles
  /// and the body less what it has stored. Work is accounted for from the first question on, until
  /// a run in which it is not asked for.
  double energy();
  /// It is.
  bool accounts() const;
  /// visit(contact) for those of the last step on this rank, see SystemFix::for_each_contact().
  void for_each_contact(const ComputedContacts::VisitContact &visit) const
  {
    for_outputs.for_each(visit);
  }
  /// On this rank, now and when particles were listed again between two rebuilds.
  BodyFindings find_worst();
  /// Collective: the surface for ParaView as it is now; rank 0 gets all of it.
  VtkPolyData picture() { return body_surface->picture(frame()); }
  double memory_usage() const;

  /// sqrt(m/k) (time) of a particle of this type, mass and radius against the body, with the
  /// stiffness at this overlap; 0 without stiffness.
  double contact_period(int type, double mass, double radius, double overlap);
  /// Law and coefficients of contacts of particles of this type with the body.
  ContactLaw law_of(int type) const;
  /// See ContactSides.
  double stiffness_power(int type) const { return sides_of(type).stiffness_power(); }
  ContactCoefficients coefficients_of(int type) const { return sides_of(type).coefficients(); }

 private:
  void follow_region();
  void keep_history();
  void watch_steps();
  void begin_reduction();
  void finish_reduction();
  ParticleState view() const;
  BodyStep begin_forces(bool advance);
  BodyHeat heat();
  const int *mask_of_spheres();
  Eigen::AlignedBox3d bounds_of_focus(const ParticleState &particles, const int *mask);
  BodyFindings findings_now() const;
  MeshShape *moving_mesh();
  void find_frozen();
  void clear_frozen();
  void set_laws();
  void check_heat() const;
  const PairCoeffs &pairs_with(int type) const;
  ContactSides sides_of(int type) const;
  std::string note_on(int type) const;
  void announce_laws();
  void keep_records(bool old_ones);
  void change_order_of_histories();
  void collect_digits();
  bool sums_exactly() const { return body_motion.moves() || is_watched(); }
  void see_load();

  const LAMMPS_NS::Fix *fix;
  GranularSystem &system;
  std::unique_ptr<LargeBodyShape> body_shape;
  LargeBodyMotion body_motion;
  std::unique_ptr<LargeBodySurface> body_surface;
  std::unique_ptr<LargeBodyVertices> moved_vertices;
  LargeBodySide side;
  LargeBodyMonitor monitor;
  std::vector<ContactSpec> specs;    ///< by type
  int type_of_laws = 0;              ///< whose pairs have the laws; 0: `specs` are the laws
  std::optional<NumberOrVariable> temperature;
  bool with_history = false;
  int order_of_history = 0;    ///< of the integrator, by whose laws it is; 0: not known
  BodyContacts contacts;
  ComputedContacts for_outputs;
  std::vector<int> spheres;     ///< see mask_of_spheres()
  BodyFindings seen_between;    ///< before particles were listed again within a step
  LAMMPS_NS::EffectiveMasses masses;
  int already_frozen = 0;    ///< groups whose forces a fix freeze has set to zero before

  /// The sum is only that of the questions to this body; the system has its own.
  bool is_asked = false, was_asked = false, has_forces = false;
  bool joined = false;    ///< forces of this step have been added by the threads of the system
  WorkAccount account;
  double dissipated = 0.0;         ///< with what the springs of friction and resistance store
  double last_dissipated = 0.0;    ///< by the last step, and not in the other number

  BodyLoad mine, total;           ///< of this rank, and of all
  bool reduced = false;           ///< forces and torques of `total` are those of the last step
  bool total_is_known = false;    ///< all of it is
  ExactLoad exact;
  bool exact_is_known = false;    ///< it is of the last step
  std::optional<ImpulseAccount> impulses;
  static constexpr int size_digits = 6 * ExactSum::size;
  std::int64_t digits_here[size_digits] = {}, digits_of_all[size_digits] = {};
  MPI_Request reduction = MPI_REQUEST_NULL;

  std::set<int> watchers;    ///< while there are impulses
  std::string announced;     ///< last description of the laws in the log
};

}    // namespace Talus

#endif
