// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/snapshot/saved_particles.h"

#include "atom.h"
#include "atom_vec.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;

namespace Talus {

/* All arrays of LAMMPS are in one piece, and begin at the first row. Where rows differ in length all have
   room for the longest. */

SavedParticles::Array SavedParticles::array(std::size_t place) const
{
  const Atom::PerAtom &one = atom->peratom[place];
  const std::size_t size = one.datatype == Atom::INT ? sizeof(int) : sizeof(double);
  static_assert(sizeof(bigint) == sizeof(double));
  char *const pointer = *static_cast<char **>(one.address);
  if (!pointer || owned == 0) return {nullptr, 0};
  if (one.cols == 0) return {pointer, size};
  const int columns = one.cols > 0 ? one.cols : *one.address_maxcols;
  char *const first_row = *reinterpret_cast<char **>(pointer);
  return {columns ? first_row : nullptr, size * columns};
}

void SavedParticles::save()
{
  owned = atom->nlocal;
  first_group = atom->nfirst;
  total = owned + atom->nghost;
  number = atom->natoms;
  for (std::size_t place = 0; place < atom->peratom.size(); place++) {
    if (atom->peratom[place].name == "mu3") continue;    // a part of mu
    const Array from = array(place);
    if (!from.first) continue;
    arrays.push_back({place, from.bytes, {from.first, from.first + from.bytes * owned}});
  }
}

/* Rows may have become longer. */

void SavedParticles::restore(bool ghosts_stay) const
{
  while (atom->nmax < total) atom->avec->grow(0);
  atom->nlocal = owned;
  atom->nfirst = first_group;
  atom->natoms = number;
  if (!ghosts_stay) atom->nghost = 0;
  for (const Rows &rows : arrays) restore(rows);
}

void SavedParticles::restore_positions() const
{
  for (const Rows &rows : arrays)
    if (atom->peratom[rows.place].name == "x") restore(rows);
}

void SavedParticles::restore(const Rows &rows) const
{
  const Array to = array(rows.place);
  if (to.bytes == rows.bytes) {
    std::memcpy(to.first, rows.data.data(), rows.data.size());
    return;
  }
  for (int i = 0; i < owned; i++)
    std::memcpy(to.first + i * to.bytes, &rows.data[i * rows.bytes],
                std::min(rows.bytes, to.bytes));
}

double SavedParticles::memory_usage() const
{
  double bytes = 0.0;
  for (const Rows &rows : arrays) bytes += static_cast<double>(rows.data.capacity());
  return bytes;
}

}    // namespace Talus
