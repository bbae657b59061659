# Read by the build of LAMMPS (CMAKE_PROJECT_lammps_INCLUDE): headers that nearly all of its sources include are compiled
# once. Half of the time of a source of LAMMPS is that of reading them.
cmake_language(DEFER CALL target_precompile_headers lammps PRIVATE
  <algorithm> <cmath> <cstring> <map> <string> <vector> <mpi.h>
  <atom.h> <comm.h> <domain.h> <error.h> <force.h> <memory.h> <modify.h> <neigh_list.h> <neighbor.h> <pointers.h> <update.h>)
