// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/large_body_monitor.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace Talus;

void LargeBodyMonitor::look(const BodyFindings &found, bool moves, const std::string &id)
{
  struct {
    double value;
    int rank;
  } here[BodyWarnings::num_kinds], all[BodyWarnings::num_kinds];
  BodyWarnings::Finding mine[BodyWarnings::num_kinds];
  bool any = false;
  for (const auto kind : {BodyWarnings::OVERLAP, BodyWarnings::MOVE}) {
    const bool wanted = warnings.wants(kind, moves);
    if (wanted) mine[kind] = BodyWarnings::look(kind, found, update->dt);
    here[kind] = {mine[kind].value, comm->me};
    any = any || wanted;
  }
  if (!any) return;
  MPI_Allreduce(here, all, BodyWarnings::num_kinds, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  for (const auto kind : {BodyWarnings::OVERLAP, BodyWarnings::MOVE}) {
    if (!warnings.exceeded(kind, all[kind].value)) continue;
    tagint tag = comm->me == all[kind].rank ? atom->tag[mine[kind].atom] : 0;
    MPI_Bcast(&tag, 1, MPI_LMP_TAGINT, all[kind].rank, world);
    if (comm->me == 0)
      error->warning(FLERR, BodyWarnings::text(kind, id, all[kind].value, tag, update->ntimestep));
  }
}
