// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "run/record_steps.h"

#include "comm/comm_proxy.h"
#include "fix/fix_large_body.h"
#include "fix/fix_nve_sphere_symplectic.h"
#include "pair/pair_gran_penalty.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace Talus;

void RecordSteps::start(bool pairs_computed)
{
  style = dynamic_cast<PairGranPenalty *>(force->pair);
  at_end_of_step.clear();
  forget_plan();
  reason = find_hazard(pairs_computed);
  if (!reason.empty()) return;
  std::vector<RecordForces *> bodies;
  for (auto &fix : modify->get_fix_list())
    if (auto *body = dynamic_cast<FixLargeBody *>(fix)) bodies.push_back(body);
  style->add_in_records(bodies);
}

std::string RecordSteps::find_hazard(bool pairs_computed)
{
  if (!style || !pairs_computed) return "the pair style is not gran/penalty on its own";
  if (const std::string its = style->hazard_of_records(); !its.empty()) return its;
  if (atom->molecular != Atom::ATOMIC || force->kspace)
    return "there are bonds or long-range forces";
  if (atom->avec->size_forward != 3)
    return std::string("radii or more vary with atom style ") + atom->atom_style;
  if (neighbor->includegroup || atom->firstgroupname)
    return "neighbor lists or particles are restricted to a group";
  const bool periodic = domain->xperiodic || domain->yperiodic || domain->zperiodic;
  if ((comm->nprocs > 1 || periodic) && !dynamic_cast<CommProxy *>(comm))
    return "the exchange is the one of LAMMPS: add 'comm_proxy yes'";

  int integrators = 0;
  for (int n = 0; n < modify->nfix; n++) {
    Fix *fix = modify->fix[n];
    if (dynamic_cast<FixNVESphereSymplectic *>(fix)) integrators++;
    const std::string its = hazard_of_fix(fix, modify->fmask[n]);
    if (!its.empty()) return std::string("fix ") + fix->id + " (" + fix->style + "): " + its;
    if (modify->fmask[n] & END_OF_STEP) at_end_of_step.push_back(fix);
  }
  if (integrators != 1) return "it takes one fix nve/sphere/symplectic";
  return "";
}

/* A fix of the host that is called in every step may read or change anything. Fix freeze and OMP
   change nothing that a step in the records needs. */

std::string RecordSteps::hazard_of_fix(Fix *fix, int mask) const
{
  if (auto *integrator = dynamic_cast<FixNVESphereSymplectic *>(fix))
    return integrator->hazard_of_records();
  if (const auto *body = dynamic_cast<FixLargeBody *>(fix)) return body->hazard_of_records();
  if (dynamic_cast<FixContactStore *>(fix) || std::strcmp(fix->style, "OMP") == 0 ||
      utils::strmatch(fix->style, "^freeze"))
    return "";
  constexpr int in_every_step =
      INITIAL_INTEGRATE | POST_INTEGRATE | PRE_FORCE | PRE_REVERSE | POST_FORCE | FINAL_INTEGRATE;
  return mask & in_every_step ? "may look at particles in every step" : "";
}

bool RecordSteps::may_stay(bigint now, bool tallied)
{
  stays = reason.empty() && !tallied && !is_looked_at(now);
  if (!reason.empty()) return false;
  if (stays && !sent_is_known) find_sent_particles();
  style->keep_state(stays);
  return stays;
}

bool RecordSteps::is_looked_at(bigint now) const
{
  if (now >= update->laststep || now >= output->next) return true;
  return std::any_of(at_end_of_step.begin(), at_end_of_step.end(),
                     [now](const Fix *fix) { return fix->nevery <= 0 || now % fix->nevery == 0; });
}

PairGranPenalty *RecordSteps::keeper() const
{
  return reason.empty() && style->holds_state() ? style : nullptr;
}

/* Who looks at a step may look at the host's ghosts; and so do the checks of the exchange. */

ProxyPacker *RecordSteps::prepare_exchange()
{
  PairGranPenalty *its = keeper();
  if (!its) return nullptr;
  const auto *proxy = dynamic_cast<CommProxy *>(comm);
  if (!stays || !proxy || proxy->is_checking()) {
    its->show_state(sent);
    return nullptr;
  }
  if (!packer_knows_plan) packer.set_plan(proxy->plan(), its->slot_of_atom());
  packer_knows_plan = true;
  packer.set_state(its->records(), present_box(*domain));
  its->take_proxies_as_they_are();
  return &packer;
}

void RecordSteps::find_sent_particles()
{
  sent.clear();
  if (const auto *proxy = dynamic_cast<CommProxy *>(comm)) {
    sent = proxy->plan().self().send_index;
    for (const ExchangeNeighbor &n : proxy->plan().neighbors())
      sent.insert(sent.end(), n.send_index.begin(), n.send_index.end());
  }
  std::sort(sent.begin(), sent.end());
  sent.erase(std::unique(sent.begin(), sent.end()), sent.end());
  style->set_sent_particles(sent);
  sent_is_known = true;
}
