/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

   Coupling: what programs call that share a simulation with Talus. Plain C; doc/coupling.md is the user's page, and says
   more of each call. Link with libtalus.so, which needs neither LAMMPS nor MPI; the instance of LAMMPS has Talus as a plugin
   (LAMMPS_PLUGIN_PATH, `plugin load`, or talus_load()).

   * Units are those of the input script, vectors are in the axes of the box, quaternions are w x y z.
   * Calls are made between runs. All are collective but those marked "local": every MPI rank of the instance makes them, in
     the same order, also those of several partners.
   * The partner lives on all ranks (root = TALUS_ALL_RANKS: all pass the same arguments and get the same results) or on one
     (root = its rank in the communicator of the instance: only its arguments are read and only its results are written;
     others may pass NULL and 0).
   * A call returns TALUS_OK or a code below, the same on all ranks, and then has done nothing, if not said otherwise;
     talus_error() has the text.
   * Arrays belong to the caller, in both directions. Nothing is kept of them after the call. */

#ifndef TALUS_H
#define TALUS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this interface; raised when a call changes its meaning. New calls do not raise it. */
#define TALUS_INTERFACE 2
#define TALUS_ALL_RANKS (-1)
#define TALUS_STATE_SIZE                                                                           \
  13 /* numbers of a body's state: position 3, quaternion 4, velocity 3, angular velocity 3 */
#define TALUS_LOAD_SIZE 8 /* numbers of a body's load: impulse 3, angular impulse 3, work, time */

enum {
  TALUS_OK = 0,
  TALUS_REFUSED = 1, /* an argument is wrong; nothing was changed */
  TALUS_HOST_ERROR =
      2, /* LAMMPS ended a command with an error; the instance may be used as after any error */
  TALUS_PARTNER_FAILED =
      3, /* talus_fail() was called on some rank, or ranks made different calls: all calls return this
                                 from then on */
  TALUS_NOT_LOADED = 4 /* no instance of LAMMPS has loaded the plugin, or another version of it */
};

typedef struct talus_partner talus_partner;
typedef struct talus_snapshot talus_snapshot;

/* ---- life ---------------------------------------------------------------------------------------- */

/* Local. The interface of the plugin that is loaded, 0: none is. */
int talus_interface_version(void);
/* `plugin load` with the file of this library, for programs that have not set LAMMPS_PLUGIN_PATH. */
int talus_load(void *lmp);
/* lmp: the instance (of lammps_open(), or `handle` of an instance in Python). */
int talus_open(void *lmp, int root, talus_partner **partner);
/* Before the instance is closed. The partner is gone, whatever the code: TALUS_PARTNER_FAILED if another rank fails at this
   time instead. */
int talus_close(talus_partner *partner);
/* Local. Text of the last call that did not return TALUS_OK, for one line of output; valid until the next call. NULL: of
   talus_open(), talus_load() and talus_close(). */
const char *talus_error(const talus_partner *partner);
/* Says on one rank, instead of any call that the others make, that the partner cannot go on. The calls of all ranks then
   return TALUS_PARTNER_FAILED with this text; no rank waits for ever. */
int talus_fail(talus_partner *partner, const char *why);

/* ---- time ---------------------------------------------------------------------------------------- */

/* Local. Time at the end of the last step, time step, number of the step. Any may be NULL. */
int talus_get_time(const talus_partner *partner, double *time, double *dt, int64_t *step);
/* As `run N`. The first call, and the first one after talus_set_up(), begins with the set-up of a run. */
int talus_advance(talus_partner *partner, int64_t steps);
/* The same for a time (time units), which must be a whole number of time steps to 1e-6 of one. */
int talus_advance_by(talus_partner *partner, double duration);
/* After commands of the script that change more than numbers: the next advance begins with the set-up of a run. Fixes,
   computes, regions, pair styles, laws, styles of communication and particles that come or go, or that a command has
   moved to other ranks, are noticed without it. */
int talus_set_up(talus_partner *partner);

/* ---- rigid bodies: fix large/body, by the ID of the fix ---------------------------------------------- */

/* The body, which is moved external, is to have this state after so many steps; 0: at once. See fix_modify state in
   doc/fix_large_body.md. */
int talus_put_body_state(talus_partner *partner, const char *body, const double *state,
                         int64_t steps);
/* Any body. */
int talus_get_body_state(talus_partner *partner, const char *body, double *state);
/* Loads of any body are summed from the next advance on. point: NULL, or the point of the body (body frame, from the reference
   point) about which angular impulses are, such as its center of mass; NULL: the reference point. */
int talus_watch_body(talus_partner *partner, const char *body, const double *point);
/* What the particles have given the body since the last call of this, or since it is watched: impulse (force time),
   angular impulse (force distance time), work (force distance), and the time. Begins anew. What bodies get, particles have
   lost, to rounding. Refused unless the body is watched. */
int talus_get_body_load(talus_partner *partner, const char *body, double *load);

/* ---- deforming meshes: fix large/body mesh ... move vertices ---------------------------------------- */

/* Numbers of vertices and triangles. */
int talus_get_mesh_size(talus_partner *partner, const char *body, int64_t *vertices,
                        int64_t *triangles);
/* Places of the vertices now (3 each) and their numbers, from 0, of each triangle (3 each). Either may be NULL. */
int talus_get_mesh(talus_partner *partner, const char *body, double *x, int64_t *triangles);
/* All vertices are to be at these places after so many steps, 0: at once; on the way they go along straight lines at
   constant speed, then they rest. v: velocities that contacts are to see then and until the next call of this; on the way
   those go there linearly. NULL: those of the way, and then none. */
int talus_put_vertices(talus_partner *partner, const char *body, const double *x, const double *v,
                       int64_t steps);
/* Impulses (3 each) of the grains on vertices since the last call of this, only of vertices that were touched: how many,
   their numbers, the impulses, and the work done on all. numbers and impulses have room for all vertices. */
int talus_get_vertex_loads(talus_partner *partner, const char *body, int64_t *touched,
                           int64_t *numbers, double *impulses, double *work, double *duration);

/* ---- save and restore ---------------------------------------------------------------------------- */

/* Keeps the whole state in memory, with all bits: steps after talus_restore() repeat those after talus_save(). As many
   snapshots as memory holds. Each rank keeps its part: all pass where it goes, wherever the partner lives. A set-up that is due
   is made first. */
int talus_save(talus_partner *partner, talus_snapshot **snapshot);
/* Back to the state of the snapshot, which stays. Fixes must be those of then. */
int talus_restore(talus_partner *partner, const talus_snapshot *snapshot);
/* Local; at any time, also when the instance is gone. */
int talus_discard(talus_snapshot *snapshot);
/* Local. Memory of this rank (bytes). */
int64_t talus_snapshot_size(const talus_snapshot *snapshot);

/* ---- particles, by ID ------------------------------------------------------------------------------ */

/* Forces and torques (3 each, NULL: none) on n particles, in each step until the next call of this, which replaces all that
   this partner has put. n = 0: none from now on. What several partners put adds up. */
int talus_put_forces(talus_partner *partner, int64_t n, const int64_t *id, const double *force,
                     const double *torque);
/* A drag force c (u - v): coefficient c (force/velocity, > 0) and velocity u of the fluid (3 each), taken at the new velocity
   v of each step, so that no coefficient is too large; on spheres of clumps at the present one, with c times the time step
   at most their mass. Held and replaced as forces are. */
int talus_put_drag(talus_partner *partner, int64_t n, const int64_t *id, const double *coefficient,
                   const double *fluid_velocity);
/* Heat flow (energy/time) into particles that have a temperature. Held and replaced as forces are. */
int talus_put_heat(talus_partner *partner, int64_t n, const int64_t *id, const double *flow);
/* Impulse (3 each) that the drag which this partner has put has given n particles, each since it was asked for last. */
int talus_get_drag_impulses(talus_partner *partner, int64_t n, const int64_t *id, double *impulse);
/* Number of particles; then their IDs ascending (n of them, room for all), and of the given ones places, velocities,
   angular velocities (3 each), radii, masses. Any may be NULL. */
int talus_get_num_particles(talus_partner *partner, int64_t *n);
int talus_get_ids(talus_partner *partner, int64_t *id);
int talus_get_particles(talus_partner *partner, int64_t n, const int64_t *id, double *x, double *v,
                        double *omega, double *radius, double *mass);

/* ---- fields on a grid of the partner ----------------------------------------------------------------- */

/* Means over cells of a grid, smeared as compute coarse/grid does with this width (distance units; 0: by centers): corners
   of the grid, cells along x, y, z; x runs fastest. solid: volume of particles over that of the cell. momentum: of
   particles per volume (3 each). exchange: impulse of drag per volume (3 each) since the last call of this with exchange.
   Any may be NULL. What particles with their center inside the grid have is in its cells to rounding; exchange begins anew
   for these. */
int talus_get_field(talus_partner *partner, const double *lo, const double *hi, const int *cells,
                    double width, double *solid, double *momentum, double *exchange);

/* ---- grains in a fluid that the partner computes: doc/coupling_fluid.md ------------------------------ */

/* In these calls a partner on all ranks is divided among them: every rank gives and gets what its own cells have. Of one
   that lives on one rank, that has all. kernel: "tophat W" or "gaussian W" (W: distance units), and perhaps
   "group ID": the grains that are in the fluid. Units must be consistent: si, cgs, lj, micro, nano. */

/* Cells are boxes of a grid: its corners, cells along x, y, z; this rank has those from first to before last (3 each), x
   runs fastest. Every cell has one owner. A rank with NULL has none; NULL on all: all have all, arguments and results of
   all calls are the same on all ranks. */
int talus_set_fluid_grid(talus_partner *partner, const char *kernel, const double *lo,
                         const double *hi, const int *cells, const int *first, const int *last);
/* Cells of any mesh: n of this rank, their centers (3 each) and volumes (> 0). */
int talus_set_fluid_cells(talus_partner *partner, const char *kernel, int64_t n, const double *x,
                          const double *volume);
/* Law of drag, with its words, and density (mass/volume) and dynamic viscosity (mass/(distance time)) of the fluid. */
int talus_set_drag_law(talus_partner *partner, const char *law, double density, double viscosity);
/* Of each cell of this rank: solid fraction; mean velocity of the grains by volume (3 each), 0 where there are none;
   impulse of the drag on grains since the last call of this with exchange, per volume (3 each): what the fluid has lost.
   Any may be NULL. */
int talus_get_grains(talus_partner *partner, double *solid, double *velocity, double *exchange);
/* Fields of the fluid in the cells of this rank, which drag, pressure gradient and buoyancy are found from, until the next call
   of this: they replace what this partner has put with talus_put_drag() and talus_put_forces(). velocity (3 each);
   pressure_gradient (pressure/distance, 3 each) or NULL; gravity: acceleration (3) from which buoyancy is found where
   the gradient does not have it, or NULL; vorticity (curl of the velocity, 3 each), which lift and drag of rotation are
   found from; NULL: none. coefficient: sums of those of drag over grains per volume of the cell (force
   time/(distance volume)), or NULL. */
int talus_put_fluid(talus_partner *partner, const double *velocity, const double *pressure_gradient,
                    const double *gravity, const double *vorticity, double *coefficient);
/* Heat of the fluid, until the next call of this, in place of what this partner has put with talus_put_heat(). law: "gunn" or
   "ranz/marshall"; velocity (3 each) and temperature in the cells of this rank; conductivity (power/(distance temperature)) and
   heat capacity (energy/(mass temperature)) of the fluid, whose density and viscosity are those of its drag. exchange: power
   into grains per volume of the cell, or NULL. */
int talus_put_fluid_heat(talus_partner *partner, const char *law, const double *velocity,
                         const double *temperature, double conductivity, double heat_capacity,
                         double *exchange);

#ifdef __cplusplus
}
#endif

#endif
