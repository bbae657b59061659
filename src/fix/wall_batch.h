// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of particles with a granular wall of LAMMPS: added one by one, computed several at a
// time by the kernel of its contact law, and their forces are added in the same order, or, for
// outputs, reported. Lever arms against a wall are full radii.

#ifndef TALUS_FIX_WALL_BATCH_H
#define TALUS_FIX_WALL_BATCH_H

#include "base/aligned_vector.h"
#include "laws/contact_batch.h"
#include "laws/contact_energy.h"
#include "material/law_table.h"
#include "particles/particle_state.h"
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
    const double *wall_velocity;
    double temperature_difference;    ///< of the wall over the particle; 0 if no heat is conducted
    double *history;    ///< as LAMMPS keeps it, or nullptr; must stay until the batch is computed
    int part = -1;      ///< of the wall, see ContactReport
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
  TALUS_INLINE void add(const Contact &contact);
  bool is_full() const { return filled == ContactBatch::width; }
  struct Result {
    int atom;
    double force[3], torque[3], separation[3], heat_flow;
  };
  /// Computes all and adds their forces to the particles, which have the state of this step.
  void compute(const ParticleState &particles);
  /// visit(result) for each after that, where more of them is wanted than forces.
  template <class Visit> void for_each_result(Visit visit) const
  {
    for (int k = 0; k < filled; k++) visit(result(k));
  }
  /// Empties the batch.
  void clear() { filled = 0; }
  /// In the place of compute(): visit(contact) for each, which changes nothing.
  void report(const ParticleState &particles, ContactData requested,
              const std::function<void(const ContactReport &)> &visit);

  /// Since begin_step(), if there is an account.
  EnergyByCause work;

 private:
  void set_lanes(const ParticleState &particles);
  void set_change(int lane, const ChangeRecord *change);
  void add_to_account();
  void set_torques();
  void keep_forces();
  void find_last(int lane, ContactReport &found);
  Result result(int lane) const;

  const WallLaw *law = nullptr;
  double dt = 0.0;
  const WorkAccount *account = nullptr;
  int filled = 0;
  /// Lanes in use: those of the contacts, filled up to a multiple of eight.
  int end() const { return (filled + lanes - 1) / lanes * lanes; }

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
  /// A contact as it is added. A row is written and read whole: what is written number by number and
  /// read as a vector at once is late.
  struct alignas(64) Row {
    Record geometry;         // separation, distance
    Record sizes;            // radius, mass, radius of the wall, difference of temperatures
    Record wall_velocity;    // fourth place not used
  };
  Row rows[ContactBatch::width];
  alignas(64) Lanes torque;
  alignas(64) Lane radius;
};

TALUS_INLINE void WallBatch::add(const Contact &c)
{
  const int k = filled++;
  atoms[k] = c.atom;
  parts[k] = c.part;
  histories[k] = c.history;
  const double *s = c.separation, *v = c.wall_velocity;
  store(rows[k].geometry, four(s[0], s[1], s[2], c.distance));
  store(rows[k].sizes, four(c.radius, c.mass, c.wall_radius, c.temperature_difference));
  store(rows[k].wall_velocity, four(v[0], v[1], v[2], 0.0));
  if (!c.history) return;
  for (std::size_t n = 0; n < law->history_index.size(); n++)
    if (law->history_index[n] >= 0) batch.history[law->history_index[n]][k] = c.history[n];
}

}    // namespace Talus

#endif
