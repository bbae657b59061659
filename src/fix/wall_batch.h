// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of particles with a granular wall of LAMMPS on their way through the kernels of its
// contact law: they are put in one by one, computed side by side, and handed back in the same
// order. Lever arms against a wall are full radii.

#ifndef TALUS_FIX_WALL_BATCH_H
#define TALUS_FIX_WALL_BATCH_H

#include "laws/contact_batch.h"
#include "laws/contact_kernel.h"
#include "system/granular_spec.h"

#include <vector>

namespace Talus {

/// The law of a wall, and where LAMMPS keeps what a contact remembers. Shared by threads.
struct WallLaw {
  ContactLaw law;
  ContactCoefficients row;
  ContactKernel kernel;
  /// Of each value that LAMMPS keeps: its place with us, -1: not used.
  std::vector<int> places;

  /// Of a model without a reason_of_model(), after the init() of its fix.
  void take(const Model &model);
  /// How far a contact lasts beyond zero overlap (length).
  double reach(double radius, double wall_radius) const;
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
  };

  WallBatch() { batch.clear(); }

  /// dt is 0 while a run is set up.
  void begin_step(const WallLaw &its, double time_step)
  {
    law = &its;
    dt = time_step;
    filled = 0;    // an error may have left some
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

 private:
  void run();
  Result result(int lane) const;

  const WallLaw *law = nullptr;
  double dt = 0.0;
  int filled = 0;
  ContactBatch batch;
  int atoms[ContactBatch::width];
  double *histories[ContactBatch::width];
  double distances[ContactBatch::width], radii[ContactBatch::width];
};

}    // namespace Talus

#endif
