/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "second_order_check.h"

#include "start_time.h"

#include "comm.h"
#include "error.h"
#include "fix.h"
#include "modify.h"
#include "system/system_fix.h"

#include <string>
#include <vector>

using namespace LAMMPS_NS;

void SecondOrderCheck::set_half(LAMMPS *lmp, const char *title, StartTime &start, bool says_start)
{
  if (says_start && !start.is_half())
    lmp->error->all(FLERR,
                    "{} order 2: velocities of 'start plain' have an error "
                    "of first order: use 'start half', or leave 'start' out",
                    title);
  start.set_half(true);
}

void SecondOrderCheck::check(Talus::GranularSystem &system, StartTime &start)
{
  bool seen = false;    // this fix
  for (const auto &other : modify->get_fix_list()) {
    seen = seen || other == fix;
    if (other == fix || !other->time_integrate) continue;
    const auto *ours = Talus::SystemFix::of(other);
    if (!ours || ours->order() != 2)
      error->all(FLERR, Error::NOLASTLINE,
                 "{} order 2: fix {} ({}) moves particles as well, with order 1: use order 1, or "
                 "only fixes nve/sphere/symplectic and rigid/small/symplectic with 'order 2'",
                 title, other->id, other->style);
    if (start.lag() == 0.0) start.set_lag(ours->lag());
    if (!seen) announced = true;    // by that one
  }
  for (const auto &other : modify->get_fix_list())
    if (utils::strmatch(other->style, "^wall/gran"))
      error->all(FLERR, Error::NOLASTLINE,
                 "{} order 2: contacts with fix {} ({}) are of first order: use fix large/body, or "
                 "order 1",
                 title, other->id, other->style);
  const std::string reason = system.reason_against_second_order();
  if (!reason.empty())
    error->all(FLERR, Error::NOLASTLINE, "{} order 2: {}; or use order 1", title, reason);
  if (!announced) announce(system);
  announced = true;
}

void SecondOrderCheck::announce(Talus::GranularSystem &system)
{
  const std::vector<std::string> notes = system.notes_on_second_order();
  if (comm->me) return;
  utils::logmesg(lmp,
                 "{} {}: order 2: errors of {} contacts are of second order "
                 "in the time step\n",
                 title, fix->id, notes.empty() ? "all" : "most");
  for (const std::string &note : notes) utils::logmesg(lmp, "  {}\n", note);
}
