// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact forces between particles and one large body: one batch for each thread, eight contacts at
// a time. Everything is computed in the frame of the body, in which the body is at rest and
// histories rotate with it; forces are rotated back. body_batch.cpp finds the contacts and runs the
// laws, body_batch_parts.cpp finds those with shapes of several contacts, body_batch_lanes.cpp gathers
// the particle data that laws read and scatters the results, body_batch_outputs.cpp keeps what outputs
// and warnings ask for, body_batch_vertices.cpp does what only meshes whose vertices move need.

#ifndef TALUS_BODY_CONTACT_BODY_BATCH_H
#define TALUS_BODY_CONTACT_BODY_BATCH_H

#include "base/aligned_vector.h"
#include "base/lanes.h"
#include "body/contact/body_candidates.h"
#include "body/contact/body_history.h"
#include "body/contact/body_load.h"
#include "body/contact/body_step.h"
#include "body/contact/computed_contacts.h"
#include "body/motion/body_state.h"
#include "body/shape/large_body_shape.h"
#include "body/shape/moving_vertices.h"
#include "laws/contact_batch.h"
#include "laws/contact_energy.h"
#include "laws/deepest_contact.h"
#include "material/law_table.h"
#include "particles/particle_state.h"

#include <cstdint>
#include <vector>

namespace Talus {

/// One evaluation of all contacts of a body.
struct BodyTask {
  const LargeBodyShape &shape;
  const LawTable &laws;
  const BodyFrame &frame;
  const ParticleState &view;
  const BodyCandidates &candidates;
  const int
      *index;    ///< of each candidate in `view`; `spare` more behind the last, any that exist
  BodyHistory &history;
  const BodyStep &step;
  bool with_history;      ///< of any law
  int history_records;    ///< see LawTable

  static constexpr int spare = 128;

  /// How far a contact of a candidate that has begun lasts beyond zero overlap (length).
  double pulloff_distance_of(std::size_t c, double radius) const
  {
    return step.ends_at_zero_overlap ? 0.0 : laws.pulloff_distance(row_of(c), radius);
  }

  /// Row of the table for a candidate; types are not read where all have the same law.
  int row_of(std::size_t c) const
  {
    if (laws.uniform()) return 0;
    const int type = view.type(candidates.atom(c));
    return laws.row(type, type);
  }
};

class BodyBatch {
 public:
  BodyBatch();

  /// Forgets the results of the last step; `with_exact`: those without rounding as well.
  void start(bool with_exact);

  /// Computes the contacts of candidates begin ... end-1. Adds the forces to the particles, and
  /// keeps histories if the laws have them. Several threads may do so at the same time, each with a
  /// batch and candidates of its own; nothing else of other candidates is read.
  void compute(const BodyTask &task, std::size_t begin, std::size_t end);

  // results since start()
  BodyLoad load;
  ExactLoad exact;                                    ///< if asked for
  AlignedVector<TouchedPart> touched;                 ///< if asked for
  std::vector<TouchedCorners> corners;                ///< the same
  std::vector<ContactReport> contacts_for_outputs;    ///< the same
  double stored_energy = 0.0;                         ///< the same, see ComputedContacts
  EnergyByCause work;                                 ///< if asked for

  /// The deepest contact since forget_deepest(), if it is deeper than DeepestContact::watched.
  const DeepestInBody &deepest() const { return deepest_so_far; }
  void forget_deepest() { deepest_so_far = {}; }

 private:
  using Lanes = double[3][ContactBatch::width];

  using Motion = ParticleState::Motion;

  // contacts
  unsigned bits_of_law(std::size_t first, int low, int high) const;
  void look_at_eight(std::size_t first, int low, int high);
  void load_spheres(const int *index, int low, int high);
  const EightSpheres &spheres_in_body();
  unsigned touching_eight(std::size_t first, int low, int high);
  unsigned just_ended(std::size_t first, const EightSpheres &in_body, unsigned bits);
  void take(std::size_t first, unsigned bits);
  void put_side_by_side(std::size_t first, unsigned bits);
  void prefetch_contacts(std::size_t first, unsigned bits) const;
  void take_surface(unsigned bits);
  void look_at_eight_by_parts(std::size_t first, int low, int high);
  const EightSpheres &as_far_as_contacts_last(std::size_t first, const EightSpheres &in_body,
                                              unsigned asked);
  unsigned begun_of(std::size_t first, unsigned bits) const;
  bool has_begun(std::size_t c) const { return task->with_history && task->history.count(c) > 0; }
  void take_told(std::size_t first, const EightSpheres &in_body, unsigned bits, unsigned touching);
  void take_eight(std::size_t first, unsigned bits);
  int find_by_parts(std::size_t c, const Vector3<double> &x, double r,
                    SurfaceContact *contacts_found) const;
  void take_found(std::size_t c, const EightSpheres &in_body, int k, int count);
  void prefetch_parts(std::size_t first) const;
  void append(std::size_t candidate, int k, int n);
  void flush();
  void notice_deeper();
  void account();
  int part_of(int lane) const;
  void begin_records();
  void complete_records();
  ContactReport report_of_lane(int lane) const;
  void record_parts();

  // meshes whose vertices move
  void find_points(int k);
  void see_from_vertices(Motion &m, int k);
  void see_from_vertices_order_2(Motion &m, int k);
  void turn_histories(int k);
  void record_corners();

  // lanes
  void gather();
  void gather_changes(const int *index, int k);
  void see_changes_from_body(int k);
  void see_from_body(Motion &m, int k);
  void run_past(Motion &m, int k);
  void gather_masses(Motion &m, int k) const;
  void gather_temperatures();
  void add_heat();
  Vector3<double> normal_before(int lane, const Vector3<double> &velocity) const;
  void gather_normal_changes(int k);
  void set_normal_change(int lane, const Vector3<double> &normal, const Vector3<double> &before);
  /// Its laws ask for what normals have turned in the last step.
  bool needs_normal_changes() const
  {
    return law.tangential().second_order && law.has_friction() && task->history.keeps_normals();
  }
  void gather_histories(int k);
  void gather_resistance();
  void gather_coefficients();
  void keep_histories();
  void rotate_to_space();
  EightRows torques(int k) const;
  void add_to_particles();
  void add_load();
  void add_virials();
  void sum_up();
  const std::uint32_t *slots() const
  {
    return task->history.several() ? slot_of_lane : candidate_of_lane;
  }

  // of the range that is being computed
  const BodyTask *task = nullptr;
  ContactLaw law;
  int law_index = 0;

  ContactBatch batch;
  std::vector<ContactState<double>> before_laws;    // by lane, for outputs
  int filled = 0, end = 0;    // lanes in use, and the same up to a multiple of eight
  std::uint32_t candidate_of_lane[ContactBatch::width] = {};
  std::uint32_t slot_of_lane[ContactBatch::width] = {};    // only with several contacts
  int part_of_lane[ContactBatch::width] = {};    // the same, or if the surface is described
  alignas(64) Lanes place = {};                  // of particles, in space
  alignas(64) double radius[ContactBatch::width];
  // only of meshes whose vertices move
  SurfacePoint point_of_lane[ContactBatch::width];
  HistoryVectors vectors;    // of the law
  // only if the surface is described, else 0
  bool described = false;
  alignas(64) Lanes surface_velocity = {};
  alignas(64) double curvature[ContactBatch::width] = {};

  Vector3<Vec8> load_of_lanes[2];    // force and torque on the body
  double touching = 0.0;
  DeepestInBody deepest_so_far;
  // in space, in the frame of a body that moves, and with radii as far as contacts last
  EightSpheres spheres{}, seen{}, widened{};
  alignas(64) double pulloff[EightSpheres::width] = {};    // how much further than they are
  EightContacts contacts{};
  // of one sphere with several contacts: these, the slot of each, and the normal that it had
  SurfaceContact found[LargeBodyShape::max_parts];
  std::uint32_t slots_of_found[LargeBodyShape::max_parts] = {};
  Vector3<double> before[LargeBodyShape::max_parts] = {};
};

}    // namespace Talus

#endif
