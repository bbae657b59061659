// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of particles with a granular wall of LAMMPS: added one by one, computed several at a
// time by the kernel of its contact law, and returned in the same order, as forces or, for outputs,
// as reports. Lever arms against a wall are full radii.

#ifndef TALUS_FIX_WALL_BATCH_H
#define TALUS_FIX_WALL_BATCH_H

#include "base/aligned_vector.h"
#include "laws/contact_batch.h"
#include "laws/contact_energy.h"
#include "material/law_table.h"
#include "particles/change_record.h"
#include "system/granular_spec.h"

#include <functional>
#include <vector>

namespace Talus {

/// The law of a wall, and where LAMMPS keeps the history of a contact. Shared by threads.
struct WallLaw {
  LawTable table;    ///< of one row, for all types of particles
  /// Of each value that LAMMPS keeps: its index in ContactBatch::history, -1: not used.
  std::vector<int> history_index;

  /// Of a model without a reason_of_model(), after the init() of its fix.
  void take(const Model &model);
  /// How far a contact lasts beyond zero overlap (length).
  double pulloff_distance(double radius, double wall_radius) const;

  const ContactLaw &law() const { return table.law(0); }
  const ContactCoefficients &row() const { return table.coefficients(0); }
};

class WallBatch {
 public:
  struct Contact {
    int atom;
    const double *separation;    ///< from the wall to the center of the particle
    double distance;             ///< its length
    double radius, mass;
    double wall_radius;    ///< 0: flat, < 0: the particle is inside of the curvature
    const double *velocity, *wall_velocity, *omega;
    double temperature_difference;    ///< of the wall over the particle; 0 if no heat is conducted
    double *history;    ///< as LAMMPS keeps it, or nullptr; must stay until the batch is computed
    int part = -1;      ///< of the wall, see ContactReport
    const ChangeRecord *change = nullptr;    ///< of the particle's velocities, for an account
  };

  WallBatch();

  /// dt is 0 while a run is set up. `account`: nullptr, or asks for the work of the contacts.
  void begin_step(const WallLaw &wall_law, double time_step, const WorkAccount *work_account)
  {
    law = &wall_law;
    dt = time_step;
    account = work_account;
    work = EnergyByCause{};
    filled = 0;    // an error may have left some
    kept = 0;
  }
  /// After a step, whose contacts are added again, for report().
  void begin_report(double time_step)
  {
    dt = time_step;
    account = nullptr;
    filled = 0;
    reported = 0;
  }
  void add(const Contact &contact);
  bool is_full() const { return filled == ContactBatch::width; }
  struct Result {
    int atom;
    double force[3], torque[3], separation[3], heat_flow;
  };
  /// Computes all, calls deliver(result) for each, and empties the batch.
  template <class Deliver> void compute(Deliver deliver)
  {
    run();
    for (int k = 0; k < filled; k++) deliver(result(k));
    filled = 0;
  }
  /// In the place of compute(): visit(contact) for each, which changes nothing.
  void report(ContactData requested, const std::function<void(const ContactReport &)> &visit);

  /// Since begin_step(), if there is an account.
  EnergyByCause work;

 private:
  void set_lanes(int end);
  void run();
  void set_change(int lane, const Contact &contact);
  void add_to_account();
  void set_torques(int end);
  void keep_forces(int end);
  void find_last(int lane, ContactReport &found);
  Result result(int lane) const;

  const WallLaw *law = nullptr;
  double dt = 0.0;
  const WorkAccount *account = nullptr;
  int filled = 0;

  using Lane = double[ContactBatch::width];
  using Lanes = double[3][ContactBatch::width];

  /// Of contacts of the last step, a batch in each. Not all laws of LAMMPS have the history to
  /// compute it again.
  struct LastForces {
    int atoms[ContactBatch::width];
    alignas(64) Lanes force, torque_per_radius, twisting_torque;
  };
  AlignedVector<LastForces> last;
  std::size_t kept = 0, reported = 0;    // contacts

  ContactBatch batch;
  int atoms[ContactBatch::width], parts[ContactBatch::width];
  double *histories[ContactBatch::width];
  alignas(64) Lanes separation, torque;
  alignas(64) Lane distance, radius, mass, wall_radius;
};

}    // namespace Talus

#endif
