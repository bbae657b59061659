/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

   partner.py in C. In this folder, with the environment of the build folder (. build/env.sh) or of what is installed:

     mpicc partner.c $(pkg-config --cflags --libs talus) -o partner
     [mpirun -np 2] ./partner

   or by CMake: CMakeLists.txt. */

#include "library.h"
#include "talus.h"

#include <mpi.h>
#include <stdio.h>

static const double mass = 0.2, load = 10.0, damping = 20.0;    /* of the lid: kg, N, N s/m */
enum { EVERY = 20, EXCHANGES = 1000, Z = 2, VZ = 9 };

/* Errors are the same on all ranks. */
static void check(int code, const talus_partner *partner)
{
  if (code == TALUS_OK) return;
  fprintf(stderr, "%s\n", talus_error(partner));
  MPI_Abort(MPI_COMM_WORLD, 1);
}

int main(int argc, char **argv)
{
  char *words[] = {"press", "-log", "none", "-screen", "none"};
  double state[TALUS_STATE_SIZE], felt[TALUS_LOAD_SIZE], force = 0.0, time_step;
  talus_partner *partner = NULL;
  int rank;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  void *lmp = lammps_open(5, words, MPI_COMM_WORLD, NULL);
  lammps_file(lmp, "in.press");

  check(talus_open(lmp, TALUS_ALL_RANKS, &partner), NULL);
  check(talus_watch_body(partner, "lid", NULL), partner);
  check(talus_get_body_state(partner, "lid", state), partner);
  check(talus_get_time(partner, NULL, &time_step, NULL), partner);
  for (int n = 0; n < EXCHANGES; n++) {
    const double dt = EVERY * time_step;
    state[VZ] += dt * (force - load - damping * state[VZ]) / mass;
    state[Z] += dt * state[VZ];
    check(talus_put_body_state(partner, "lid", state, EVERY), partner);
    check(talus_advance(partner, EVERY), partner);
    check(talus_get_body_load(partner, "lid", felt), partner);
    force = felt[2] / felt[7];    /* impulse over time */
  }
  if (rank == 0) printf("lid at %.6f m, %.4f N of the grains\n", state[Z], force);
  check(talus_close(partner), NULL);
  lammps_close(lmp);
  MPI_Finalize();
  return 0;
}
