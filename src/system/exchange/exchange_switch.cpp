// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/exchange/exchange_switch.h"

#include "system/host/fix_list.h"
#include "system/host/lammps_compat.h"
#include "system/host/private_members.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "comm.h"
#include "comm_brick.h"
#include "comm_tiled.h"
#include "compute.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "lammps.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <memory>

using namespace LAMMPS_NS;

namespace Talus {

namespace {

ExchangeSwitch::MakeDirect make_direct = nullptr;

/* For comm_modify mode multi, of collections or types. */

bool has_cutoffs_by_kind(const Comm &comm)
{
#if TALUS_HOST_HAS_MULTI_OLD
  if (comm.cutusermultiold) return true;
#endif
  return comm.cutusermulti != nullptr;
}

/* LAMMPS copies as many bytes as there are numbers. */

void copy_cutoffs_by_kind(const Comm &from, Comm &to, [[maybe_unused]] int types)
{
  if (from.cutusermulti) std::copy_n(from.cutusermulti, from.ncollections_cutoff, to.cutusermulti);
#if TALUS_HOST_HAS_MULTI_OLD
  if (from.cutusermultiold) std::copy_n(from.cutusermultiold, types + 1, to.cutusermultiold);
#endif
}

/* The stock object, which is watched. It holds the system, and with it what the user has chosen, until
   `clear`. */

template <class Base> class StockComm : public Base {
 public:
  StockComm(LAMMPS *lmp, Comm *old) : Base(lmp, old), system(GranularSystem::of(lmp))
  {
    system->exchange().is_made(this, nullptr);
  }
  ~StockComm() override { system->exchange().is_deleted(this); }

 private:
  std::shared_ptr<GranularSystem> system;
};

}    // namespace

void ExchangeSwitch::set_maker(MakeDirect maker)
{
  make_direct = maker;
}

void ExchangeSwitch::choose(Choice choice)
{
  if (choice == Choice::YES) {
    const std::string problem = unsupported(false);
    if (!problem.empty()) error->all(FLERR, "comm_proxy: {} or 'comm_proxy no'", problem);
  }
  chosen = choice;
  const bool is_direct = present();
  if (choice == Choice::YES && !is_direct) replace_comm(make_direct(lmp, comm));
  if (choice == Choice::NO) use_stock();
}

void ExchangeSwitch::use_stock()
{
  if (comm->style == Comm::BRICK)
    replace_comm(new StockComm<CommBrick>(lmp, comm));
  else
    replace_comm(new StockComm<CommTiled>(lmp, comm));
}

void ExchangeSwitch::start_run()
{
  settle_brick();
  const bool has_proxies =
      comm->nprocs > 1 || domain->xperiodic || domain->yperiodic || domain->zperiodic;
  if (present()) return;
  if (has_proxies && chosen != Choice::NO && unsupported(false).empty())
    replace_comm(make_direct(lmp, comm));
  else if (comm != made && !lmp->kokkos)
    use_stock();
}

void ExchangeSwitch::is_made(const Comm *one, DirectExchange *proxies)
{
  if (one) num_made++;
  made = one;
  proxies_of_made = proxies;
}

void ExchangeSwitch::is_deleted(const Comm *one)
{
  if (made == one) is_made(nullptr, nullptr);
}

int ExchangeSwitch::number_of_object() const
{
  if (comm == made) return num_made;
  return comm->style == Comm::BRICK ? -1 : -2;
}

DirectExchange *ExchangeSwitch::direct() const
{
  DirectExchange *proxies = present();
  return proxies && !proxies->falls_back() ? proxies : nullptr;
}

std::string ExchangeSwitch::reason_for_stock() const
{
  if (chosen == Choice::NO) return "'comm_proxy no' is set: remove it";
  const std::string problem = unsupported(true);
  return problem.empty() ? "the run style does not choose another: use run_style verlet" : problem;
}

std::string ExchangeSwitch::unsupported(bool in_run) const
{
  if (lmp->kokkos)
    return "the direct exchange does not run with the KOKKOS package: start LAMMPS without '-k on'";
  // each side of a contact is computed where its particle is owned: a large one needs its small partners
  if (in_run && leaves_out_small(*comm))
    if (const std::string other = needs_beyond_contacts(); !other.empty())
      return fmt::format("'comm_modify reduce/multi' is not supported with {}: remove it", other);
  // what LAMMPS adds to the velocities of ghosts depends on their order in its messages
  constexpr int all = 1;
  if (in_run && domain->deform_vremap && comm->ghost_velocity && domain->deform_groupbit != all)
    return "fix deform with 'remap v' is supported for group all only";
  return "";
}

/* Who looks at ghosts has a neighbor list of LAMMPS, asks ghosts for something, or binds particles to
   each other. */

std::string ExchangeSwitch::needs_beyond_contacts() const
{
  const auto system = GranularSystem::of(lmp);
  if (!system->pair_style().is_there()) return "pair styles of LAMMPS";
  if (!system->neighbors().reason_for_lammps_lists().empty() || neighbor->nlist > 1)
    return "neighbor lists of LAMMPS";
  if (comm->cutghostuser > 0.0 || has_cutoffs_by_kind(*comm) || sends_one_group(*comm))
    return "'comm_modify cutoff' or 'group'";
  if (domain->triclinic) return "a triclinic box";
  if (atom->molecular != Atom::ATOMIC) return "molecules";
  for (const Fix *fix : fix_list(*modify))
    if (utils::strmatch(fix->style, "^rigid")) return fmt::format("fix {}", fix->style);
  for (const Compute *compute : modify->get_compute_list())
    if (compute->comm_forward) return fmt::format("compute {}", compute->style);
  return "";
}

/* Also of objects that a script made with comm_style, which end with a crash otherwise. */

void ExchangeSwitch::settle_brick()
{
  auto *brick = dynamic_cast<CommBrick *>(comm);
  if (brick && modify->get_fix_by_style("^bond/react").empty()) forget_local_send_list(*brick);
}

void ExchangeSwitch::replace_comm(Comm *with)
{
  settle_brick();
  Comm *old = comm;
  copy_cutoffs_by_kind(*old, *with, atom->ntypes);
  comm = with;
  settle_brick();
  // where the tiles of other ranks are has to be gathered again
  if (comm->layout == Comm::LAYOUT_TILED) comm->rcbnew = 1;
  delete old;
  // The new object knows of no ghosts yet: even 'run N pre no' has to set up everything.
  update->first_update = 0;
}

}    // namespace Talus
