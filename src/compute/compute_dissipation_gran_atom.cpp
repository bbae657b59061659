// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "compute/compute_dissipation_gran_atom.h"

#include "atom.h"
#include "error.h"
#include "fix_store_atom.h"
#include "group.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace {
constexpr int size = 3;
}

ComputeDissipationGranAtom::ComputeDissipationGranAtom(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), system(Talus::GranularSystem::of(lmp))
{
  if (narg > 3) error->all(FLERR, 3, "compute dissipation/gran/atom: surplus word '{}'", arg[3]);
  peratom_flag = 1;
  size_peratom_cols = size;
  store_id = std::string(id) + "_DISSIPATION_STORE";
  store = dynamic_cast<FixStoreAtom *>(
      modify->add_fix(store_id + " " + group->names[igroup] + " STORE/ATOM 6 0 no yes"));
  if (!store) error->all(FLERR, "Compute dissipation/gran/atom: cannot create fix {}", store_id);
  started = store->restart_reset;
  system->account().add_observer(this);
}

ComputeDissipationGranAtom::~ComputeDissipationGranAtom()
{
  system->account().drop_observer(this);
  if (modify->get_fix_by_id(store_id)) modify->delete_fix(store_id);
  memory->destroy(array_atom);
}

void ComputeDissipationGranAtom::init()
{
  if (!system->pair_style().is_there())
    error->all(FLERR, "Compute dissipation/gran/atom requires a pair style of Talus");
  if (modify->get_fix_by_id(store_id) != store)
    error->all(FLERR,
               "Compute dissipation/gran/atom: its internal fix {} has been deleted: remove the "
               "unfix command",
               store_id);
}

double **ComputeDissipationGranAtom::work_by_particle()
{
  return modify->get_fix_by_id(store_id) == store ? store->astore : nullptr;
}

/* What springs store in the beginning was not taken in this account, but may be lost in it. */

void ComputeDissipationGranAtom::setup()
{
  if (started) return;
  started = true;
  add_springs(store->astore, 1.0);
  const double counted = system->account().counted_of_last_step();
  for (int i = 0; i < atom->nlocal; i++)
    for (int n = 0; n < size; n++) store->astore[i][n] -= counted * store->astore[i][size + n];
}

void ComputeDissipationGranAtom::add_springs(double **to, double sign) const
{
  const int nlocal = atom->nlocal;
  system->contacts().for_each(Talus::ContactData::ENERGIES, [&](const Talus::ContactReport &one) {
    const double share = sign * (one.body < 0 ? 0.5 : 1.0);
    for (const int i : {one.i, one.j}) {
      if (i < 0 || i >= nlocal) continue;
      to[i][0] += share * one.stored.detaching;
      to[i][1] += share * one.stored.tangential;
      to[i][2] += share * one.stored.resistance;
    }
  });
}

void ComputeDissipationGranAtom::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  if (!work_by_particle())
    error->all(FLERR,
               "Compute dissipation/gran/atom: its internal fix {} has been deleted: remove the "
               "unfix command",
               store_id);
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->grow(array_atom, nmax, size, "dissipation/gran/atom:energy");
  }
  const double counted = system->account().counted_of_last_step();
  for (int i = 0; i < atom->nlocal; i++)
    for (int n = 0; n < size; n++)
      array_atom[i][n] = store->astore[i][n] + counted * store->astore[i][size + n];
  add_springs(array_atom, -1.0);
  for (int i = 0; i < atom->nlocal; i++)
    if (!(atom->mask[i] & groupbit)) std::fill_n(array_atom[i], size, 0.0);
}

double ComputeDissipationGranAtom::memory_usage()
{
  return static_cast<double>(nmax) * size * sizeof(double);
}
