// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/bodies/large_bodies.h"

#include "system/host/fix_list.h"
#include "system/host/system_fix.h"
#include "system/step/granular_system.h"

#include "fix.h"
#include "modify.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

/* A command that ended in an error has left a body behind, and another one may have its address. */

LargeBody &LargeBodies::add(const Fix *command, LargeBodySpec spec)
{
  const auto left = std::find_if(all.begin(), all.end(),
                                 [command](const auto &one) { return one->command() == command; });
  if (left != all.end()) remove(**left);
  all.push_back(std::make_unique<LargeBody>(command, system, std::move(spec), lmp));
  return *all.back();
}

void LargeBodies::remove(const LargeBody &body)
{
  if (ShapedParticles *shapes = system.shapes()) shapes->forget(body);
  const auto is_it = [&body](const auto &one) { return one.get() == &body; };
  all.erase(std::remove_if(all.begin(), all.end(), is_it), all.end());
}

std::vector<LargeBody *> LargeBodies::in_order() const
{
  std::vector<LargeBody *> found;
  for (const auto &fix : fix_list(*modify))
    for (const auto &body : all)
      if (body->command() == fix) found.push_back(body.get());
  return found;
}

LargeBody *LargeBodies::find(const std::string &id) const
{
  for (const auto &body : all)
    if (body->command()->id && id == body->command()->id) return body.get();
  return nullptr;
}

bool LargeBodies::account() const
{
  return std::any_of(all.begin(), all.end(), [](const auto &body) { return body->accounts(); });
}

void LargeBodies::start_run()
{
  may_join.clear();
  // what updates dynamic groups may read forces, and comes first
  if (!modify->get_fix_by_style("^GROUP$").empty()) return;
  for (const auto &fix : fix_list(*modify)) {
    const auto *talus_fix = SystemFix::of(fix);
    const int mask = modify->get_fix_mask(fix);
    const bool adds = talus_fix ? talus_fix->adds_forces()
                                : acts_within_steps(fix, mask) && (mask & FixConst::POST_FORCE);
    if (adds) break;
    for (const auto &body : all)
      if (body->command() == fix) may_join.push_back(body.get());
  }
}

/* Those behind one that does not join act on their own, so that the order of sums stays that of the
   fixes. */

bool LargeBodies::join_step()
{
  joined = 0;
  while (joined < may_join.size() && may_join[joined]->join_step()) joined++;
  return joined > 0;
}

void LargeBodies::add_to_slots(int thread, int begin, int end)
{
  for (std::size_t n = 0; n < joined; n++) may_join[n]->add_to_slots(thread, begin, end);
}

}    // namespace Talus
