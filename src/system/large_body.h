// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// One large body as GranularSystem keeps it: its shape, its law for each type of particles, its
// contacts with their histories, the load that it bears and the energies of its contacts. The
// command that defines the body (fix large/body) says how it moves and calls at the hooks of
// LAMMPS:
//
//   at the start of a run     init()
//   new neighbor lists        list_particles()
//   forces                    [join_step(), add_to_slots(), by the system], compute()
//
//   large_body.cpp        life and steps
//   large_body_laws.cpp   laws of the types of particles
//   large_body_load.cpp   sums over ranks
//
// Units are those of the script.

#ifndef TALUS_SYSTEM_LARGE_BODY_H
#define TALUS_SYSTEM_LARGE_BODY_H

#include "body/contact/body_contacts.h"
#include "body/contact/impulse_account.h"
#include "body/shape/large_body_shape.h"
#include "laws/given_law.h"
#include "material/contact_spec.h"
#include "system/effective_masses.h"
#include "vtk/poly_data.h"

#include "pointers.h"

#include <cstdint>
#include <functional>
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

class DeformingBody;
class GranularSystem;
class PairCoeffs;
class StateExchange;
class SteeredBody;

class LargeBody : protected LAMMPS_NS::Pointers {
 public:
  /// `fix`: the command, whose group is that of the particles that the body touches.
  LargeBody(const LAMMPS_NS::Fix *fix, GranularSystem &system, LAMMPS_NS::LAMMPS *lmp);
  ~LargeBody() override;
  LargeBody(const LargeBody &) = delete;
  LargeBody &operator=(const LargeBody &) = delete;

  const LAMMPS_NS::Fix *command() const { return fix; }
  int group_bits() const;
  /// For messages.
  std::string name() const;

  // ---- definition: what follows must be called before the first run

  void set_shape(std::unique_ptr<LargeBodyShape> shape);
  LargeBodyShape &shape() { return *body_shape; }
  void set_law(int type, const ContactSpec &spec);
  /// In place of all laws: those of pairs with this type of particles, as they are when a run begins.
  void set_type_of_laws(int type) { type_of_laws = type; }
  bool has_type_of_laws() const { return type_of_laws > 0; }
  bool has_law(int type) const { return type_of_laws > 0 || spec_is_set[type]; }
  /// Programs may ask where it is, and steer it.
  void set_steered(SteeredBody &body) { steered = &body; }
  SteeredBody *as_steered() const { return steered; }
  /// The same of a mesh whose vertices move; its contacts then tell their forces on vertices.
  void set_deforming(DeformingBody &body, std::vector<TouchedCorners> *touched_corners)
  {
    deforming = &body;
    corners = touched_corners;
  }
  DeformingBody *as_deforming() const { return deforming; }
  /// Where the body is; changes as it moves. `moves`: ever; then its load is summed exactly, as that of
  /// a body that is watched is.
  void set_frame(const BodyFrame *body_frame, bool moves);
  /// Makes the surface for ParaView; called on all ranks, rank 0 gets all of it.
  void set_picture(std::function<VtkPolyData()> maker) { make_picture = std::move(maker); }
  /// Receives one entry for each contact of a step.
  void set_touched(std::vector<TouchedPart> *parts) { touched = parts; }
  /// After shape and laws: from now on histories are kept, if the laws have some.
  void keep_history();
  bool keeps_history() const { return with_history; }
  /// As it is in this step; and the laws, after init().
  const BodyFrame &present_frame() const { return *frame; }
  const LawTable &law_table() const { return contacts.law_table(); }
  /// By particle; the command moves them with the particles and saves them.
  BodyHistory &history() { return contacts.history; }

  // ---- hooks

  void init();
  void list_particles();
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

  // ---- load: force, torque about the reference point, contacts, of the last step

  /// Lets the sum over ranks go on until exact_load() is called.
  void begin_reduction();
  void finish_reduction();
  /// Collective. Force and torque without rounding; only of bodies whose load is summed exactly.
  const BodyLoad &exact_load();
  /// Collective.
  const BodyLoad &load();
  double contacts_here() const { return mine.contacts; }
  // ---- what the particles have given to the body over many steps

  /// Between two steps: counts from the next set-up or step on, see ImpulseAccount. Collective, as all
  /// that follow.
  /// By one of several, by number; the point is that of the last one.
  void watch(const Vector3<double> &point, int watcher);
  bool is_watched() const { return impulses.has_value(); }
  /// Its last watcher ends it.
  void unwatch(int watcher);
  /// When a step begins and the body has not moved yet.
  void begin_step();
  /// Between two steps, up to the velocities that particles have; to be read, begun anew or saved.
  ImpulseAccount &settled_impulses();

  /// Distance from the reference point within which all particles were when they were last listed.
  double reach() const { return contacts.reach(); }

  /// For snapshots, between two runs: load, energies and histories; list_particles() has to follow when they
  /// are restored.
  void exchange_state(StateExchange &x);

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
  /// Collective, see set_picture(): the surface as it is now.
  VtkPolyData picture() const { return make_picture(); }
  double memory_usage() const { return contacts.memory_usage() + for_outputs.memory_usage(); }

  /// sqrt(m/k) (time) of a particle of this type, mass and radius against the body, with the
  /// stiffness at this overlap; 0 without stiffness.
  double contact_period(int type, double mass, double radius, double overlap);
  /// Law and coefficients of contacts of particles of this type with the body.
  ContactLaw law_of(int type) const;
  /// See ContactSides.
  double stiffness_power(int type) const { return sides_of(type).stiffness_power(); }
  ContactCoefficients coefficients_of(int type) const { return sides_of(type).coefficients(); }

 private:
  ParticleState view() const;
  BodyStep begin_forces(bool advance);
  const int *mask_of_spheres();
  Eigen::AlignedBox3d bounds_of_focus(const ParticleState &particles, const int *mask);
  BodyFindings findings_now() const;
  MeshShape *moving_mesh();
  void find_frozen();
  void clear_frozen();
  void set_laws();
  const PairCoeffs &pairs_with(int type) const;
  ContactSides sides_of(int type) const;
  std::string note_on(int type) const;
  void announce_laws();
  void keep_records(bool old_ones);
  void change_order_of_histories();
  void collect_digits();
  bool sums_exactly() const { return moves || is_watched(); }
  void see_load();

  const LAMMPS_NS::Fix *fix;
  GranularSystem &system;
  std::unique_ptr<LargeBodyShape> body_shape;
  const BodyFrame *frame = nullptr;
  SteeredBody *steered = nullptr;
  DeformingBody *deforming = nullptr;
  bool moves = false;
  std::vector<TouchedPart> *touched = nullptr;
  std::vector<TouchedCorners> *corners = nullptr;
  std::function<VtkPolyData()> make_picture;
  std::vector<ContactSpec> specs;    ///< by type
  std::vector<bool> spec_is_set;
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
  int type_of_laws = 0;     ///< whose pairs have the laws; 0: `specs` are the laws
  std::string announced;    ///< last description of the laws in the log
};

}    // namespace Talus

#endif
