// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/step/neighbor_lists.h"

#include "base/state_exchange.h"
#include "neighbors/neighbor_view.h"
#include "neighbors/skin_choice.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "neighbor.h"
#include "output.h"
#include "thermo.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

namespace Talus {

DomainBox DomainBox::of(const Domain &domain)
{
  DomainBox box;
  std::copy_n(domain.boxlo, 3, box.low.begin());
  std::copy_n(domain.boxhi, 3, box.high.begin());
  box.tilt = {domain.xy, domain.xz, domain.yz};
  return box;
}

void DomainBox::give_to(Domain &domain) const
{
  std::copy(low.begin(), low.end(), domain.boxlo);
  std::copy(high.begin(), high.end(), domain.boxhi);
  domain.xy = tilt[0];
  domain.xz = tilt[1];
  domain.yz = tilt[2];
  domain.set_global_box();
  domain.set_lamda_box();
  domain.set_local_box();
}

void NeighborLists::are_new()
{
  present = ++last;
  box_then = DomainBox::of(*domain);
}

/* ---- the skin ---- */

double NeighborLists::skin() const
{
  if (skins.chosen > 0.0) return skins.chosen;
  return wide > 0.0 ? skins.given : neighbor->skin;    // which is the wide one during init()
}

void NeighborLists::end_choice()
{
  start_run();
  may_choose = false;
  wide = 0.0;
  skins = {};
}

/* At a rebuild LAMMPS deletes particles that have left the box, and fits faces that are shrink-wrapped: a script that counts on
   either has its own skin. Outputs have no influence, whatever lists of LAMMPS they have. */

bool NeighborLists::can_choose() const
{
  const bool shrinks = domain->nonperiodic == 2;
  const bool may_lose =
      domain->nonperiodic && output->thermo && output->thermo->lostflag != Thermo::ERROR;
  return !shrinks && !may_lose && skins.given > 0.0 && neighbor->dist_check &&
         !neighbor->build_once && comm->mode == Comm::SINGLE &&
         system.neighbors().reason_for_lammps_lists().empty();
}

void NeighborLists::init(bool wanted)
{
  const double before = skins.given;
  start_run();    // an error has come between
  skins.given = neighbor->skin;
  wide = 0.0;
  may_choose = wanted && can_choose();
  if (!may_choose || skins.given != before) skins.chosen = 0.0;
  made = 0;
  unit = 0.0;
  if (!may_choose) return;
  neighbor->skin = wide = std::max(skins.given, widest());
  is_widened = true;
}

void NeighborLists::start_run()
{
  if (is_widened && neighbor->skin == wide) neighbor->skin = skins.given;
  is_widened = false;
}

double NeighborLists::reach_of_ghosts() const
{
  const bool only_ours = neighbor->nlist == 1;
  return wide > 0.0 && only_ours ? neighbor->cutneighmax - wide + skin() : neighbor->cutneighmax;
}

/* Often in the beginning, and then as often as costs nothing. */

bool NeighborLists::is_choice_due() const
{
  return may_choose && (made <= 4 || made % 8 == 0);
}

/* The search finds a few pairs that are further apart, on each rank others; and each pair is found on every rank that owns a
   particle of it. Sizes are whole numbers, whose sum does not depend on its order. */

void NeighborLists::count(const NeighborView &found)
{
  made++;
  unit = 0.0;
  if (!is_choice_due()) return;
  constexpr double units = 1 << 20;
  const int owned = atom->nlocal;
  const double *const radius = atom->radius, range = skin();
  const double *const *const x = atom->x;
  candidates = diameters = 0;
  found.for_each_pair([&](int i, int j, double /*scale*/) {
    const double d[3] = {x[i][0] - x[j][0], x[i][1] - x[j][1], x[i][2] - x[j][2]};
    const double reach = radius[i] + radius[j] + range;
    if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < reach * reach)
      candidates += (i < owned ? 1 : 0) + (j < owned ? 1 : 0);
  });
  unit = system.range().radii().largest() / units;
  for (int i = 0; i < owned; i++)
    diameters += static_cast<std::int64_t>(std::lround(2.0 * radius[i] / unit));
}

/* A box that is short along a period would have images of images in lists that are much wider. */

double NeighborLists::widest() const
{
  const double touch = 2.0 * system.range().radii().largest();
  double most = touch;
  const double period[3] = {domain->xprd, domain->yprd, domain->zprd};
  for (int d = 0; d < 3; d++)
    if (domain->periodicity[d]) most = std::min(most, 0.5 * period[d] - touch);
  return most;
}

void NeighborLists::have_served()
{
  if (!may_choose || unit == 0.0) return;
  const std::int64_t here[2] = {candidates, diameters};
  std::int64_t all[2];
  MPI_Allreduce(here, all, 2, MPI_INT64_T, MPI_SUM, world);
  const bigint steps = update->ntimestep - neighbor->lastcall;
  if (atom->natoms == 0 || steps <= 0) return;
  const double mean = static_cast<double>(all[1]) * unit / static_cast<double>(atom->natoms);
  const double best =
      choose_skin({skin(), mean, atom->natoms, all[0] / 2, steps}, {skins.given, wide});
  if (best == skin()) return;
  skins.chosen = best;
  comm->setup();
}

std::string NeighborLists::summary() const
{
  if (!(skins.chosen > 0.0) || skins.chosen == skins.given) return "";
  return fmt::format(
      "Talus: neighbor lists have a skin of {:.4g}, chosen by what they cost; given: {:.4g}\n",
      skins.chosen, skins.given);
}

void NeighborLists::exchange_state(StateExchange &x)
{
  x(skins.chosen, made, candidates, diameters, unit);
}

}    // namespace Talus
