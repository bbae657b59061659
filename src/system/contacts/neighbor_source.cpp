// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/neighbor_source.h"

#include "system/host/private_members.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "nbin.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "npair.h"
#include "pair.h"

#include <stdexcept>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {
/// In the place of bins that no list is made from.
class NoBins : public NBin {
 public:
  explicit NoBins(LAMMPS *lmp) : NBin(lmp) {}
  void bin_atoms_setup(int /*count*/) override {}
  void setup_bins(int /*style*/) override {}
  void bin_atoms() override {}
};
}    // namespace

std::string NeighborSource::reason_for_lammps_lists() const
{
  if (!GranularSystem::of(lmp)->pair_style().is_alone()) return "pair style hybrid";
  if (atom->nbonds > 0 || force->bond) return "bonds may scale forces";
  if (neighbor->includegroup || atom->firstgroupname) return "they are those of a group";
  return "";
}

void NeighborSource::init(Pair *pair)
{
  const std::string reason = reason_for_lammps_lists();
  searches = reason.empty();
  // of ours LAMMPS makes no list, but knows that pairs are those of spheres; of its own it has
  // pairs across ranks on both sides, whatever `newton` says
  neighbor->add_request(pair, NeighConst::REQ_SIZE | (searches ? NeighConst::REQ_OCCASIONAL
                                                               : NeighConst::REQ_NEWTON_OFF));
  bins_left_out = false;
  types_excluded = neighbor->nex_type > 0;
  groups_excluded = neighbor->nex_group;
  molecules_excluded = neighbor->nex_mol;
  const std::string line =
      "Talus " + GranularSystem::of(lmp)->pair_style().name() +
      (searches ? ": finds neighbors itself, as often as neigh_modify says\n"
                : fmt::format(": neighbor lists are those of LAMMPS: {}\n", reason));
  if (comm->me == 0 && line != said) utils::logmesg(lmp, line);
  said = line;
}

NeighborView NeighborSource::find(const NeighList *list, double pulloff_distance)
{
  if (!searches) {
    const double *scale = force->special_lj;
    return {list->inum,
            list->ilist,
            list->numneigh,
            list->firstneigh,
            NEIGHMASK,
            SBBITS,
            {scale[0], scale[1], scale[2], scale[3]}};
  }
  if (!bins_left_out) leave_bins_out();
  const int total = atom->nlocal + atom->nghost;
  try {
    search.find({atom->nlocal, total, total ? atom->x[0] : nullptr, atom->radius,
                 neighbor->skin + pulloff_distance},
                comm->nthreads,
                types_excluded || groups_excluded || molecules_excluded
                    ? [this](int i, int j) { return excludes(i, j); }
                    : std::function<bool(int, int)>());
  } catch (const std::domain_error &problem) {
    error->one(FLERR, "Pair style {}: {}: the simulation is unstable: reduce the time step",
               GranularSystem::of(lmp)->pair_style().name(), problem.what());
  }
  return search.view();
}

/* LAMMPS sorts all particles into bins at every rebuild, for lists that may be asked for. Ours is
   not; where it is the only one the bins go. LAMMPS makes them again, and init() is called,
   before another list can be there. */

void NeighborSource::leave_bins_out()
{
  bins_left_out = true;
  if (neighbor->nlist != 1 || neighbor->style == Neighbor::NSQ) return;
  NPair *builder = neighbor->lists[0]->np;
  if (!builder || !builder->nb) return;
  NBin *&bins = bins_of(*neighbor)[0];
  auto *none = new NoBins(lmp);
  none->istyle = bins->istyle;
  delete bins;
  bins = none;
  builder->nb = none;
}

/* `neigh_modify exclude type`, `group` and `molecule/intra` or `inter`, as LAMMPS' lists heed them:
   as they were when a run was set up, for the tables of LAMMPS are made then. */

bool NeighborSource::excludes(int i, int j) const
{
  if (types_excluded && neighbor->ex_type[atom->type[i]][atom->type[j]]) return true;
  const int a = atom->mask[i], b = atom->mask[j];
  for (int m = 0; m < groups_excluded; m++) {
    const int one = neighbor->ex1_bit[m], other = neighbor->ex2_bit[m];
    if ((a & one && b & other) || (a & other && b & one)) return true;
  }
  for (int m = 0; m < molecules_excluded; m++) {
    const int bit = neighbor->ex_mol_bit[m];
    const bool same = atom->molecule[i] == atom->molecule[j];
    if (a & bit && b & bit && same == (neighbor->ex_mol_intra[m] != 0)) return true;
  }
  return false;
}
