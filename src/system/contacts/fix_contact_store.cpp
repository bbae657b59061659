// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/fix_contact_store.h"

#include "system/contacts/bond_account.h"
#include "system/host/fix_list.h"
#include "system/host/restart_data.h"
#include "system/host/system_style.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"

#include "base/in_parallel.h"
#include "body/shape/large_body_shape.h"
#include "particles/canonical_key.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "integrate.h"
#include "modify.h"
#include "output.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

using namespace LAMMPS_NS;
using Talus::record_of;
using namespace FixConst;
using Talus::ContactLists, Talus::HistoryStore, Talus::most_history_values;

/* ---------------------------------------------------------------------- */

FixContactStore::FixContactStore(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), system(Talus::GranularSystem::of(lmp)),
    memory_of_contacts(system->memory()), store(memory_of_contacts.pairs()), exchange(world)
{
  if (narg != 3 || !utils::strmatch(id, "^TALUS_CONTACTS"))
    error->all(FLERR, "Fix CONTACT_STORE is internal to Talus");
  system->contact_store().is_there(this);

  restart_global = 1;
  restart_peratom = 1;
  create_attribute = 1;
  maxexchange_dynamic = 1;
  nevery = 1;    // of the end of step
  set_maxexchange(0);
  comm_forward = size_change;
  FixContactStore::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  atom->add_callback(Atom::BORDER);
  for (int i = 0; i < atom->nlocal; i++) FixContactStore::set_arrays(i);
}

FixContactStore::~FixContactStore()
{
  give_sorting_back();    // after a run that ended in an error
  if (system->store() == this) system->contact_store().is_gone();
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
  atom->delete_callback(id, Atom::BORDER);
}

int FixContactStore::setmask()
{
  return PRE_EXCHANGE | MIN_PRE_EXCHANGE | PRE_NEIGHBOR | POST_NEIGHBOR | MIN_POST_NEIGHBOR |
         END_OF_STEP;
}

/* ---------------------------------------------------------------------- */

bool FixContactStore::has_pairs() const
{
  return system->pair_style().is_there();
}

/* For messages. */

std::string FixContactStore::name() const
{
  return has_pairs() ? std::string("Pair style ") + system->pair_style().name() : "Fix large/body";
}

void FixContactStore::use_cells(double edge)
{
  if (inverse_cell > 0.0) return;
  inverse_cell = 1.0 / edge;
  for (int i = 0; i < atom->nlocal; i++) refresh_key(i);
}

void FixContactStore::forget_pairs()
{
  if (!was_used) return;
  memory_of_contacts.drop_spheres();
  keep_changes(false);
  inverse_cell = 0.0;
  order = 0;
  current = false;
}

void FixContactStore::init()
{
  Talus::require_intact_particles(lmp);
  comm_border = has_pairs() ? size_border : 0;
  force_reneighbor = has_pairs() && !domain->deform_vremap ? 1 : 0;
  was_used = true;
  if (has_pairs())
    init_for_pairs();
  else
    init_without_pairs();
  // from a restart file, of which a rank without particles may know nothing
  const int mine[2] = {store.largest_list(atom->nlocal), order};
  int largest[2] = {0, 0};
  MPI_Allreduce(mine, largest, 2, MPI_INT, MPI_MAX, world);
  set_maxexchange(largest[0]);
  order = largest[1];
}

/* Contacts of spheres are those of a style of LAMMPS. */

void FixContactStore::init_without_pairs()
{
  memory_of_contacts.drop_spheres();
  keep_changes(false);
  guards_positions = false;
  positions = {};
}

void FixContactStore::init_for_pairs()
{
  system->setup_state().list_fixes();
  // the history must be put aside before any fix moves particles between ranks
  for (const auto &ifix : Talus::fix_list(*modify)) {
    if (ifix == this) break;
    if (ifix->pre_exchange_migrate)
      error->all(FLERR,
                 "Pair style {} must be defined before fix {} {}, which migrates atoms: move the "
                 "pair_style command up",
                 system->pair_style().name(), ifix->id, ifix->style);
  }
  next_reneighbor = next_refresh(update->ntimestep);
  keep_changes(system->step().needs_changes());
  guards_positions = !domain->triclinic && !modify->get_fix_by_style("^balance").empty();
  positions.resize(guards_positions ? 3 * keys.size() : 0);
}

bigint FixContactStore::next_refresh(bigint step) const
{
  return (step / refresh_interval + 1) * refresh_interval;
}

/* Runs before every migration of particles in a run; the rebuild at a refresh is forced, so that
   the order of sums changes at the same steps whatever the skin is. Not where velocities change at
   the boundaries (fix deform with remap v), which LAMMPS does when it builds lists: those are periodic
   boxes, where bits depend on the skin anyway, and the next rebuild will do. */

void FixContactStore::pre_exchange()
{
  if (Talus::BondAccount *bonds = Talus::BondAccount::of(force->bond))
    bonds->complete_kick(system->step().particles());
  store_histories(Occasion::REBUILD);
  if (!has_pairs()) return;
  system->rebuild().release_pairs();
  keep_positions();
  if (update->ntimestep < next_reneighbor) return;
  Talus::in_ranges(atom->nlocal, comm->nthreads, [this](int, int begin, int end) {
    for (int i = begin; i < end; i++) refresh_key(i);
  });
  sort_particles();
  next_reneighbor = next_refresh(update->ntimestep);
}

void FixContactStore::setup_pre_exchange()
{
  if (!has_pairs()) return;
  // a run style of LAMMPS cannot do so
  if (update->whichflag == 1 && !Talus::SystemStyle::of(update->integrate))
    system->steps_in_records().report(true);
  system->rebuild().release_pairs();
  take_over_sorting();
  sort_particles();
  keep_positions();
}

void FixContactStore::post_neighbor()
{
  current = false;
  if (has_pairs())
    system->rebuild().renumber_pairs();
  else
    memory_of_contacts.drop_spheres();
}

void FixContactStore::pairs_are_current()
{
  if (!current) memory_of_contacts.drop_spheres();
  current = true;
}

/* Histories of the other order are kept as a whole until they have been changed. */

void FixContactStore::keep_histories(int records, int integration_order)
{
  const int needed = std::max(records, 1);
  const bool old_ones = order != 0 && order != integration_order;
  store.keep(old_ones ? std::max(needed, store.num_records()) : needed);
}

void FixContactStore::end_of_step()
{
  if (update->ntimestep == output->next || update->ntimestep == update->laststep) require_numbers();
}

/* From here on each particle carries its slot along, also if it is moved or deleted before
   histories are stored. */

void FixContactStore::pairs_are_numbered(const Talus::ParticleOrder &order)
{
  memory_of_contacts.are_numbered(order);
  current = true;
}

/* Between runs particles may be added, deleted, renumbered or moved to other ranks: histories go
   with them. */

void FixContactStore::post_run()
{
  store_histories(Occasion::END_OF_RUN);
  if (has_pairs()) system->rebuild().end_contacts_of_run();
  give_sorting_back();
}

/* ---------------------------------------------------------------------- */

bool FixContactStore::in_periodic_box() const
{
  return domain->xperiodic || domain->yperiodic || domain->zperiodic;
}

/* Pairs stay after a run, for those who ask for contacts, and for a run that goes on without a new
   set-up: in a periodic box it goes on with the histories of both sides as they are, not with what the
   sides agree on, so with the same bits as one run. */

void FixContactStore::store_histories(Occasion occasion)
{
  if (current) {
    system->run_monitor().look(occasion == Occasion::END_OF_RUN ? RunMonitor::Moment::END
                                                                : RunMonitor::Moment::REBUILD);
    const bool rebuild = occasion == Occasion::REBUILD;
    const bool particles_may_leave = comm->nprocs > 1 || !rebuild;
    system->rebuild().keep_history({particles_may_leave, in_periodic_box()}, !rebuild);
    current = false;
  }
  memory_of_contacts.put_aside();
  if (Talus::ShapedParticles *shapes = system->shapes()) shapes->agree_with_other_ranks();
  agree_with_other_ranks();
}

/* On the histories of contacts across periodic borders, and on what pack_exchange() may have to
   write, on this rank or on one that a particle passes through. */

void FixContactStore::agree_with_other_ranks()
{
  int largest = store.largest_list(atom->nlocal);
  if (comm->nprocs > 1) {
    const int mine = largest;
    if (in_periodic_box() && store.holds_last_lists())
      largest = exchange.run(store.outgoing(), mine,
                             [this](const std::vector<double> &m) { store.receive(m); });
    else
      MPI_Allreduce(&mine, &largest, 1, MPI_INT, MPI_MAX, world);
  }
  set_maxexchange(largest);
}

/* What a restart file has brought stays. */

void FixContactStore::keep_changes(bool yes)
{
  with_changes = yes;
  if (yes) {
    changes.resize(keys.size(), Talus::ChangeRecord{});
  } else {
    with_last = false;
    changes = {};
    last = {};
  }
}

/* An integrator unknown to us: the last kick, or both that there were, is taken as twice what the
   velocity is behind. */

void FixContactStore::follow_velocities(int mine, const Talus::ShapedParticles *shapes)
{
  if (!with_last) return;
  Talus::in_ranges(atom->nlocal, comm->nthreads, [=](int, int begin, int end) {
    for (int i = begin; i < end; i++) {
      if ((atom->mask[i] & mine) || (shapes && shapes->moves(i))) continue;
      const double *const before = last[i].data();
      Talus::store(changes[i],
                   Talus::change_by_kick(0.5, atom->radius[i], record_of(before, 0.0),
                                         record_of(atom->v[i], 0.0), record_of(before + 3, 0.0),
                                         record_of(atom->omega[i], 0.0)));
    }
  });
}

void FixContactStore::store_velocities(int mine)
{
  constexpr int all = 1;
  if (mine & all) return;
  with_last = true;
  last.resize(keys.size());
  Talus::in_ranges(atom->nlocal, comm->nthreads, [this, mine](int, int begin, int end) {
    for (int i = begin; i < end; i++)
      if (!(atom->mask[i] & mine)) store_velocity(i);
  });
}

void FixContactStore::store_velocity(int i)
{
  std::copy_n(atom->v[i], 3, last[i].data());
  std::copy_n(atom->omega[i], 3, last[i].data() + 3);
}

/* Key, position, changes and velocities, and what the store packs. Without a pair style a fix that migrates particles may
   stand before this one: contacts with bodies are not in the lists yet then. */

void FixContactStore::set_maxexchange(int largest_list)
{
  constexpr int of_a_body =
      Talus::LargeBodyShape::max_contacts * (ContactLists::size_name + 3 + most_history_values);
  maxexchange = 1 + 3 + size_change + size_last + HistoryStore::size_origin + largest_list;
  if (!has_pairs()) maxexchange += system->bodies().count() * of_a_body;
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
    std::copy(atom->x[i], atom->x[i] + 3, positions.begin() + 3L * i);
}

/* Undoes rounding, never an intended move. */

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
  return static_cast<double>(keys.capacity() * sizeof(std::uint64_t) +
                             positions.capacity() * sizeof(double) +
                             changes.capacity() * sizeof(Talus::ChangeRecord) +
                             last.capacity() * sizeof(Velocities)) +
         store.memory_usage();
}
