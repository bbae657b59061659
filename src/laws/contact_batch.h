// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A batch holds the state and the result of up to `width` contacts as structure of arrays.
// The code that knows the geometry fills the input arrays (pairs of spheres, or a sphere and a
// large body), a kernel turns them into forces, and the owner adds these up in its canonical order.

#ifndef TALUS_LAWS_CONTACT_BATCH_H
#define TALUS_LAWS_CONTACT_BATCH_H

#include "base/history_values.h"

namespace Talus {

/// Lanes that hold no contact may contain anything finite: kernels always run over the full width,
/// so that every contact is computed by the same vector instructions and no scalar tail exists.
struct ContactBatch {
  static constexpr int width = 64;
  static constexpr int history_size = most_history_values;

  // input, see ContactState
  alignas(64) double normal[3][width];
  alignas(64) double overlap[width];
  alignas(64) double velocity[3][width];
  alignas(64) double surface_rotation[3][width];
  alignas(64) double inverse_mass[width];
  alignas(64) double inverse_radius[width];
  alignas(64) double relative_omega[3][width];
  alignas(64) double intersection_radius[width];
  alignas(64) double inverse_distance[width];
  alignas(64) double arm_loss[width], arm_difference[width];
  alignas(64) double temperature_difference[width];
  alignas(64) double velocity_change[3][width], rotation_change[3][width], omega_change[3][width];
  alignas(64) double normal_change[3][width];
  alignas(64) double separated[width], pulloff_distance[width];
  double lag = 0.0;                       ///< of all
  alignas(64) int coefficients[width];    ///< row of the coefficient table

  /// Input and output, with the signs of the first body; HistoryLayout tells which law has which
  /// values. The first three change their sign if the bodies are exchanged.
  alignas(64) double history[history_size][width];

  // output, see ContactLanes; only laws with torques write the last two
  alignas(64) double force[3][width];
  alignas(64) double torque_per_radius[3][width];
  alignas(64) double twisting_torque[3][width];
  alignas(64) double heat_flow[width];    ///< only of laws that conduct heat

  /// Only of kernels that account for energies: work that normal damping, tangential forces and
  /// resistance take from the bodies in the step, see contact_work.h.
  static constexpr int num_causes = 3;
  alignas(64) double work[num_causes][width];

  /// What stages compute for later ones, see ContactLanes. Stays in the first-level cache.
  struct Between {
    alignas(64) double full_normal[3][width];    // only of synchronized laws
    alignas(64) double normal_velocity[width], mass[width], radius[width],
        impact_speed[width], age[width];
    alignas(64) double kn[width], kt[width], tangent_n[width], tangent_t[width],
        contact_radius[width], elastic[width], pulloff_force[width];
    alignas(64) double gn[width], gt[width], normal_force[width], critical_force[width],
        adhesive_share[width], uncorrected_force[width], delayed_force[width];
  } between;

  /// Puts a harmless contact of overlap zero into every lane. Call once after construction.
  void clear();
};

}    // namespace Talus

#endif
