// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/step/setup_state.h"

#include "base/state_digest.h"
#include "system/host/fix_list.h"
#include "system/host/private_members.h"
#include "system/host/system_style.h"
#include "system/host/time_formula.h"
#include "system/regions/region_digest.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "compute.h"
#include "domain.h"
#include "fix.h"
#include "force.h"
#include "modify.h"
#include "output.h"
#include "pair.h"
#include "region.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace Talus {

/* ---- what there is --------------------------------------------------------------------------- */

SetupState::List SetupState::present_fixes() const
{
  List all;
  for (const Fix *fix : fix_list(*modify))
    all.push_back({std::string("fix ") + fix->id + " (" + fix->style + ")",
                   static_cast<std::uint64_t>(number_of_instance(*fix))});
  return all;
}

SetupState::List SetupState::present_computes() const
{
  List all;
  for (const Compute *compute : modify->get_compute_list())
    all.push_back({std::string("compute ") + compute->id + " (" + compute->style + ")",
                   static_cast<std::uint64_t>(number_of_instance(*compute))});
  return all;
}

SetupState::List SetupState::present_regions() const
{
  List all;
  for (const Region *region : domain->get_region_list())
    all.push_back({std::string("region ") + region->id, digest_of(*region)});
  return all;
}

SetupState::List SetupState::present_variables() const
{
  List all;
  for (const auto &[name, index] : equal_style_variables(lmp))
    all.push_back({"variable " + name, static_cast<std::uint64_t>(index)});
  return all;
}

int SetupState::present_pair() const
{
  return force->pair ? number_of_instance(*force->pair) : -1;
}

std::uint64_t SetupState::digest_of_particles(int begin, int end) const
{
  StateDigest digest;
  digest.add(static_cast<std::uint64_t>(end - begin));
  for (int i = begin; i < end; i++) digest.add(static_cast<std::uint64_t>(atom->tag[i]));
  return digest.value();
}

void SetupState::expect_new_laws()
{
  laws_are_known = then.laws == system.laws().revision();
}

void SetupState::list_fixes()
{
  listed = present_fixes();
  if (laws_are_known) then.laws = system.laws().revision();
}

void SetupState::record_setup()
{
  record();
  listed = then.fixes;
  run_style_is_new = false;
}

void SetupState::record()
{
  is_set_up = true;
  then.fixes = present_fixes();
  then.computes = present_computes();
  then.regions = present_regions();
  const auto regions = domain->get_region_list();
  then.addresses.assign(regions.begin(), regions.end());
  then.variables = present_variables();
  then.run_style = update->integrate_style;
  then.pair = present_pair();
  then.laws = system.laws().revision();
  then.communication = system.exchange().number_of_object();
  then.particles = atom->natoms;
  then.owned = digest_of_particles(0, atom->nlocal);
  then.ghosts = digest_of_particles(atom->nlocal, atom->nlocal + atom->nghost);
}

/* ---- what has changed ------------------------------------------------------------------------ */

namespace {

/// The first of these that is not one of those; nullptr: there is none.
template <class List>
const typename List::value_type *first_beyond(const List &these, const List &those)
{
  const auto found = std::find_if(these.begin(), these.end(), [&those](const auto &one) {
    return std::none_of(those.begin(), those.end(), [&one](const auto &other) {
      return one.number == other.number && one.name == other.name;
    });
  });
  return found == these.end() ? nullptr : &*found;
}

template <class List> std::string difference(const List &before, const List &now)
{
  if (const auto *gone = first_beyond(before, now)) {
    const bool again = std::any_of(now.begin(), now.end(),
                                   [gone](const auto &one) { return one.name == gone->name; });
    return gone->name + (again ? " has been defined anew" : " has been deleted");
  }
  const auto *added = first_beyond(now, before);
  return added ? added->name + " has been defined" : "";
}

}    // namespace

/* But for what is not the same on all ranks. What is defined and deleted again between two init() of LAMMPS is
   not there in between. Nothing points to regions and variables that are new. */

std::string SetupState::lost_here() const
{
  if (!is_set_up) return "no run has been set up";
  if (then.run_style != update->integrate_style) return "the run style is another one";
  if (run_style_is_new && SystemStyle::of(update->integrate))
    return "the run style has been defined anew";
  if (then.pair != present_pair()) return "the pair style has been defined anew";
  if (then.communication != system.exchange().number_of_object())
    return "comm_style or comm_proxy has been changed";
  const List fixes = present_fixes(), regions = present_regions(), variables = present_variables();
  if (first_beyond(then.regions, regions)) return difference(then.regions, regions);
  if (const auto *moved = first_beyond(then.variables, variables))
    return moved->name + ", or one that was defined before it, has been deleted";
  const std::string of_fixes = difference(then.fixes, fixes);
  return of_fixes.empty() ? difference(listed, fixes) : of_fixes;
}

bool SetupState::has_moved_region() const
{
  const auto now = domain->get_region_list();
  return std::any_of(then.addresses.begin(), then.addresses.end(), [&now](const Region *one) {
    return std::find(now.begin(), now.end(), one) == now.end();
  });
}

std::string SetupState::lost() const
{
  const bool moved = on_any_rank(has_moved_region());
  const std::string here = lost_here();
  return here.empty() && moved ? "a region has been defined anew" : here;
}

std::string SetupState::change() const
{
  std::string found = lost();
  if (found.empty()) found = difference(then.computes, present_computes());
  if (found.empty() && then.laws != system.laws().revision())
    found = "coefficients of pairs have been changed";
  if (found.empty() && then.particles != atom->natoms)
    found = "particles have been added or deleted";
  return found;
}

std::string SetupState::change_with_particles() const
{
  const bool others = on_any_rank(then.owned != digest_of_particles(0, atom->nlocal));
  const std::string found = change();
  return found.empty() && others
             ? "particles have been added, deleted, sorted or moved to other ranks"
             : found;
}

/* LAMMPS tells dumps when to write next as it sets up a run; that of a new one is step 0. */

bool SetupState::has_new_dump() const
{
  const bigint *const next = output->next_dump;
  return std::any_of(next, next + output->ndump, [](bigint step) { return step == 0; });
}

bool SetupState::has_other_ghosts() const
{
  return on_any_rank(then.ghosts != digest_of_particles(atom->nlocal, atom->nlocal + atom->nghost));
}

bool SetupState::on_any_rank(bool here) const
{
  int mine = here, any = 0;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  return any != 0;
}

}    // namespace Talus
