// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/fix_contact_store.h"

#include "system/granular_system.h"

#include "base/in_parallel.h"
#include "particles/canonical_key.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixContactStore::FixContactStore(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  if (narg != 4 || !utils::strmatch(id, "^TALUS_CONTACTS"))
    error->all(FLERR, "Fix CONTACT_STORE is internal to pair style gran/penalty");
  inverse_cell = 1.0 / utils::numeric(FLERR, arg[3], false, lmp);

  restart_global = 1;
  restart_peratom = 1;
  create_attribute = 1;
  maxexchange_dynamic = 1;
  maxexchange = 6;
  comm_border = 2;
  comm_forward = 1 + 8;    // one entry of a list
  force_reneighbor = 1;
  next_reneighbor = next_refresh(update->ntimestep);

  FixContactStore::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  atom->add_callback(Atom::BORDER);
  for (int i = 0; i < atom->nlocal; i++) FixContactStore::set_arrays(i);
}

FixContactStore::~FixContactStore()
{
  give_sorting_back();    // after a run that ended in an error
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
  atom->delete_callback(id, Atom::BORDER);
}

int FixContactStore::setmask()
{
  return POST_INTEGRATE | PRE_EXCHANGE | MIN_PRE_EXCHANGE | PRE_NEIGHBOR | POST_NEIGHBOR |
         MIN_POST_NEIGHBOR;
}

/* ---------------------------------------------------------------------- */

void FixContactStore::init()
{
  // the history must be filed before any fix moves particles between ranks
  for (const auto &ifix : modify->get_fix_list()) {
    if (ifix == this) break;
    if (ifix->pre_exchange_migrate)
      error->all(FLERR,
                 "Pair style gran/penalty must be defined before fix {} {}, "
                 "which migrates atoms: move the pair_style command up",
                 ifix->id, ifix->style);
  }
  next_reneighbor = next_refresh(update->ntimestep);
  guards_positions = !domain->triclinic && !modify->get_fix_by_style("^balance").empty();
  positions.resize(guards_positions ? 3 * keys.size() : 0);
  find_maxexchange();    // of lists from a restart file
}

bigint FixContactStore::next_refresh(bigint step) const
{
  return (step / refresh_interval + 1) * refresh_interval;
}

/* Runs before every migration of particles in a run; the rebuild at a refresh is forced, so that
   the order of sums changes at the same steps whatever the skin is. */

void FixContactStore::pre_exchange()
{
  store_histories(Occasion::REBUILD);
  if (system) system->release_pairs();
  keep_positions();
  if (update->ntimestep != next_reneighbor) return;
  Talus::in_ranges(atom->nlocal, comm->nthreads, [this](int, int begin, int end) {
    for (int i = begin; i < end; i++) refresh_key(i);
  });
  sort_particles();
  next_reneighbor = next_refresh(update->ntimestep);
}

void FixContactStore::post_integrate()
{
  if (system) system->velocities_have_moved();
}

void FixContactStore::min_pre_exchange()
{
  pre_exchange();
}

void FixContactStore::setup_pre_exchange()
{
  if (in_periodic_box()) file_kept();    // which it was not in the last run
  take_over_sorting();
  sort_particles();
  keep_positions();
}

void FixContactStore::setup_pre_neighbor()
{
  put_positions_back();
}

void FixContactStore::pre_neighbor()
{
  put_positions_back();
}

void FixContactStore::post_neighbor()
{
  current = false;
  if (system) system->renumber_pairs();
}

void FixContactStore::min_post_neighbor()
{
  post_neighbor();
}

void FixContactStore::setup_post_neighbor()
{
  post_neighbor();
}

void FixContactStore::pairs_are_current()
{
  if (!current) {
    partners.release();
    kept.clear();
  }
  current = true;
}

/* From here on each particle carries its slot along, whoever moves or deletes it before histories
   are stored. */

void FixContactStore::pairs_are_numbered(const std::vector<int> &slot_of_atom)
{
  std::copy_n(slot_of_atom.begin(), atom->nlocal, kept_slots.begin());
  current = false;    // what is stored has been taken
  pairs_are_current();
}

/* Between runs particles may be added, deleted, renumbered or moved to other ranks: histories go
   with them. */

void FixContactStore::post_run()
{
  store_histories(Occasion::END_OF_RUN);
  if (system && !kept.empty()) system->release_pairs();
  give_sorting_back();
}

/* ---------------------------------------------------------------------- */

bool FixContactStore::in_periodic_box() const
{
  return domain->xperiodic || domain->yperiodic || domain->zperiodic;
}

/* Across a periodic border a particle meets images of others, which only lists can tell apart. */

void FixContactStore::store_histories(Occasion occasion)
{
  if (!system || !current) return;
  system->look_at_contacts();
  if (occasion != Occasion::RESTART_FILE) system->release_records();
  const bool last_use = occasion == Occasion::REBUILD ||
                        (occasion == Occasion::END_OF_RUN && !system->account_waits_for_move());
  if (last_use && !in_periodic_box())
    system->keep_history(kept, comm->nprocs > 1 || occasion == Occasion::END_OF_RUN);
  else
    system->file_history(partners);
  // ghosts too: a run may go on without new ones
  for (int i = 0; i < atom->nlocal + atom->nghost; i++) filed_tags[i] = atom->tag[i];
  if (in_periodic_box()) agree_on_shared_pairs();
  current = false;
  find_maxexchange();
}

/* From what is kept to lists. */

void FixContactStore::file_kept()
{
  if (kept.empty()) return;
  std::vector<double> buffer(partners.packed_size_of(kept.most_contacts()));
  for (int i = 0; i < atom->nlocal; i++) {
    if (kept_slots[i] < 0) continue;
    kept.pack(kept_slots[i], partners.num_values(), buffer.data());
    partners.unpack(i, buffer.data());
  }
  kept.clear();
}

/* What pack_exchange() may have to write, on this rank or on one that a particle passes through. */

void FixContactStore::find_maxexchange()
{
  int mine = kept.most_contacts(), most = 0;
  for (int i = 0; !partners.empty() && i < atom->nlocal; i++)
    mine = std::max(mine, partners.size(i));
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, world);
  maxexchange = 5 + partners.packed_size_of(most);
}

void FixContactStore::refresh_key(int i)
{
  keys[i] = Talus::canonical_key(atom->x[i], inverse_cell);
}

void FixContactStore::keep_positions()
{
  if (!guards_positions) return;
  domain->pbc();    // as fix balance will: what it then changes is rounding only
  for (int i = 0; i < atom->nlocal; i++) std::copy(atom->x[i], atom->x[i] + 3, &positions[3 * i]);
}

/* Undoes rounding, never a move that somebody meant. */

void FixContactStore::put_positions_back()
{
  if (!guards_positions) return;
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  for (int i = 0; i < atom->nlocal; i++)
    for (int d = 0; d < 3; d++) {
      const double largest = std::fabs(domain->boxlo[d]) + domain->prd[d];
      double &x = atom->x[i][d];
      if (std::fabs(x - positions[3 * i + d]) <= rounding * largest) x = positions[3 * i + d];
    }
  comm->forward_comm();    // ghosts were made of the rounded positions
}

double FixContactStore::memory_usage()
{
  return static_cast<double>((keys.capacity() + filed_tags.capacity()) * sizeof(std::uint64_t) +
                             positions.capacity() * sizeof(double) +
                             kept_slots.capacity() * sizeof(int)) +
         partners.memory_usage() + kept.memory_usage();
}
