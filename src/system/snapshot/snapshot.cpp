// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/snapshot/snapshot.h"

#include "system/contacts/fix_contact_store.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "error.h"

#include <new>

using namespace LAMMPS_NS;

namespace Talus {

std::string Snapshot::reason_against(LAMMPS *lmp, GranularSystem &system)
{
  if (lmp->atom->avec->bonus_flag)
    return std::string("atom style ") + lmp->atom->atom_style +
           " keeps more of some particles than can be saved: use atom style sphere";
  return SavedFixes(lmp, system).reason_against();
}

Snapshot::Snapshot(LAMMPS *lmp, GranularSystem &of) :
    Pointers(lmp), system(of), instance(GranularSystem::of(lmp)), clock(lmp), lists(lmp, of),
    particles(lmp), fixes(lmp, of)
{
  fixes.save_globals();
  int mine = 0, any = 0;
  try {
    save();
  } catch (const std::bad_alloc &) {
    mine = 1;
  }
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  if (any) throw std::bad_alloc();
}

void Snapshot::save()
{
  StateExchange with_particles(of_store), contacts(of_contacts), all(of_system);
  lists.save();
  particles.save();
  fixes.save();
  if (FixContactStore *store = system.store()) {
    store->exchange_particles(with_particles);
    store->exchange_histories(contacts);
  }
  system.exchange_state(all);
}

std::string Snapshot::reason_against_restoring(const GranularSystem &into) const
{
  if (instance.lock().get() != &into) return "the snapshot is of another instance of LAMMPS";
  const std::string of_fixes = fixes.reason_against_restoring();
  return of_fixes.empty() ? lists.reason_against_restoring() : of_fixes;
}

void Snapshot::restore() const
{
  clock.restore_time();
  if (lists.are_present())
    particles.restore(true);
  else
    restore_lists();
  fixes.restore_particles();
  comm->forward_comm();
  if (FixContactStore *store = system.store()) {
    StateExchange with_particles(of_store), contacts(of_contacts);
    store->exchange_particles(with_particles);
    store->exchange_histories(contacts);
  }
  StateExchange all(of_system);
  system.exchange_state(all);
  fixes.restore_globals();
  clock.restore_plans();
}

/* With the particles. Pairs that are made here have no histories. */

void Snapshot::restore_lists() const
{
  lists.prepare();
  particles.restore(false);
  fixes.restore_particles();
  if (FixContactStore *store = system.store()) {
    StateExchange with_particles(of_store);
    store->exchange_particles(with_particles);
    system.memory().drop_spheres();
  }
  if (!lists.make_again())
    error->all(FLERR, "talus_restore: neighbor lists of the snapshot cannot be made again, for "
                      "sizes or types of particles "
                      "had changed between the last rebuild and the snapshot: call talus_set_up() "
                      "before talus_save()");
  particles.restore_positions();
}

double Snapshot::memory_usage() const
{
  return lists.memory_usage() + particles.memory_usage() + fixes.memory_usage() +
         of_store.memory_usage() + of_contacts.memory_usage() + of_system.memory_usage();
}

}    // namespace Talus
