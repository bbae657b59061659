// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "pair/contact_watch.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "neigh_list.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace Talus;

void ContactWatch::look(const ContactPipeline &contacts, const NeighList &list)
{
  double worst;
  int rank;
  if (!said_overlap && exceeds(contacts.largest_overlap_ratio(), largest_overlap, worst, rank)) {
    said_overlap = true;
    double tags[2] = {0.0, 0.0};
    if (comm->me == rank) name_deepest_pair(list, tags);
    MPI_Bcast(tags, 2, MPI_DOUBLE, rank, world);
    if (comm->me == 0)
      error->warning(
          FLERR,
          "Pair style gran/penalty: particles {:.0f} and {:.0f} overlap by {:.3g} of the "
          "smaller radius at step {}; contact laws are made for small overlaps: use a "
          "higher stiffness, or look for particles that overlap from the beginning",
          tags[0], tags[1], worst, update->ntimestep);
  }
  if (said_move) return;
  const Move mine = largest_own_move();
  if (exceeds(mine.ratio, largest_move, worst, rank)) {
    said_move = true;
    double tag = comm->me == rank ? static_cast<double>(atom->tag[mine.atom]) : 0.0;
    MPI_Bcast(&tag, 1, MPI_DOUBLE, rank, world);
    if (comm->me == 0)
      error->warning(FLERR,
                     "Pair style gran/penalty: particle {:.0f} moves by {:.3g} of its radius in a "
                     "time step at step {}; an impact is not resolved: reduce the time step",
                     tag, worst, update->ntimestep);
  }
}

/* The largest value of all ranks, and the lowest rank that has it. A value that is not a number
   counts as zero: it is another trouble. */

bool ContactWatch::exceeds(double mine, double limit, double &worst, int &rank) const
{
  struct {
    double value;
    int rank;
  } here = {std::isfinite(mine) ? mine : 0.0, comm->me}, all;
  MPI_Allreduce(&here, &all, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  worst = all.value;
  rank = all.rank;
  return worst > limit;
}

ContactWatch::Move ContactWatch::largest_own_move() const
{
  Move found = {0.0, 0};
  for (int i = 0; i < atom->nlocal; i++) {
    const double *v = atom->v[i], r = atom->radius[i];
    const double ratio2 = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / (r * r);
    if (ratio2 > found.ratio) found = {ratio2, i};
  }
  found.ratio = std::sqrt(found.ratio) * update->dt;
  return found;
}

/* Owned particles may have moved since the contacts were computed, ghosts have not: good enough to
   tell which pair it is. */

void ContactWatch::name_deepest_pair(const NeighList &list, double tags[2]) const
{
  double deepest = -1.0;
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = list.ilist[ii];
    for (int jj = 0; jj < list.numneigh[i]; jj++) {
      const int j = list.firstneigh[i][jj] & NEIGHMASK;
      const double *a = atom->x[i], *b = atom->x[j];
      const double r = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      const double overlap =
          (atom->radius[i] + atom->radius[j] - r) / std::min(atom->radius[i], atom->radius[j]);
      if (overlap <= deepest) continue;
      deepest = overlap;
      tags[0] = static_cast<double>(std::min(atom->tag[i], atom->tag[j]));
      tags[1] = static_cast<double>(std::max(atom->tag[i], atom->tag[j]));
    }
  }
}
