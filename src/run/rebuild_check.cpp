// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "run/rebuild_check.h"

#include "system/step/granular_system.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <iterator>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

double distance(const std::array<double, 3> &a, const std::array<double, 3> &b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}    // namespace

RebuildCheck::RebuildCheck(LAMMPS *lmp) : Pointers(lmp)
{
  MPI_Comm_dup(world, &own_world);
}

RebuildCheck::~RebuildCheck()
{
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (finalized) return;
  constexpr double patience = 1.0;    // seconds
  const double start = MPI_Wtime();
  int ended = request == MPI_REQUEST_NULL;
  while (!ended && MPI_Wtime() - start < patience) MPI_Test(&request, &ended, MPI_STATUS_IGNORE);
  if (ended)
    MPI_Comm_free(&own_world);
  else
    static_cast<void>(lengths.release());    // a reduction that goes on may still write there
}

/* ---------------------------------------------------------------------- */

void RebuildCheck::list_is_new()
{
  list_step = neighbor->lastcall;
  corners_of_list = corners_of(DomainBox::of(*domain));
}

void RebuildCheck::start_run(const NeighborLists &present)
{
  delayed = unforeseen = 0;
  if (present.number() != number) {
    list_step = neighbor->lastcall;
    corners_of_list = corners_of(present.box());
  }
  ask(nullptr);
}

void RebuildCheck::end_run(const NeighborLists &present)
{
  drop();
  number = present.number();
}

void RebuildCheck::ask(GranularSystem *in_records)
{
  drop();
  const int ago = neighbor->ago + 1;    // in the next step
  const bool due = ago >= neighbor->delay && ago % neighbor->every == 0;
  double **then = neighbor->get_xhold();
  if (!due || !neighbor->dist_check || neighbor->build_once || list_step != neighbor->lastcall)
    return;

  const int n = neighbor->includegroup ? atom->nfirst : atom->nlocal;
  MotionForecast here;
  if (in_records)
    here = forecast(*in_records);
  else if (n)
    here = forecast_motion(n, atom->x[0], then[0], atom->v[0], update->dt);
  lengths->mine[0] = here.moved;
  lengths->mine[1] = here.step;
  if (domain->box_change) corners_when_asked = corners_of(DomainBox::of(*domain));
  asked = true;
  if (comm->nprocs > 1)
    MPI_Iallreduce(lengths->mine, lengths->all, 2, MPI_DOUBLE, MPI_MAX, own_world, &request);
  else
    std::copy(std::begin(lengths->mine), std::end(lengths->mine), lengths->all);
}

/* A bound of the moves is enough while it is far from the limit: then the next step is not one of
   new lists, whatever other ranks say. With `every N` the forecast alone decides. */

MotionForecast RebuildCheck::forecast(GranularSystem &in_records) const
{
  MotionForecast here{in_records.step().moved_at_most(),
                      update->dt * in_records.pipeline().motion().fastest()};
  if (neighbor->every > 1 || here.may_leave(limit(), 1))
    here.moved = in_records.step().moved_since_rebuild();
  return here;
}

/* LAMMPS decides first, as if there were no check: that tells whether a fix or a restart file
   demands new lists, which leaves the age of the lists as it is, or whether a check is due. */

bool RebuildCheck::decide(const std::function<double()> &moved)
{
  const int age = neighbor->ago, with_check = neighbor->dist_check;
  neighbor->dist_check = 0;
  const bool due = neighbor->decide();
  neighbor->dist_check = with_check;
  if (!due) return false;
  const bool forced = neighbor->ago == age;
  if (forced || !with_check || !asked) return true;

  drop();
  const MotionForecast forecast{lengths->all[0], lengths->all[1]};
  if (!forecast.may_leave(limit_when_asked(), neighbor->every)) return false;
  if (neighbor->every == 1 && !has_left(moved())) return false;
  if (forecast.moved > 0.5 * neighbor->skin) {
    const int first_check = std::max(neighbor->every, neighbor->delay);    // a multiple of `every`
    (neighbor->ago == first_check ? delayed : unforeseen)++;
    neighbor->ndanger++;
  }
  return true;
}

void RebuildCheck::drop()
{
  if (request != MPI_REQUEST_NULL) MPI_Wait(&request, MPI_STATUS_IGNORE);
  asked = false;
}

/* ---------------------------------------------------------------------- */

RebuildCheck::Corners RebuildCheck::corners_of(const DomainBox &box)
{
  Corners corners;
  const auto &[xy, xz, yz] = box.tilt;
  for (int c = 0; c < 8; c++) {
    const double i = c & 1, j = c >> 1 & 1, k = c >> 2;
    const auto along = [&box](int d, double share) {
      return box.low[d] + share * (box.high[d] - box.low[d]);
    };
    corners[c] = {along(0, i) + (j * xy + k * xz), along(1, j) + k * yz, along(2, k)};
  }
  return corners;
}

bool RebuildCheck::has_left(double moved) const
{
  double farthest = 0.0;
  MPI_Allreduce(&moved, &farthest, 1, MPI_DOUBLE, MPI_MAX, own_world);
  return farthest > limit();
}

/* Half of the skin. As in LAMMPS, a box that changes takes from it what its two fastest corners
   have moved, or if it is orthogonal its lowest and its highest one. */

double RebuildCheck::limit() const
{
  if (!domain->box_change) return 0.5 * neighbor->skin;
  const Corners now = corners_of(DomainBox::of(*domain));
  double first = 0.0, second = 0.0;
  for (int c = 0; c < 8; c++) {
    if (!domain->triclinic && c != 0 && c != 7) continue;
    const double moved = distance(corners_of_list[c], now[c]);
    second = std::max(second, std::min(first, moved));
    first = std::max(first, moved);
  }
  return std::max(0.0, 0.5 * (neighbor->skin - (first + second)));
}

/* What the box has done since we asked can have carried particles along. */

double RebuildCheck::limit_when_asked() const
{
  if (!domain->box_change) return limit();
  const Corners now = corners_of(DomainBox::of(*domain));
  double since = 0.0;
  for (int c = 0; c < 8; c++) since = std::max(since, distance(corners_when_asked[c], now[c]));
  return std::max(0.0, limit() - since);
}
