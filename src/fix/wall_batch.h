// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of particles with a granular wall of LAMMPS on their way through the kernels of its
// contact law: they are put in one by one, computed side by side, and handed back in the same
// order, as forces or, for outputs, as a survey. Lever arms against a wall are full radii.

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

/// The law of a wall, and where LAMMPS keeps what a contact remembers. Shared by threads.
struct WallLaw {
  LawTable table;    ///< of one row, for all types of particles
  /// Of each value that LAMMPS keeps: its place with us, -1: not used.
  std::vector<int> places;

  /// Of a model without a reason_of_model(), after the init() of its fix.
  void take(const Model &model);
  /// How far a contact lasts beyond zero overlap (length).
  double reach(double radius, double wall_radius) const;

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
    int part = -1;      ///< of the wall, see SurveyedContact
    const ChangeRecord *change = nullptr;    ///< of the particle's velocities, for an account
  };

  WallBatch();

  /// dt is 0 while a run is set up. `account`: nullptr, or asks for the work of the contacts.
  void begin_step(const WallLaw &its, double time_step, const WorkAccount *its_account)
  {
    law = &its;
    dt = time_step;
    account = its_account;
    work = EnergyByCause{};
    filled = 0;    // an error may have left some
    kept = 0;
  }
  /// Behind a step, of which the same contacts are added again, for survey().
  void begin_survey(double time_step)
  {
    dt = time_step;
    account = nullptr;
    filled = 0;
    surveyed = 0;
  }
  void add(const Contact &contact);
  bool is_full() const { return filled == ContactBatch::width; }
  struct Result {
    int atom;
    double force[3], torque[3], separation[3], heat_flow;
  };
  /// Computes all and begins anew: deliver(result) for each.
  template <class Deliver> void compute(Deliver deliver)
  {
    run();
    for (int k = 0; k < filled; k++) deliver(result(k));
    filled = 0;
  }
  /// In the place of compute(): visit(contact) for each, which changes nothing.
  void survey(Ask ask, const std::function<void(const SurveyedContact &)> &visit);

  /// Since begin_step(), if there is an account.
  EnergyByCause work;

 private:
  void set_lanes(int end);
  void run();
  void set_change(int lane, const Contact &contact);
  void add_to_account();
  void set_torques(int end);
  void keep_forces(int end);
  void find_last(int lane, SurveyedContact &found);
  Result result(int lane) const;

  const WallLaw *law = nullptr;
  double dt = 0.0;
  const WorkAccount *account = nullptr;
  int filled = 0;

  using Lane = double[ContactBatch::width];
  using Lanes = double[3][ContactBatch::width];

  /// Of contacts of the last step, a batch in each. Not all laws of LAMMPS remember what would tell
  /// it again.
  struct LastForces {
    int atoms[ContactBatch::width];
    alignas(64) Lanes force, moment, twisting_torque;
  };
  AlignedVector<LastForces> last;
  std::size_t kept = 0, surveyed = 0;    // contacts

  ContactBatch batch;
  int atoms[ContactBatch::width], parts[ContactBatch::width];
  double *histories[ContactBatch::width];
  alignas(64) Lanes separation, torque;
  alignas(64) Lane distance, radius, mass, wall_radius;
};

}    // namespace Talus

#endif
