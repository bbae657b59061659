// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/snapshot/saved_fixes.h"

#include "exchange/large_messages.h"
#include "system/contacts/fix_contact_store.h"
#include "system/host/fix_list.h"
#include "system/host/system_fix.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "comm.h"
#include "fix.h"
#include "modify.h"
#include "utils.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

using namespace LAMMPS_NS;

namespace Talus {

/* The store of contacts is a part of the system. */

bool SavedFixes::is_own(const Fix *fix) const
{
  const SystemFix *own = SystemFix::of(fix);
  return fix == system.store() || (own && own->exchanges_all());
}

bool SavedFixes::follows_particles(const Fix *fix) const
{
  for (int n = 0; n < atom->nextra_grow; n++)
    if (modify->get_fix_by_index(atom->extra_grow[n]) == fix) return true;
  return false;
}

std::string SavedFixes::reason_against() const
{
  for (const Fix *fix : fix_list(*modify)) {
    const std::string name = std::string("fix ") + fix->id + " (" + fix->style + ") ";
    if (fix->rigid_flag && !SystemFix::of(fix))
      return name +
             "of LAMMPS keeps bodies in members that cannot be saved: use fix rigid/small with "
             "the suffix talus, or fix rigid/small/symplectic";
    if (std::strcmp(fix->style, "BOND_HISTORY") == 0)
      return name + "keeps histories of bonds, which are not saved: use a scene without bonds";
  }
  return "";
}

void SavedFixes::save_globals()
{
  for (Fix *fix : fix_list(*modify)) {
    One one;
    one.id = fix->id;
    one.style = fix->style;
    one.next_rebuild = fix->next_reneighbor;
    std::copy_n(fix->virial, 6, one.virial.begin());
    one.pouring = pouring_of(*fix);
    if (fix->restart_global && !is_own(fix)) one.in_restart_file = written_by(fix);
    fixes.push_back(std::move(one));
  }
}

/* The length, and what restart() reads; the same on all ranks. */

std::vector<char> SavedFixes::written_by(Fix *fix) const
{
  char *text = nullptr;
  std::size_t size = 0;
  FILE *const file = open_memstream(&text, &size);
  fix->write_restart(file);
  std::fclose(file);
  std::uint64_t length = size;
  MPI_Bcast(&length, 1, MPI_UINT64_T, 0, world);
  std::vector<char> all(length);
  if (comm->me == 0) std::copy_n(text, length, all.begin());
  std::free(text);
  broadcast(all.data(), length, MPI_CHAR, 0, world);
  return all;
}

void SavedFixes::save()
{
  std::size_t n = 0;
  for (Fix *fix : fix_list(*modify)) {
    One &one = fixes[n++];
    StateExchange saving(one.state);
    if (SystemFix *own = SystemFix::of(fix)) own->exchange_state(saving);
    if (!is_own(fix) && follows_particles(fix)) pack(fix, one.with_particles);
  }
}

/* Some fixes of LAMMPS write more than they announce, by less than LAMMPS itself allows for. */

void SavedFixes::pack(Fix *fix, std::vector<double> &to) const
{
  constexpr int spare = 1024;
  std::size_t size = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    const std::size_t needed = size + fix->maxexchange + spare;
    if (to.size() < needed) to.resize(std::max(needed, 2 * to.size()));
    size += fix->pack_exchange(i, &to[size]);
  }
  to.resize(size);
  to.shrink_to_fit();
}

/* ---------------------------------------------------------------------- */

std::string SavedFixes::reason_against_restoring() const
{
  const std::vector<Fix *> now = fix_list(*modify);
  const auto same = [](const One &one, const Fix *fix) {
    return one.id == fix->id && one.style == fix->style;
  };
  for (const One &one : fixes)
    if (std::none_of(now.begin(), now.end(), [&](const Fix *fix) { return same(one, fix); }))
      return "fix " + one.id + " (" + one.style + ") has been deleted since the snapshot was made";
  for (const Fix *fix : now)
    if (std::none_of(fixes.begin(), fixes.end(), [&](const One &one) { return same(one, fix); }))
      return std::string("fix ") + fix->id + " (" + fix->style +
             ") has been added since the snapshot was made";
  for (std::size_t n = 0; n < now.size(); n++)
    if (!same(fixes[n], now[n]))
      return std::string("fix ") + now[n]->id +
             " has been defined anew since the snapshot was made, at another place";
  return "";
}

void SavedFixes::restore_particles() const
{
  std::size_t n = 0;
  for (Fix *fix : fix_list(*modify)) {
    const One &one = fixes[n++];
    StateExchange restoring(one.state);
    if (SystemFix *own = SystemFix::of(fix)) own->exchange_state(restoring);
    if (one.with_particles.empty()) continue;
    // unpack_exchange() takes what it may write to
    std::vector<double> packed = one.with_particles;
    std::size_t from = 0;
    for (int i = 0; i < atom->nlocal; i++) from += fix->unpack_exchange(i, &packed[from]);
  }
}

/* Fixes of LAMMPS with data of particles may have others by pair, which they make of these when there are new
   lists. */

void SavedFixes::restore_globals() const
{
  std::size_t n = 0;
  for (Fix *fix : fix_list(*modify)) {
    const One &one = fixes[n++];
    if (!one.in_restart_file.empty()) {
      std::vector<char> written(one.in_restart_file.begin() + sizeof(int),
                                one.in_restart_file.end());
      fix->restart(written.data());
    }
    set_pouring(*fix, one.pouring);
    SystemFix *const own = SystemFix::of(fix);
    if (own) own->state_is_restored();
    if (!own && !one.with_particles.empty() &&
        (modify->get_fix_mask(fix) & FixConst::POST_NEIGHBOR))
      fix->post_neighbor();
    fix->next_reneighbor = one.next_rebuild;
    std::copy(one.virial.begin(), one.virial.end(), fix->virial);
  }
}

double SavedFixes::memory_usage() const
{
  double bytes = 0.0;
  for (const One &one : fixes)
    bytes += static_cast<double>(one.in_restart_file.capacity() +
                                 one.with_particles.capacity() * sizeof(double)) +
             one.state.memory_usage();
  return bytes;
}

}    // namespace Talus
