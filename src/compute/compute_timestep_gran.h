// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// compute ID group timestep/gran: critical time steps (see system/monitor/critical_time_step.h) and the
// present time step as a fraction of each. doc/compute_timestep_gran.md is the user's page.

#ifndef LMP_COMPUTE_TIMESTEP_GRAN_H
#define LMP_COMPUTE_TIMESTEP_GRAN_H

#include "compute.h"
#include "system/monitor/critical_time_step.h"
#include "system/step/granular_system.h"

#include <memory>

namespace LAMMPS_NS {

class ComputeTimestepGran : public Compute {
 public:
  ComputeTimestepGran(class LAMMPS *, int, char **);
  ~ComputeTimestepGran() override;
  void init() override;

  /// contact, rayleigh, hertz, then dt over each of them; stable, dt over it. 0 where not defined.
  void compute_vector() override;

 private:
  std::shared_ptr<Talus::GranularSystem> system;
  CriticalTimeStep critical;
};

}    // namespace LAMMPS_NS

#endif
