// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/large_body_monitor.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace Talus;

void LargeBodyMonitor::look(const BodyContacts::Worst &mine, bool moves, const std::string &id)
{
  double worst, tag;
  if (!said_overlap && exceeds(mine.overlap, mine.deepest, largest_overlap, worst, tag)) {
    said_overlap = true;
    if (comm->me == 0)
      error->warning(FLERR,
                     "Fix large/body {}: particle {:.0f} overlaps the body by {:.3g} of its radius "
                     "at step {}; contact laws are made for small overlaps: use a higher "
                     "stiffness, or look for particles that overlap from the beginning",
                     id, tag, worst, update->ntimestep);
  }
  if (said_move || !moves) return;
  if (exceeds(mine.speed * update->dt, mine.fastest, largest_move, worst, tag)) {
    said_move = true;
    if (comm->me == 0)
      error->warning(FLERR,
                     "Fix large/body {}: particle {:.0f} and the body move past each other by "
                     "{:.3g} of its radius in a time step at step {}; an impact is not resolved: "
                     "reduce the time step",
                     id, tag, worst, update->ntimestep);
  }
}

/* The largest value of all ranks, and its particle. A value that is not a number counts as zero: it
   is another trouble. */

bool LargeBodyMonitor::exceeds(double mine, int atom_of_mine, double limit, double &worst,
                               double &tag) const
{
  struct {
    double value;
    int rank;
  } here = {std::isfinite(mine) ? mine : 0.0, comm->me}, all;
  MPI_Allreduce(&here, &all, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  worst = all.value;
  if (!(worst > limit)) return false;
  tag = comm->me == all.rank ? static_cast<double>(atom->tag[atom_of_mine]) : 0.0;
  MPI_Bcast(&tag, 1, MPI_DOUBLE, all.rank, world);
  return true;
}
