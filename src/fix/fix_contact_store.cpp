// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/fix_contact_store.h"

#include "contact/canonical_key.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {

constexpr int fixed_size = 6;    // key, filed tag, position, number of partners

// keys and tags travel as the bits of a double
template <class Integer> double as_double(Integer value)
{
  static_assert(sizeof value == sizeof(double));
  double bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

template <class Integer> void from_double(double bits, Integer &value)
{
  static_assert(sizeof value == sizeof bits);
  std::memcpy(&value, &bits, sizeof value);
}

}    // namespace

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
  maxexchange = fixed_size;
  comm_border = 2;
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
  return PRE_EXCHANGE | MIN_PRE_EXCHANGE | PRE_NEIGHBOR | POST_NEIGHBOR | MIN_POST_NEIGHBOR;
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
  guards_positions = !domain->triclinic && !modify->get_fix_by_style("^balance").empty();
  positions.resize(guards_positions ? 3 * keys.size() : 0);
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
  keep_positions();
  if (update->ntimestep != next_reneighbor) return;
  for (int i = 0; i < atom->nlocal; i++) refresh_key(i);
  next_reneighbor = next_refresh(update->ntimestep);
}

void FixContactStore::min_pre_exchange()
{
  pre_exchange();
}

void FixContactStore::setup_pre_exchange()
{
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

/* Between runs particles may be added, deleted, renumbered or moved to other ranks: the lists travel with them. */

void FixContactStore::post_run()
{
  file();
}

/* ---------------------------------------------------------------------- */

void FixContactStore::file()
{
  if (client && current) {
    client->file_history(partners);
    std::copy(atom->tag, atom->tag + atom->nlocal, filed_tags.begin());
  }
  current = false;
  int most = 0;
  for (int i = 0; i < atom->nlocal; i++) most = std::max(most, partners.size(i));
  maxexchange = fixed_size + Talus::PartnerLists::packed_size * most;
}

void FixContactStore::refresh_key(int i)
{
  keys[i] = Talus::canonical_key(atom->x[i], inverse_cell);
}

void FixContactStore::keep_positions()
{
  if (!guards_positions) return;
  domain->pbc();    // as fix balance will: what it then changes is rounding only
  for (int i = 0; i < atom->nlocal; i++)
    std::copy(atom->x[i], atom->x[i] + 3, &positions[3 * i]);
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

void FixContactStore::grow_arrays(int nmax)
{
  keys.resize(nmax);
  filed_tags.resize(nmax);
  if (guards_positions) positions.resize(3 * nmax);
  partners.resize(nmax);
}

void FixContactStore::copy_arrays(int i, int j, int /*delflag*/)
{
  keys[j] = keys[i];
  filed_tags[j] = filed_tags[i];
  if (guards_positions) std::copy(&positions[3 * i], &positions[3 * i] + 3, &positions[3 * j]);
  partners.copy(i, j);
}

void FixContactStore::set_arrays(int i)
{
  refresh_key(i);
  filed_tags[i] = 0;
  if (guards_positions) std::copy(atom->x[i], atom->x[i] + 3, &positions[3 * i]);
  partners.clear(i);
}

int FixContactStore::pack_border(int n, int *list, double *buf)
{
  int m = 0;
  for (int k = 0; k < n; k++) {
    buf[m++] = as_double(keys[list[k]]);
    buf[m++] = as_double(filed_tags[list[k]]);
  }
  return m;
}

int FixContactStore::unpack_border(int n, int first, double *buf)
{
  int m = 0;
  for (int i = first; i < first + n; i++) {
    from_double(buf[m++], keys[i]);
    from_double(buf[m++], filed_tags[i]);
  }
  return m;
}

int FixContactStore::pack_exchange(int i, double *buf)
{
  int m = 0;
  buf[m++] = as_double(keys[i]);
  buf[m++] = as_double(filed_tags[i]);
  for (int d = 0; guards_positions && d < 3; d++) buf[m++] = positions[3 * i + d];
  return m + partners.pack(i, buf + m);
}

int FixContactStore::unpack_exchange(int i, double *buf)
{
  int m = 0;
  from_double(buf[m++], keys[i]);
  from_double(buf[m++], filed_tags[i]);
  for (int d = 0; guards_positions && d < 3; d++) positions[3 * i + d] = buf[m++];
  return m + partners.unpack(i, buf + m);
}

/* ---------------------------------------------------------------------- */

void FixContactStore::write_restart(FILE *fp)
{
  file();    // all ranks come here before the particles are packed
  if (comm->me) return;
  const int size = sizeof inverse_cell;
  fwrite(&size, sizeof size, 1, fp);
  fwrite(&inverse_cell, size, 1, fp);
}

void FixContactStore::restart(char *buf)
{
  std::memcpy(&inverse_cell, buf, sizeof inverse_cell);
}

int FixContactStore::pack_restart(int i, double *buf)
{
  buf[0] = size_restart(i);
  buf[1] = as_double(keys[i]);
  buf[2] = as_double(filed_tags[i]);
  return 3 + partners.pack(i, buf + 3);
}

void FixContactStore::unpack_restart(int i, int nth)
{
  const double *extra = atom->extra[i];
  int m = 0;
  for (int n = 0; n < nth; n++) m += static_cast<int>(extra[m]);
  from_double(extra[m + 1], keys[i]);
  from_double(extra[m + 2], filed_tags[i]);
  partners.unpack(i, extra + m + 3);
}

int FixContactStore::size_restart(int i)
{
  return 4 + Talus::PartnerLists::packed_size * partners.size(i);
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
  return static_cast<double>(keys.capacity() * sizeof(std::uint64_t) +
                             filed_tags.capacity() * sizeof(std::int64_t) +
                             positions.capacity() * sizeof(double)) + partners.memory_usage();
}
