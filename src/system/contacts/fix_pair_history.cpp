// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/fix_pair_history.h"

#include "system/contacts/fix_contact_store.h"
#include "system/host/restart_data.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "error.h"
#include "utils.h"

#include <algorithm>
#include <string>

using namespace LAMMPS_NS;

namespace {

constexpr int header = 2;

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

/* The store has brought its lists up to date when the restart file was begun. */

int FixPairHistory::pack_restart(int i, double *buf)
{
  const auto contacts = system->memory().pairs().contacts_of(i);
  double *to = buf + header;
  for (const Talus::HistoryStore::Contact &one : contacts) {
    *to++ = ubuf(one.partner).d;
    for (const int place : place_of_value) *to++ = place >= 0 ? one.history[place] : 0.0;
  }
  buf[0] = static_cast<double>(to - buf);
  buf[1] = static_cast<double>(contacts.size());
  return static_cast<int>(to - buf);
}

void FixPairHistory::unpack_restart(int i, int nth)
{
  if (system->store()->has_read_pairs()) return;
  const double *from = Talus::stock_particle_data(
      lmp, std::string("Pair style ") + system->pair_style().name(), i, nth,
      [this](const double *data) {
        const bool is_count = data[1] >= 0.0 && data[1] <= atom->nextra_store;
        return is_count ? header + stock_entry() * static_cast<bigint>(data[1]) : -1;
      });
  if (!from) return;
  const int contacts = static_cast<int>(from[1]);
  from += header;
  Talus::HistoryStore &store = system->memory().pairs();
  store.set_name(i, atom->tag[i]);
  for (int n = 0; n < contacts; n++, from += stock_entry()) {
    Talus::HistoryStore::Contact one{ubuf(*from).i, {}};
    for (std::size_t k = 0; k < place_of_value.size(); k++)
      if (place_of_value[k] >= 0) one.history[place_of_value[k]] = from[1 + k];
    const auto before = read_before.find(static_cast<tagint>(one.partner));
    if (before != read_before.end()) take_even_values_of(before->second, atom->tag[i], one.history);
    store.add(i, one);
  }
  system->store()->set_order_of_histories(1);
  read_before[atom->tag[i]] = i;
}

/* Of the contact with the particle of this tag: see base/history_values.h. */

void FixPairHistory::take_even_values_of(int partner, tagint tag, Talus::HistoryValues &values)
{
  for (const Talus::HistoryStore::Contact &one : system->memory().pairs().contacts_of(partner))
    if (one.partner == tag)
      std::copy(one.history.begin() + 3, one.history.end(), values.begin() + 3);
}

/* Exactly: LAMMPS writes as much. */

int FixPairHistory::size_restart(int i)
{
  return header + stock_entry() * static_cast<int>(system->memory().pairs().contacts_of(i).size());
}

int FixPairHistory::maxsize_restart()
{
  const int contacts = system->memory().pairs().largest_count(atom->nlocal);
  int mine = header + stock_entry() * contacts, most = 0;
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, world);
  return most;
}
