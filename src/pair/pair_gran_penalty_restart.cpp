// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Pair style gran/penalty: its laws in restart files.

#include "pair/pair_gran_penalty.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "utils.h"

using namespace LAMMPS_NS;

void PairGranPenalty::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      fwrite(&setflag[i][j], sizeof(int), 1, fp);
      fwrite(&system->laws().spec(i, j), sizeof(ContactSpec), 1, fp);
    }
}

void PairGranPenalty::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  if (!allocated) allocate();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      ContactSpec spec;
      if (comm->me == 0) {
        utils::sfread(FLERR, &setflag[i][j], sizeof(int), 1, fp, nullptr, error);
        utils::sfread(FLERR, &spec, sizeof spec, 1, fp, nullptr, error);
      }
      MPI_Bcast(&setflag[i][j], 1, MPI_INT, 0, world);
      MPI_Bcast(&spec, sizeof spec, MPI_BYTE, 0, world);
      if (setflag[i][j]) system->laws().set(i, j, spec);
    }
}

void PairGranPenalty::write_restart_settings(FILE *fp)
{
  fwrite(&system->laws().mix, sizeof system->laws().mix, 1, fp);
}

void PairGranPenalty::read_restart_settings(FILE *fp)
{
  if (comm->me == 0)
    utils::sfread(FLERR, &system->laws().mix, sizeof system->laws().mix, 1, fp, nullptr, error);
  MPI_Bcast(&system->laws().mix, sizeof system->laws().mix, MPI_BYTE, 0, world);
}
