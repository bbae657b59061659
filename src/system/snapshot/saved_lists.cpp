// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/snapshot/saved_lists.h"

#include "base/state_digest.h"
#include "system/host/fix_list.h"
#include "system/host/system_fix.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include "fmt/format.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace Talus {

SavedLists::SavedLists(LAMMPS *lmp, GranularSystem &owner) :
    Pointers(lmp), system(owner), made(owner.lists())
{
}

void SavedLists::save()
{
  number = made.number();
  if (!system.shapes()) pairs = system.rebuild().pair_lists();
  step = neighbor->lastcall;
  decomposition = present_decomposition();
  comm_style = comm->style;
  box = DomainBox::of(*domain);
  box_of_lists = number ? made.box() : box;
  particles = digest_of_particles();
  double **const then = neighbor->get_xhold();
  if (neighbor->dist_check && !neighbor->includegroup && then && atom->nlocal)
    positions.assign(then[0], then[0] + 3L * atom->nlocal);
}

SavedLists::Decomposition SavedLists::present_decomposition() const
{
  Decomposition now;
  now.layout = comm->layout;
  if (comm->layout == Comm::LAYOUT_TILED) {
    now.cut_dimension = comm->rcbcutdim;
    now.cut = comm->rcbcutfrac;
    std::copy_n(comm->mysplit[0], 6, now.own_split.begin());
  }
  const double *const splits[3] = {comm->xsplit, comm->ysplit, comm->zsplit};
  for (int d = 0; d < 3; d++) now.splits[d].assign(splits[d], splits[d] + comm->procgrid[d] + 1);
  return now;
}

std::uint64_t SavedLists::digest_of_particles() const
{
  StateDigest digest;
  digest.add(static_cast<std::uint64_t>(atom->nlocal));
  const int all = atom->nlocal + atom->nghost;
  for (int i = 0; i < all; i++) digest.add(static_cast<std::uint64_t>(atom->tag[i]));
  return digest.value();
}

bool SavedLists::on_all_ranks(bool here) const
{
  const int mine = here;
  int all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, world);
  return all != 0;
}

/* Ghosts come in another order. */

std::string SavedLists::reason_against_restoring() const
{
  if (comm->style == comm_style) return "";
  const auto name = [](int style) { return style == Comm::BRICK ? "brick" : "tiled"; };
  return fmt::format("comm_style is {} now and was {} when the snapshot was made: set it back",
                     name(comm->style), name(comm_style));
}

bool SavedLists::are_present() const
{
  return on_all_ranks(number != 0 && made.number() == number && digest_of_particles() == particles);
}

/* As fix balance does. */

void SavedLists::prepare() const
{
  if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
  atom->nghost = 0;
  if (!on_all_ranks(present_decomposition() == decomposition)) {
    comm->layout = decomposition.layout;
    double *const splits[3] = {comm->xsplit, comm->ysplit, comm->zsplit};
    for (int d = 0; d < 3; d++)
      std::copy(decomposition.splits[d].begin(), decomposition.splits[d].end(), splits[d]);
    if (comm->layout == Comm::LAYOUT_TILED) {
      comm->rcbcutdim = decomposition.cut_dimension;
      comm->rcbcutfrac = decomposition.cut;
      std::copy_n(decomposition.own_split.begin(), 6, comm->mysplit[0]);
      comm->rcbnew = 1;
    }
  }
  box_of_lists.give_to(*domain);
}

bool SavedLists::make_again() const
{
  if (!positions.empty()) std::copy(positions.begin(), positions.end(), atom->x[0]);
  comm->setup();
  if (neighbor->style) neighbor->setup_bins();
  const bool tilted = domain->triclinic != 0;
  if (tilted) domain->x2lamda(atom->nlocal);
  comm->borders();
  if (tilted) domain->lamda2x(atom->nlocal + atom->nghost);
  if (!on_all_ranks(digest_of_particles() == particles)) return false;
  system.rebuild().take_pairs_from(pairs);
  run_hooks_and_build();
  system.rebuild().take_pairs_from(nullptr);
  made.are_again(number);
  if (!positions.empty()) std::copy(positions.begin(), positions.end(), neighbor->get_xhold()[0]);
  box.give_to(*domain);
  return true;
}

/* Run styles look for the step of the lists in LAMMPS, and for their box in NeighborLists. */

void SavedLists::run_hooks_and_build() const
{
  if (modify->n_pre_neighbor) modify->pre_neighbor();
  neighbor->build(1);
  neighbor->lastcall = step;
  // those of Talus list particles when all is restored
  for (Fix *fix : fix_list(*modify))
    if ((modify->get_fix_mask(fix) & FixConst::POST_NEIGHBOR) && !SystemFix::of(fix))
      fix->post_neighbor();
}

double SavedLists::memory_usage() const
{
  return static_cast<double>(positions.capacity() * sizeof(double)) + sizeof *this +
         (pairs ? pairs->memory_usage() : 0.0);
}

}    // namespace Talus
