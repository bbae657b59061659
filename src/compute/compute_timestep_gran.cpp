// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "compute/compute_timestep_gran.h"

#include "error.h"
#include "update.h"

using namespace LAMMPS_NS;

ComputeTimestepGran::ComputeTimestepGran(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), system(Talus::GranularSystem::of(lmp)), critical(lmp)
{
  if (narg > 3) error->all(FLERR, 3, "compute timestep/gran: surplus word '{}'", arg[3]);
  vector_flag = 1;
  size_vector = 8;
  extvector = 0;
  vector = new double[size_vector]();
}

ComputeTimestepGran::~ComputeTimestepGran()
{
  delete[] vector;
}

void ComputeTimestepGran::init()
{
  if (!system->pair_style().is_there())
    error->all(
        FLERR,
        "Compute timestep/gran requires one pair style gran/penalty, or one that is accelerated by "
        "the suffix talus: see 'Talus: styles of this run' in the log");
}

void ComputeTimestepGran::compute_vector()
{
  invoked_vector = update->ntimestep;
  critical.compute(system->laws(), system->pipeline(), groupbit);
  const double steps[3] = {critical.contact, critical.rayleigh, critical.hertz};
  for (int n = 0; n < 3; n++) {
    vector[n] = steps[n];
    vector[n + 3] = steps[n] > 0.0 ? update->dt / steps[n] : 0.0;
  }
  vector[6] = critical.stable;
  vector[7] = critical.stable > 0.0 ? update->dt / critical.stable : 0.0;
}
