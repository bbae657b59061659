// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "run/machines.h"

bool Talus::spans_machines(MPI_Comm world)
{
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(world, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  int ranks = 1, ranks_here = 1;
  MPI_Comm_size(world, &ranks);
  MPI_Comm_size(machine, &ranks_here);
  MPI_Comm_free(&machine);
  int mine = ranks_here < ranks, any = 0;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  return any != 0;
}
