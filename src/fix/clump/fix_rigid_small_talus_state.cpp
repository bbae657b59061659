/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   What snapshots keep of clumps: all that the stock class knows of bodies and of owned particles, ghosts of
   bodies included, as it is: its own methods for particles under way would put centers into their periods, and
   bodies into another order.
------------------------------------------------------------------------- */

#include "fix/clump/fix_rigid_small_talus.h"

#include "base/state_exchange.h"

#include "atom.h"

#include <cstddef>

using namespace LAMMPS_NS;

template <class Exchange> void FixRigidSmallTalus::exchange_rows_of_particles(Exchange &x)
{
  const std::size_t n = atom->nlocal;
  x.array(bodytag, n);
  x.array(atom2body, n);
  x.array(xcmimage, n);
  if (n) x.array(displace[0], 3 * n);
  if (!extended) return;
  x.array(eflags, n);
  if (n && orientflag) x.array(orient[0], orientflag * n);
  if (n && dorientflag) x.array(dorient[0], 3 * n);
}

/* Before ghosts are there, those that are known to own a body are ones of then. */

void FixRigidSmallTalus::exchange_state(Talus::StateExchange &x)
{
  int all = atom->nlocal + atom->nghost;
  x(all, nlocal_body, nghost_body, nbody, setupflag, restored, states_known, kick_is_due);
  while (nmax_body < nlocal_body + nghost_body) grow_body();
  x.array(body, nlocal_body + nghost_body);
  x.array(bodyown, all);
  exchange_rows_of_particles(x);
  x(table, shares_clumps, ghost_clump, ghost_rows, row_size);
  lanes.forget();
}
