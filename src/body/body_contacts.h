// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts between the owned particles of a rank and one large body, through the same laws and
// kernels as contacts between particles. Knows nothing of the host.
//
//   at a rebuild   find_candidates()
//   every step     compute()

#ifndef TALUS_BODY_BODY_CONTACTS_H
#define TALUS_BODY_BODY_CONTACTS_H

#include "body/large_body_shape.h"
#include "contact/contact_batch.h"
#include "contact/contact_energy.h"
#include "contact/law_table.h"
#include "contact/record.h"

#include <vector>

namespace Talus {

/// The host's arrays, rows of three doubles. Forces and torques are added to.
struct BodyParticleView {
  int owned;
  const double *x, *v, *omega;
  const double *radius, *mass;
  const double
      *mass_override;    ///< nullptr, or per particle: > 0 replaces its mass (infinity: frozen)
  const int *type;       ///< counts from 1
  double *f, *torque;
};

/// What the particles of one rank do to the body: force, and torque about its reference point.
struct BodyLoad {
  Vector3<double> force{0.0, 0.0, 0.0}, torque{0.0, 0.0, 0.0};
  double contacts = 0.0;
};

class BodyContacts {
 public:
  BodyContacts();

  /// Law of each particle type t against the body: row (t, t) of the table.
  void set_laws(const LawTable &table);

  /// Lists the particles (mask & group) that may touch the body while no particle moves further
  /// than `skin`. Others have no contact: their history is forgotten.
  void find_candidates(const LargeBodyShape &shape, const BodyParticleView &view, const int *mask,
                       int group, double skin);

  /// Adds the contact forces to the particles and returns their reaction. `advance` is false while
  /// a run is set up: histories are then only read. `account`, if given, receives the energies.
  BodyLoad compute(const LargeBodyShape &shape, const BodyParticleView &view, double dt,
                   bool advance, EnergyAccount *account = nullptr);

  /// For energies: after the integrator has moved velocities, before particles are renumbered.
  void account_for_move(const BodyParticleView &view, double dt, EnergyAccount &to) const;

  /// Largest overlap/radius of the last compute() with an account; 0 without contacts.
  double largest_overlap_ratio() const { return largest_overlap; }

  bool keeps_history() const { return with_history; }
  bool keeps_onset() const { return with_onset; }
  double memory_usage() const;

  /// One record for each particle (host's index), zero without contact; empty if no law keeps
  /// history. The owner resizes, moves and saves it with the particles.
  std::vector<Record> history;
  std::vector<Record> onset;    ///< the same, for laws that need to know how the contact began

 private:
  void add_lane(int lane, int atom, const SurfaceContact &contact, const BodyParticleView &view);
  void flush(int law, int count, const LargeBodyShape &shape, const BodyParticleView &view,
             double dt, bool advance, BodyLoad &load);
  void keep_history(int lane);
  void account_for_lane(int lane, ContactLaw law, const BodyParticleView &view, double dt);
  void remember_velocities(const BodyParticleView &view);
  void forget(int atom);
  void apply(int lane, ContactLaw law, const LargeBodyShape &shape, const BodyParticleView &view,
             BodyLoad &load);

  LawTable laws;
  bool with_history = false, with_onset = false;
  std::vector<int> candidates;
  ContactBatch batch;
  EnergyAccount *energies = nullptr;
  double largest_overlap = 0.0;    // over radius
  std::vector<Vector3<double>> velocity_before,
      spin_before;    // of candidates, only with an account
  int atom_of_lane[ContactBatch::width];
};

}    // namespace Talus

#endif
