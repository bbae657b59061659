/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

   Co-simulation: steering large bodies (fix large/body ... move external) of a LAMMPS instance from
   C or C++ through the library interface of LAMMPS. Nothing to link but liblammps.

   All functions are collective: every MPI rank of the instance calls them, with the same arguments,
   and gets the same numbers. Units are those of the input script. Call them between runs:

     talus_set_state(lmp, "wheel", state, 10);       // where the wheel is to be in 10 steps
     talus_run(lmp, 10);
     talus_get_load(lmp, "wheel", load);             // force, torque at that time

   A state is 13 numbers: position of the reference point (3), orientation as a quaternion w x y z
   of length 1 (4), velocity of the reference point (3), angular velocity about the axes of space
   (3). A bad state (not finite, no unit quaternion, or so far away that the body would go more than
   the skin in a step) ends in an error of LAMMPS; ask lammps_has_error() if your LAMMPS throws
   exceptions. Include LAMMPS' library.h before this file. */

#ifndef TALUS_H
#define TALUS_H

#include <locale.h>
#include <stdio.h>
#include <string.h>

#define TALUS_STATE_SIZE 13
#define TALUS_LOAD_SIZE 6

/* Writes " x" as LAMMPS reads it, also where the program prints numbers with a decimal comma. Returns the
   number of characters, as snprintf. */
static inline int talus_write_number(char *to, size_t size, double x)
{
  const char *point = localeconv()->decimal_point;
  const size_t length = strlen(point);
  char text[64], *at;
  snprintf(text, sizeof text, " %.17g", x);
  at = strstr(text, point);
  if (at) {
    *at = '.';
    memmove(at + 1, at + length, strlen(at + length) + 1);
  }
  return snprintf(to, size, "%s", text);
}

/* The body is to have this state `after` steps from now; 0: at once, going on with its velocity. */
static inline void talus_set_state(void *lmp, const char *id, const double *state, int after)
{
  char command[1024];
  int k, n = snprintf(command, sizeof command, "fix_modify %s state", id);
  for (k = 0; k < TALUS_STATE_SIZE && n < (int) sizeof command; k++)
    n += talus_write_number(command + n, sizeof command - n, state[k]);
  if (n < (int) sizeof command) snprintf(command + n, sizeof command - n, " after %d", after);
  lammps_command(lmp, command);
}

static inline double talus_number(void *lmp, const char *id, int k)
{
  /* global, vector: a copy that is ours to free */
  double *value = (double *) lammps_extract_fix(lmp, id, 0, 1, k, 0);
  const double result = value ? *value : 0.0;
  if (value) lammps_free(value);
  return result;
}

/* The state of the body at the present step. */
static inline void talus_get_state(void *lmp, const char *id, double *state)
{
  int k;
  for (k = 0; k < TALUS_STATE_SIZE; k++) state[k] = talus_number(lmp, id, TALUS_LOAD_SIZE + k);
}

/* Force (3) and torque about the reference point (3) of the particles on the body, in the last
   step. */
static inline void talus_get_load(void *lmp, const char *id, double *load)
{
  int k;
  for (k = 0; k < TALUS_LOAD_SIZE; k++) load[k] = talus_number(lmp, id, k);
}

/* Steps without the set-up of a new run: after one `run 0` at the beginning. */
static inline void talus_run(void *lmp, int steps)
{
  char command[64];
  snprintf(command, sizeof command, "run %d pre no post no", steps);
  lammps_command(lmp, command);
}

#endif
