// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/fix_pair_history.h"

#include "system/fix_contact_store.h"
#include "system/granular_system.h"

#include "atom.h"
#include "error.h"
#include "utils.h"

#include <cstring>
#include <string>

using namespace LAMMPS_NS;

namespace {

constexpr int header = 2;
// of a list of the store
constexpr int list_header = 2, list_values = Talus::ContactBatch::history_size, least_entry = 5;

/* See ContactBatch::history. */

bool is_even(int place)
{
  return place % 4 == 3 || (place >= 4 && place < 8);
}

}    // namespace

FixPairHistory::FixPairHistory(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), system(Talus::GranularSystem::of(lmp))
{
  if (narg < 4 || !utils::strmatch(id, "^NEIGH_HISTORY_"))
    error->all(FLERR, "Fix TALUS_PAIR_HISTORY is internal to the pair styles of Talus");
  for (int n = 3; n < narg; n++)
    place_of_value.push_back(
        arg[n] == std::string("-") ? -1 : utils::inumeric(FLERR, arg[n], true, lmp));
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
  Talus::HistoryStore &store = system->store()->histories();
  list.resize(store.list_size(i));
  store.pack_list(i, list.data());
  return static_cast<int>(list[0]);
}

int FixPairHistory::pack_restart(int i, double *buf)
{
  const int contacts = read_list(i), values = static_cast<int>(list[1]);
  const double *from = list.data() + list_header;
  double *to = buf + header;
  for (int n = 0; n < contacts; n++, from += 1 + values) {
    std::memcpy(to++, from, sizeof(double));    // the tag is no number
    for (const int place : place_of_value)
      *to++ = place >= 0 && place < values ? from[1 + place] : 0.0;
  }
  buf[0] = static_cast<double>(to - buf);
  buf[1] = contacts;
  return static_cast<int>(to - buf);
}

void FixPairHistory::unpack_restart(int i, int nth)
{
  if (system->store()->restart_reset) return;
  const double *from = atom->extra[i];
  for (int n = 0; n < nth; n++) from += static_cast<int>(*from);
  const int contacts = static_cast<int>(from[1]);
  from += header;
  list.assign(list_header + contacts * (1 + list_values), 0.0);
  list[0] = contacts;
  list[1] = list_values;
  double *to = list.data() + list_header;
  for (int n = 0; n < contacts; n++, from += stock_entry(), to += 1 + list_values) {
    std::memcpy(to, from, sizeof(double));
    for (std::size_t k = 0; k < place_of_value.size(); k++)
      if (place_of_value[k] >= 0) to[1 + place_of_value[k]] = from[1 + k];
    const auto before = read_before.find(static_cast<tagint>(ubuf(*from).i));
    if (before != read_before.end()) take_even_values_of(before->second, atom->tag[i], to + 1);
  }
  Talus::HistoryStore &store = system->store()->histories();
  store.set_name(i, atom->tag[i]);
  store.unpack_list(i, list.data());
  system->store()->set_order_of_histories(1);
  read_before[atom->tag[i]] = i;
}

/* Of the contact with the particle of this tag. */

void FixPairHistory::take_even_values_of(int partner, tagint tag, double *values)
{
  Talus::HistoryStore &store = system->store()->histories();
  other.resize(store.list_size(partner));
  store.pack_list(partner, other.data());
  const double *entry = other.data() + list_header, *end = other.data() + other.size();
  for (; entry < end; entry += 1 + list_values) {
    if (ubuf(*entry).i != tag) continue;
    for (int place = 0; place < list_values; place++)
      if (is_even(place)) values[place] = entry[1 + place];
  }
}

/* Exactly: the host writes as much. */

int FixPairHistory::size_restart(int i)
{
  return header + stock_entry() * read_list(i);
}

int FixPairHistory::maxsize_restart()
{
  const int contacts = system->store()->histories().largest_list(atom->nlocal) / least_entry;
  int mine = header + stock_entry() * contacts, most = 0;
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, world);
  return most;
}
