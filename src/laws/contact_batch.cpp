// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/contact_batch.h"

#include <algorithm>
#include <iterator>

namespace Talus {

void ContactBatch::clear()
{
  for (auto *vector :
       {normal, velocity, surface_rotation, relative_omega, velocity_change, rotation_change,
        omega_change, normal_change, force, torque_per_radius, twisting_torque})
    for (int d = 0; d < 3; d++) std::fill(std::begin(vector[d]), std::end(vector[d]), 0.0);
  for (auto &value : history) std::fill(std::begin(value), std::end(value), 0.0);
  std::fill(std::begin(overlap), std::end(overlap), 0.0);
  std::fill(std::begin(inverse_distance), std::end(inverse_distance), 0.0);
  std::fill(std::begin(separated), std::end(separated), 0.0);
  std::fill(std::begin(pulloff_distance), std::end(pulloff_distance), 0.0);
  std::fill(std::begin(intersection_radius), std::end(intersection_radius), 0.0);
  std::fill(std::begin(temperature_difference), std::end(temperature_difference), 0.0);
  std::fill(std::begin(heat_flow), std::end(heat_flow), 0.0);
  std::fill(std::begin(arm_loss), std::end(arm_loss), 0.0);
  std::fill(std::begin(arm_difference), std::end(arm_difference), 0.0);
  std::fill(std::begin(inverse_mass), std::end(inverse_mass), 1.0);
  std::fill(std::begin(inverse_radius), std::end(inverse_radius), 1.0);
  std::fill(std::begin(between.adhesive_share), std::end(between.adhesive_share), 1.0);
  std::fill(std::begin(coefficients), std::end(coefficients), 0);
}

}    // namespace Talus
