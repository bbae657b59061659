// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How a call of talus.h gets from the file that programs link (talusplugin.so, as libtalus.so) to the file that holds the code
// (talusstyles.so, or one of several): as a pointer in a table, which the styles hand over when LAMMPS loads them.

#ifndef TALUS_COUPLING_CALLS_H
#define TALUS_COUPLING_CALLS_H

#include "coupling/talus.h"

// CALL(name, parameters, arguments): all that return a code
#define TALUS_CALLS(CALL)                                                                          \
  CALL(open, (void *lmp, int root, talus_partner **partner), (lmp, root, partner))                 \
  CALL(close, (talus_partner * partner), (partner))                                                \
  CALL(fail, (talus_partner * partner, const char *why), (partner, why))                           \
  CALL(get_time, (const talus_partner *partner, double *time, double *dt, int64_t *step),          \
       (partner, time, dt, step))                                                                  \
  CALL(advance, (talus_partner * partner, int64_t steps), (partner, steps))                        \
  CALL(advance_by, (talus_partner * partner, double duration), (partner, duration))                \
  CALL(set_up, (talus_partner * partner), (partner))                                               \
  CALL(put_body_state,                                                                             \
       (talus_partner * partner, const char *body, const double *state, int64_t steps),            \
       (partner, body, state, steps))                                                              \
  CALL(get_body_state, (talus_partner * partner, const char *body, double *state),                 \
       (partner, body, state))                                                                     \
  CALL(watch_body, (talus_partner * partner, const char *body, const double *point),               \
       (partner, body, point))                                                                     \
  CALL(get_body_load, (talus_partner * partner, const char *body, double *load),                   \
       (partner, body, load))                                                                      \
  CALL(save, (talus_partner * partner, talus_snapshot * *snapshot), (partner, snapshot))           \
  CALL(restore, (talus_partner * partner, const talus_snapshot *snapshot), (partner, snapshot))    \
  CALL(discard, (talus_snapshot * snapshot), (snapshot))                                           \
  CALL(get_mesh_size,                                                                              \
       (talus_partner * partner, const char *body, int64_t *vertices, int64_t *triangles),         \
       (partner, body, vertices, triangles))                                                       \
  CALL(get_mesh, (talus_partner * partner, const char *body, double *x, int64_t *triangles),       \
       (partner, body, x, triangles))                                                              \
  CALL(put_vertices,                                                                               \
       (talus_partner * partner, const char *body, const double *x, const double *v,               \
        int64_t steps),                                                                            \
       (partner, body, x, v, steps))                                                               \
  CALL(get_vertex_loads,                                                                           \
       (talus_partner * partner, const char *body, int64_t *touched, int64_t *numbers,             \
        double *impulses, double *work, double *duration),                                         \
       (partner, body, touched, numbers, impulses, work, duration))                                \
  CALL(put_forces,                                                                                 \
       (talus_partner * partner, int64_t n, const int64_t *id, const double *force,                \
        const double *torque),                                                                     \
       (partner, n, id, force, torque))                                                            \
  CALL(put_drag,                                                                                   \
       (talus_partner * partner, int64_t n, const int64_t *id, const double *coefficient,          \
        const double *fluid_velocity),                                                             \
       (partner, n, id, coefficient, fluid_velocity))                                              \
  CALL(put_heat, (talus_partner * partner, int64_t n, const int64_t *id, const double *flow),      \
       (partner, n, id, flow))                                                                     \
  CALL(get_drag_impulses,                                                                          \
       (talus_partner * partner, int64_t n, const int64_t *id, double *impulse),                   \
       (partner, n, id, impulse))                                                                  \
  CALL(get_num_particles, (talus_partner * partner, int64_t * n), (partner, n))                    \
  CALL(get_ids, (talus_partner * partner, int64_t * id), (partner, id))                            \
  CALL(get_particles,                                                                              \
       (talus_partner * partner, int64_t n, const int64_t *id, double *x, double *v,               \
        double *omega, double *radius, double *mass),                                              \
       (partner, n, id, x, v, omega, radius, mass))                                                \
  CALL(get_field,                                                                                  \
       (talus_partner * partner, const double *lo, const double *hi, const int *cells,             \
        double width, double *solid, double *momentum, double *exchange),                          \
       (partner, lo, hi, cells, width, solid, momentum, exchange))                                 \
  CALL(set_fluid_grid,                                                                             \
       (talus_partner * partner, const char *kernel, const double *lo, const double *hi,           \
        const int *cells, const int *first, const int *last),                                      \
       (partner, kernel, lo, hi, cells, first, last))                                              \
  CALL(set_fluid_cells,                                                                            \
       (talus_partner * partner, const char *kernel, int64_t n, const double *x,                   \
        const double *volume),                                                                     \
       (partner, kernel, n, x, volume))                                                            \
  CALL(set_drag_law, (talus_partner * partner, const char *law, double density, double viscosity), \
       (partner, law, density, viscosity))                                                         \
  CALL(get_grains, (talus_partner * partner, double *solid, double *velocity, double *exchange),   \
       (partner, solid, velocity, exchange))                                                       \
  CALL(put_fluid,                                                                                  \
       (talus_partner * partner, const double *velocity, const double *pressure_gradient,          \
        const double *gravity, const double *vorticity, double *coefficient),                      \
       (partner, velocity, pressure_gradient, gravity, vorticity, coefficient))                    \
  CALL(put_fluid_heat,                                                                             \
       (talus_partner * partner, const char *law, const double *velocity,                          \
        const double *temperature, double conductivity, double heat_capacity, double *exchange),   \
       (partner, law, velocity, temperature, conductivity, heat_capacity, exchange))

namespace Talus {

#define TALUS_DECLARE(name, parameters, arguments) int call_##name parameters;
TALUS_CALLS(TALUS_DECLARE)
#undef TALUS_DECLARE
const char *call_error(const talus_partner *partner);
int64_t call_snapshot_size(const talus_snapshot *snapshot);

struct CallTable {
  int version;
#define TALUS_POINTER(name, parameters, arguments) int(*name) parameters;
  TALUS_CALLS(TALUS_POINTER)
#undef TALUS_POINTER
  const char *(*error)(const talus_partner *partner);
  int64_t (*snapshot_size)(const talus_snapshot *snapshot);
};

/// Of this file of styles.
const CallTable &call_table();

}    // namespace Talus

#endif
