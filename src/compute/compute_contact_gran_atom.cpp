// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "compute/compute_contact_gran_atom.h"

#include "atom.h"
#include "error.h"
#include "memory.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace {
enum { ALL, PARTICLES, BODIES, SIZE };
}

ComputeContactGranAtom::ComputeContactGranAtom(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), system(Talus::GranularSystem::of(lmp))
{
  if (narg > 3) error->all(FLERR, 3, "compute contact/gran/atom: surplus word '{}'", arg[3]);
  peratom_flag = 1;
  size_peratom_cols = SIZE;
  system->account().add_observer(this);
}

ComputeContactGranAtom::~ComputeContactGranAtom()
{
  system->account().drop_observer(this);
  memory->destroy(array_atom);
}

void ComputeContactGranAtom::init()
{
  if (!system->pair_style().is_there())
    error->all(FLERR, "Compute contact/gran/atom requires a pair style of Talus");
}

/* All contacts of an owned particle are known on its rank. */

void ComputeContactGranAtom::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->grow(array_atom, nmax, SIZE, "contact/gran/atom:contacts");
  }
  const int nlocal = atom->nlocal;
  for (int i = 0; i < nlocal; i++) std::fill_n(array_atom[i], SIZE, 0.0);
  const auto count = [&](int i, int which) {
    if (i < 0 || i >= nlocal || !(atom->mask[i] & groupbit)) return;
    array_atom[i][ALL] += 1.0;
    array_atom[i][which] += 1.0;
  };
  system->contacts().for_each(Talus::ContactData::ENERGIES, [&](const Talus::ContactReport &one) {
    count(one.i, one.body < 0 ? PARTICLES : BODIES);
    count(one.j, PARTICLES);
  });
}

double ComputeContactGranAtom::memory_usage()
{
  return static_cast<double>(nmax) * SIZE * sizeof(double);
}
