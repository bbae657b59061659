// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which steps are made in the records: those in which only Talus looks at the particles. The arrays
// of the host are then neither read nor written. The particles come back to them for every step
// with output, a fix of the host at its end or new neighbor lists, and at the end of a run, also of
// one that ends in an error.

#include "system/granular_system.h"

#include "system/fix_contact_store.h"
#include "system/present_box.h"
#include "system/system_run_style.h"
#include "system/system_shapes.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "force.h"
#include "integrate.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace Talus {

void GranularSystem::start_run(bool pairs_computed)
{
  forget_plan();
  moved_in_records = farthest.step = -1;    // reset_timestep may bring a step back
  host_reason = find_reason_for_host(pairs_computed);
  report.print(*this, host_reason);    // what setup has found out may have changed it
  large_bodies.start_run();
}

void GranularSystem::report_styles(bool pairs_computed)
{
  // laws tell what the fixes are asked; they are known since init(), if there are particles to be
  if (accelerates_pairs()) static_cast<void>(law_table());
  report.print(*this, find_reason_for_host(pairs_computed));
}

std::string GranularSystem::find_reason_for_host(bool pairs_computed)
{
  const auto *run_style = SystemRunStyle::of(update->integrate);
  if (!accelerates_pairs()) return reason_of_pair_style();
  if (!pairs_computed) return "'pair_modify compute no' is set";
  if (!run_style) return std::string("run style ") + update->integrate_style;
  if (book.conducts_heat()) return "contacts conduct heat";
  if (effective_masses.unit() != 1.0)
    return "the unit of force is not that of mass times acceleration";
  if (atom->molecular != Atom::ATOMIC || force->kspace)
    return "there are bonds or long-range forces";
  if (atom->avec->size_forward != 3)
    return std::string("radii or more vary with atom style ") + atom->atom_style;
  if (neighbor->includegroup || atom->firstgroupname)
    return "neighbor lists or particles are restricted to a group";
  const bool periodic = domain->xperiodic || domain->yperiodic || domain->zperiodic;
  if ((comm->nprocs > 1 || periodic) && !exchange_switch.direct())
    return "the exchange is the one of LAMMPS: " + exchange_switch.reason_for_stock();

  at_end_of_step.clear();
  movers.start_run();
  for (Fix *fix : modify->get_fix_list()) {
    const int mask = modify->get_fix_mask(fix);
    const std::string its = reason_of_fix(fix, mask);
    if (!its.empty()) return std::string("fix ") + fix->id + " (" + fix->style + "): " + its;
    if ((mask & END_OF_STEP) == 0 || fix == contact_store) continue;
    if (fix->nevery <= 1)
      return std::string("fix ") + fix->id + " (" + fix->style +
             "): looks at particles at the end of every step: a larger Nevery";
    at_end_of_step.push_back(fix);
  }
  return movers.reason_against_records(shaped);
}

/* A fix of the host that is called in every step may read or change anything. Fix freeze and OMP
   change nothing that a step in the records needs. */

std::string GranularSystem::reason_of_fix(Fix *fix, int mask)
{
  if (auto *ours = SystemFix::of(fix)) return ours->needs_host_arrays();
  return acts_within_steps(fix, mask) ? "may look at particles in every step" : "";
}

bool GranularSystem::acts_within_steps(const Fix *fix, int mask) const
{
  if (fix == contact_store || std::strcmp(fix->style, "OMP") == 0 ||
      utils::strmatch(fix->style, "^freeze"))
    return false;
  constexpr int in_every_step =
      INITIAL_INTEGRATE | POST_INTEGRATE | PRE_FORCE | PRE_REVERSE | POST_FORCE | FINAL_INTEGRATE;
  return (mask & in_every_step) != 0;
}

Residence GranularSystem::choose_residence(bigint step, bool tallied)
{
  const bool stay = host_reason.empty() && !tallied && !is_looked_at(step);
  next_residence = stay ? Residence::RECORDS : Residence::HOST;
  if (stay && !sent_is_known) find_sent_particles(exchange_switch.direct());
  return next_residence;
}

bool GranularSystem::is_looked_at(bigint step) const
{
  if (step >= update->laststep || step >= output->next) return true;
  return std::any_of(at_end_of_step.begin(), at_end_of_step.end(),
                     [step](const Fix *fix) { return step % fix->nevery == 0; });
}

void GranularSystem::find_sent_particles(const ProxyUpdates *proxies)
{
  sent.clear();
  if (proxies) {
    sent = proxies->plan().self().send_index;
    for (const ExchangeNeighbor &n : proxies->plan().neighbors())
      sent.insert(sent.end(), n.send_index.begin(), n.send_index.end());
  }
  std::sort(sent.begin(), sent.end());
  sent.erase(std::unique(sent.begin(), sent.end()), sent.end());
  sent_is_known = true;
}

/* ---------------------------------------------------------------------- */

void GranularSystem::update_proxies(bool overlap)
{
  ProxyUpdates *proxies = exchange_switch.direct();
  ProxyPacker *from_records = packer_of_records(proxies);
  if (!proxies || !proxies->has_plan() || !(overlap || from_records)) {
    comm->forward_comm();    // complete at its end
    return;
  }
  proxies->begin(from_records);
  if (overlap)
    proxies->counters().overlapped++;
  else
    proxies->finish();
}

/* From records to records, or nullptr if the states go through the arrays of the host, which then
   have to show the particles that are sent: a step that is looked at may show its ghosts. */

ProxyPacker *GranularSystem::packer_of_records(const ProxyUpdates *proxies)
{
  if (residence() == Residence::HOST) return nullptr;
  if (next_residence == Residence::HOST || !proxies || proxies->is_checking()) {
    if (!sent.empty()) contact_pipeline->show_state(sent, atom->x[0], atom->v[0], atom->omega[0]);
    if (contact_pipeline->keeps_changes())
      contact_pipeline->show_changes(sent, contact_store->all_changes());
    return nullptr;
  }
  if (!packer_knows_plan)
    packer.set_plan(proxies->plan(), contact_pipeline->particle_order().slot_of_atom.data());
  packer_knows_plan = true;
  packer.set_state(contact_pipeline->records(), present_box(*domain));
  proxies_are_in_records = true;
  return &packer;
}

void GranularSystem::return_to_host(bool with_forces)
{
  if (residence() == Residence::HOST) return;
  const bool between_steps = with_forces && !contact_pipeline->is_moving();
  const bool any = atom->nlocal > 0;
  contact_pipeline->complete_move();
  movers.leave_records();
  if (contact_pipeline->keeps_changes())
    contact_pipeline->write_changes(contact_store->all_changes());
  contact_pipeline->return_state(
      any ? atom->x[0] : nullptr, any ? atom->v[0] : nullptr, any ? atom->omega[0] : nullptr,
      any && with_forces ? atom->f[0] : nullptr, any && with_forces ? atom->torque[0] : nullptr);
  if (between_steps) complete_step();
}

/* Fix freeze of LAMMPS does not know of the records. */

void GranularSystem::complete_step()
{
  for (const bool integrating : {false, true})
    for (Fix *fix : modify->get_fix_list()) {
      auto *ours = SystemFix::of(fix);
      if (ours && ours->integrates() == integrating) ours->complete_step();
      if (!ours && !integrating && utils::strmatch(fix->style, "^freeze")) fix->post_force(0);
    }
}

void GranularSystem::end_run()
{
  next_residence = Residence::HOST;
  return_to_host(true);
}

}    // namespace Talus
