// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Particles in memory follow the canonical order while a run lasts.

#include "system/contacts/fix_contact_store.h"

#include "system/step/granular_system.h"

#include "base/in_parallel.h"
#include "base/nearly_sorted.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "force.h"

#include <algorithm>
#include <utility>
#include <vector>

using namespace LAMMPS_NS;

/* LAMMPS sorts particles by place now and then, for the sake of the cache. Sorting them into the
   canonical order instead serves the same end, and lets the records of src/contact be read and
   written straight through. Only while a run lasts: init() is called by many commands after which
   no run follows, and what atom_modify sets between runs must hold.

   It is done before the exchange, where the histories of bonds, and those of other pair styles, are
   still known by the places of particles in lists of LAMMPS: then LAMMPS sorts, behind it. */

void FixContactStore::take_over_sorting()
{
  if (lammps_sorts_every || atom->sortfreq <= 0 || atom->firstgroupname) return;
  if (atom->nbonds > 0 || force->bond || !system->pair_style().is_alone()) return;
  lammps_sorts_every = atom->sortfreq;
  atom->sortfreq = 0;    // until post_run()
}

void FixContactStore::sort_particles()
{
  if (!lammps_sorts_every) return;
  const int n = atom->nlocal;
  struct Place {
    std::uint64_t key;
    tagint tag;
    int from;
  };
  const auto before = [](const Place &a, const Place &b) {
    return a.key != b.key ? a.key < b.key : a.tag < b.tag;
  };
  std::vector<Place> places(n);
  Talus::in_ranges(n, comm->nthreads, [&](int, int begin, int end) {
    for (int i = begin; i < end; i++) places[i] = {keys[i], atom->tag[i], i};
  });
  if (std::is_sorted(places.begin(), places.end(), before)) return;
  Talus::sort_nearly_sorted(places, before);
  std::vector<int> from(n);    // which particle goes to each place
  for (int i = 0; i < n; i++) from[i] = places[i].from;

  // every cycle of the permutation turns through one spare place behind the last particle
  if (n == atom->nmax) atom->avec->grow(0);
  for (int start = 0; start < n; start++) {
    if (from[start] == start) continue;
    atom->avec->copy(start, n, 0);
    int place = start;
    while (from[place] != start) {
      atom->avec->copy(from[place], place, 0);
      place = std::exchange(from[place], place);
    }
    atom->avec->copy(n, place, 0);
    from[place] = place;
  }
}

void FixContactStore::give_sorting_back()
{
  if (!lammps_sorts_every) return;
  atom->sortfreq = lammps_sorts_every;
  atom->nextsort = MAXBIGINT;    // not before the next setup, which makes the bins for it
  lammps_sorts_every = 0;
}
