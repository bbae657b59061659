// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/bodies/host_wall.h"

#include "base/state_exchange.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "comm.h"
#include "fix.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace Talus {

HostWall::HostWall(const Fix *command, Arrays &stock, GranularSystem &owner, LAMMPS *lmp) :
    Pointers(lmp), fix(command), arrays(stock), system(owner)
{
}

void HostWall::begin_run(const LawTable &laws, const LargeBodyShape &of_run, bool is_bounded,
                         bool history)
{
  surface = &of_run;
  bounded = is_bounded;
  is_listed = false;
  contacts.set_laws(laws);
  contacts.history.keep_parts(surface->most_contacts() > 1);
  contacts.history.keep_records(std::max(laws.history_records(), 1));
  if (history) take_arrays();
}

void HostWall::leave_run()
{
  system.memory().put_aside();
  for (int i = 0; i < atom->nlocal; i++) fill_row(i);
  contacts.history.leave_memory();
}

/* ---- what contacts remember ---- */

void HostWall::take_arrays()
{
  ContactMemory &memory = system.memory();
  BodyHistory &history = contacts.history;
  memory.put_aside();
  history.rest_in(memory, ContactMemory::name_of(fix->id));
  for (int i = 0; i < atom->nlocal; i++) {
    const int all = arrays.count(i);
    if (!all) continue;    // a restart file has them twice
    memory.lists_to_fill().remove_if(
        i, [&history](const ContactLists::Contact &one) { return history.owns(one); });
    for (int k = 0; k < all; k++) {
      HistoryValues values{};
      const int part = arrays.read(i, k, values);
      history.add(memory.lists_to_fill(), i, part, {0.0, 0.0, 0.0}, values);
    }
    arrays.clear(i);
  }
}

void HostWall::fill_row(int i)
{
  if (!contacts.history.has_memory()) return;
  system.memory().lists().for_each(i, [&](const ContactLists::Contact &one) {
    if (contacts.history.owns(one))
      arrays.add(i, static_cast<int>(one.feature), BodyHistory::values_of(one));
  });
}

void HostWall::clear_row(int i)
{
  if (contacts.history.has_memory()) arrays.clear(i);
}

void HostWall::exchange_state(StateExchange &x)
{
  bool in_memory = contacts.history.has_memory();
  x(for_outputs, in_memory);
  if (in_memory)
    contacts.history.rest_in(system.memory(), ContactMemory::name_of(fix->id));
  else
    contacts.history.leave_memory();
}

/* ---- particles that may touch it ---- */

bool HostWall::is_stale(double moved, double displacement) const
{
  return !is_listed || atom->nlocal != owned_then ||
         (bounded && !(moved + moved_then + displacement <= neighbor->skin));
}

bool HostWall::list_if_needed(double displacement)
{
  if (!is_stale(bounded ? system.step().moved_at_most() : 0.0, displacement)) return false;
  const double moved = bounded ? system.step().moved_since_rebuild() : 0.0;
  if (!is_stale(moved, displacement)) return false;
  list(moved);
  return true;
}

void HostWall::list(double moved)
{
  constexpr double anywhere = 1.0e100;
  contacts.find_candidates(*surface, at_rest, system.step().particles(), atom->mask, fix->groupbit,
                           bounded ? neighbor->skin : anywhere, comm->nthreads);
  find_masses();
  is_listed = true;
  owned_then = atom->nlocal;
  moved_then = moved;
}

Eigen::AlignedBox3d HostWall::bounds_of_search() const
{
  return contacts.bounds_of_search(at_rest, system.step().particles(), atom->mask, fix->groupbit,
                                   neighbor->skin);
}

/* As LAMMPS has them here: those of bodies, but neither converted nor infinite. */

void HostWall::find_masses()
{
  masses.clear();
  if (!system.masses().needed()) return;
  for (int i = 0; i < atom->nlocal; i++) masses.push_back(system.masses().of_body(i));
}

/* ---- forces ---- */

void HostWall::begin_step(bool listed)
{
  for_outputs.begin(listed || system.account().has_observers());
}

/* As in LAMMPS, histories stand still while a run is set up, but what slips is set back; and where there
   may be several contacts none lasts beyond zero overlap. */

void HostWall::compute(const BodyHeat &heat)
{
  constexpr std::size_t worth_a_thread = 100;    // candidates
  const bool accounts = system.account().is_asked();
  WorkAccount account;
  if (accounts) account = system.account().part_of_step();
  BodyStep step;
  step.dt = update->setupflag ? 0.0 : update->dt;
  step.threads = static_cast<int>(
      std::clamp<std::size_t>(contacts.num_candidates() / worth_a_thread, 1, comm->nthreads));
  step.ends_at_zero_overlap = surface->most_contacts() > 1;
  step.masses = masses.empty() ? nullptr : masses.data();
  step.heat = heat;
  step.account = accounts ? &account : nullptr;
  if (system.step().may_be_asked()) step.for_outputs = &for_outputs;
  contacts.compute(*surface, at_rest, system.step().particles(), step);
  if (accounts) system.account().add(account.sum);
}

}    // namespace Talus
