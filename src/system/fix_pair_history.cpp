// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/fix_pair_history.h"

#include "system/granular_system.h"

#include "atom.h"
#include "error.h"
#include "utils.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;

namespace {

constexpr int header = 2, stock_values = 3, stock_entry = 1 + stock_values;
// of a list of the store
constexpr int list_header = 2, list_values = 4, list_entry = 1 + list_values;

}    // namespace

FixPairHistory::FixPairHistory(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), system(Talus::GranularSystem::of(lmp))
{
  if (narg != 3 || !utils::strmatch(id, "^NEIGH_HISTORY_HH"))
    error->all(FLERR, "Fix TALUS_PAIR_HISTORY is internal to the pair styles of Talus");
  restart_peratom = 1;
  atom->add_callback(Atom::RESTART);
}

FixPairHistory::~FixPairHistory()
{
  atom->delete_callback(id, Atom::RESTART);
}

void FixPairHistory::post_constructor()
{
  delete[] style;
  style = utils::strdup("NEIGH_HISTORY");
}

/* The list of a particle; returns how many contacts it has. The store has brought its lists up to
   date when the restart file was begun. */

int FixPairHistory::read_list(int i)
{
  Talus::HistoryStore &store = system->histories();
  list.resize(store.list_size(i));
  store.pack_list(i, list.data());
  return static_cast<int>(list[0]);
}

int FixPairHistory::pack_restart(int i, double *buf)
{
  const int contacts = read_list(i), values = static_cast<int>(list[1]);
  const double *from = list.data() + list_header;
  double *to = buf + header;
  for (int n = 0; n < contacts; n++, from += 1 + values, to += stock_entry)
    std::memcpy(to, from, stock_entry * sizeof(double));    // the tag is no number
  buf[0] = static_cast<double>(to - buf);
  buf[1] = contacts;
  return static_cast<int>(to - buf);
}

void FixPairHistory::unpack_restart(int i, int nth)
{
  if (system->histories_were_read()) return;
  const double *from = atom->extra[i];
  for (int n = 0; n < nth; n++) from += static_cast<int>(*from);
  const int contacts = static_cast<int>(from[1]);
  from += header;
  list.assign(list_header + contacts * list_entry, 0.0);
  list[0] = contacts;
  list[1] = list_values;
  double *to = list.data() + list_header;
  for (int n = 0; n < contacts; n++, from += stock_entry, to += list_entry)
    std::memcpy(to, from, stock_entry * sizeof(double));    // and no contact is sliding
  Talus::HistoryStore &store = system->histories();
  store.set_name(i, atom->tag[i]);
  store.unpack_list(i, list.data());
}

/* Exactly: the host writes as much. */

int FixPairHistory::size_restart(int i)
{
  return header + stock_entry * read_list(i);
}

int FixPairHistory::maxsize_restart()
{
  int mine = header + system->histories().largest_list(atom->nlocal), most = 0;
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, world);
  return most;
}
