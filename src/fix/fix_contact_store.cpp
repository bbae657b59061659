// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/fix_contact_store.h"

#include "contact/canonical_key.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {

// keys travel as the bits of a double
double as_double(std::uint64_t key)
{
  double bits;
  std::memcpy(&bits, &key, sizeof bits);
  return bits;
}

std::uint64_t as_key(double bits)
{
  std::uint64_t key;
  std::memcpy(&key, &bits, sizeof key);
  return key;
}

}    // namespace

/* ---------------------------------------------------------------------- */

FixContactStore::FixContactStore(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  if (narg != 4) error->all(FLERR, "Fix CONTACT_STORE is internal to pair style gran/penalty");
  inverse_cell = 1.0 / utils::numeric(FLERR, arg[3], false, lmp);

  restart_global = 1;
  restart_peratom = 1;
  create_attribute = 1;
  maxexchange_dynamic = 1;
  maxexchange = 2;
  comm_border = 1;
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
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
  atom->delete_callback(id, Atom::BORDER);
}

int FixContactStore::setmask()
{
  return POST_INTEGRATE | PRE_EXCHANGE | MIN_PRE_EXCHANGE | POST_NEIGHBOR | MIN_POST_NEIGHBOR;
}

/* ---------------------------------------------------------------------- */

void FixContactStore::init()
{
  // the history must be filed before any fix moves particles between ranks
  for (const auto &ifix : modify->get_fix_list()) {
    if (ifix == this) break;
    if (ifix->pre_exchange_migrate)
      error->all(FLERR, "Pair style gran/penalty must be defined before fix {} {}, "
                 "which migrates atoms: move the pair_style command up", ifix->id, ifix->style);
  }
  next_reneighbor = next_refresh(update->ntimestep);
}

bigint FixContactStore::next_refresh(bigint step) const
{
  return (step / refresh_interval + 1) * refresh_interval;
}

/* Runs before every migration of particles in a run; the rebuild at a refresh is forced, so that the order
   of sums changes at the same steps whatever the skin is. */

void FixContactStore::pre_exchange()
{
  file();
  if (update->ntimestep != next_reneighbor) return;
  for (int i = 0; i < atom->nlocal; i++) refresh_key(i);
  next_reneighbor = next_refresh(update->ntimestep);
}

void FixContactStore::post_integrate()
{
  if (client) client->velocities_have_moved();
}

void FixContactStore::min_pre_exchange()
{
  pre_exchange();
}

void FixContactStore::post_neighbor()
{
  if (client) client->renumber_pairs();
  current = false;
}

void FixContactStore::min_post_neighbor()
{
  post_neighbor();
}

void FixContactStore::setup_post_neighbor()
{
  post_neighbor();
}

/* Between runs particles may be added, deleted or moved to other ranks: the lists travel with them.
   Their IDs must then stay: refuse `reset_atoms id` once there is history. */

void FixContactStore::post_run()
{
  file();
  int mine = 0, any = 0;
  for (int i = 0; i < atom->nlocal; i++) mine = std::max(mine, partners.size(i));
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  stores_ids = any > 0 ? 1 : 0;
}

/* ---------------------------------------------------------------------- */

void FixContactStore::file()
{
  if (client && current) client->file_history(partners);
  current = false;
  maxexchange = 1;
  for (int i = 0; i < atom->nlocal; i++)
    maxexchange = std::max(maxexchange, 1 + partners.packed_size(i));
}

void FixContactStore::refresh_key(int i)
{
  keys[i] = Talus::canonical_key(atom->x[i], inverse_cell);
}

void FixContactStore::grow_arrays(int nmax)
{
  keys.resize(nmax);
  partners.resize(nmax);
}

void FixContactStore::copy_arrays(int i, int j, int /*delflag*/)
{
  keys[j] = keys[i];
  partners.copy(i, j);
}

void FixContactStore::set_arrays(int i)
{
  refresh_key(i);
  partners.clear(i);
}

int FixContactStore::pack_border(int n, int *list, double *buf)
{
  for (int k = 0; k < n; k++) buf[k] = as_double(keys[list[k]]);
  return n;
}

int FixContactStore::unpack_border(int n, int first, double *buf)
{
  for (int k = 0; k < n; k++) keys[first + k] = as_key(buf[k]);
  return n;
}

int FixContactStore::pack_exchange(int i, double *buf)
{
  buf[0] = as_double(keys[i]);
  return 1 + partners.pack(i, buf + 1);
}

int FixContactStore::unpack_exchange(int i, double *buf)
{
  keys[i] = as_key(buf[0]);
  return 1 + partners.unpack(i, buf + 1);
}

/* ---------------------------------------------------------------------- */

void FixContactStore::write_restart(FILE *fp)
{
  file();    // all ranks come here before the particles are packed
  if (comm->me) return;
  const double state[2] = {inverse_cell, static_cast<double>(partners.num_values())};
  const int size = sizeof state;
  fwrite(&size, sizeof size, 1, fp);
  fwrite(state, size, 1, fp);
}

void FixContactStore::restart(char *buf)
{
  double state[2];
  std::memcpy(state, buf, sizeof state);
  inverse_cell = state[0];
  partners.set_values(static_cast<int>(state[1]));
}

int FixContactStore::pack_restart(int i, double *buf)
{
  buf[0] = size_restart(i);
  buf[1] = as_double(keys[i]);
  return 2 + partners.pack(i, buf + 2);
}

void FixContactStore::unpack_restart(int i, int nth)
{
  const double *extra = atom->extra[i];
  int m = 0;
  for (int n = 0; n < nth; n++) m += static_cast<int>(extra[m]);
  keys[i] = as_key(extra[m + 1]);
  partners.unpack(i, extra + m + 2);
}

int FixContactStore::size_restart(int i)
{
  return 2 + partners.packed_size(i);
}

int FixContactStore::maxsize_restart()
{
  int mine = 0, most = 0;
  for (int i = 0; i < atom->nlocal; i++) mine = std::max(mine, size_restart(i));
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, world);
  return most;
}

double FixContactStore::memory_usage()
{
  return static_cast<double>(keys.capacity() * sizeof(std::uint64_t)) + partners.memory_usage();
}
