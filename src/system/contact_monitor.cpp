// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contact_monitor.h"

#include "atom.h"
#include "base/in_parallel.h"
#include "comm.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace LAMMPS_NS;
using namespace Talus;

void ContactMonitor::look(const ContactPipeline &contacts)
{
  double worst;
  int rank;
  const DeepestContact mine = said_overlap ? DeepestContact{} : contacts.deepest_contact();
  if (!said_overlap && exceeds(mine.overlap_ratio, largest_overlap, worst, rank)) {
    said_overlap = true;
    double tags[2] = {0.0, 0.0};
    if (comm->me == rank) {
      tags[0] = static_cast<double>(std::min(atom->tag[mine.i], atom->tag[mine.j]));
      tags[1] = static_cast<double>(std::max(atom->tag[mine.i], atom->tag[mine.j]));
    }
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
  const Move longest = largest_own_move();
  if (exceeds(longest.ratio, largest_move, worst, rank)) {
    said_move = true;
    double tag = comm->me == rank ? static_cast<double>(atom->tag[longest.atom]) : 0.0;
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

bool ContactMonitor::exceeds(double mine, double limit, double &worst, int &rank) const
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

ContactMonitor::Move ContactMonitor::largest_own_move() const
{
  std::vector<Move> found(comm->nthreads, Move{0.0, 0});
  in_ranges(atom->nlocal, comm->nthreads, [&](int t, int begin, int end) {
    Move its = {0.0, 0};
    for (int i = begin; i < end; i++) {
      const double *v = atom->v[i], r = atom->radius[i];
      const double ratio2 = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / (r * r);
      if (ratio2 > its.ratio) its = {ratio2, i};
    }
    found[t] = its;
  });
  Move longest = *std::max_element(found.begin(), found.end(),
                                   [](const Move &a, const Move &b) { return a.ratio < b.ratio; });
  longest.ratio = std::sqrt(longest.ratio) * update->dt;
  return longest;
}
