// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How a call of talus.h gets from the file that programs link (talusplugin.so, as libtalus.so) to the file that holds the code
// (talusstyles.so, or one of several): as a pointer in a table, which the styles hand over when LAMMPS loads them.

#ifndef TALUS_COUPLING_CALLS_H
#define TALUS_COUPLING_CALLS_H

#include "talus.h"

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
       (partner, body, load))

namespace Talus {

#define TALUS_DECLARE(name, parameters, arguments) int call_##name parameters;
TALUS_CALLS(TALUS_DECLARE)
#undef TALUS_DECLARE
const char *call_error(const talus_partner *partner);

struct CallTable {
  int version;
#define TALUS_POINTER(name, parameters, arguments) int(*name) parameters;
  TALUS_CALLS(TALUS_POINTER)
#undef TALUS_POINTER
  const char *(*error)(const talus_partner *partner);
};

/// Of this file of styles.
const CallTable &call_table();

}    // namespace Talus

#endif
