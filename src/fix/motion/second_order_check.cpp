/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "fix/motion/second_order_check.h"

#include "fix/motion/start_time.h"

#include "comm.h"
#include "error.h"
#include "fix.h"
#include "modify.h"
#include "system/host/fix_list.h"
#include "system/host/system_fix.h"

#include <string>
#include <vector>

using namespace LAMMPS_NS;
using Talus::GranularSystem;
using Talus::LargeBody;

namespace {

/* "", or which contacts of the run are not of second order, and the cure, as text for messages. */

std::string reason_of_contacts(GranularSystem &system)
{
  if (!system.pair_style().is_alone())
    return "contacts of particles are not those of a pair style of Talus: use pair_style "
           "gran/penalty, or a granular style with the suffix talus, and not hybrid";
  const Talus::PairCoeffs &laws = system.laws();
  for (int i = 1; i <= laws.num_types(); i++)
    for (int j = i; j <= laws.num_types(); j++) {
      if (!laws.known(i, j)) continue;
      const std::string reason = laws.reason_against_second_order(i, j);
      if (!reason.empty()) return fmt::format("the contact of types {} and {} {}", i, j, reason);
    }
  for (LargeBody *body : system.bodies().in_order()) {
    const std::string reason = body->reason_against_second_order();
    if (!reason.empty()) return body->name() + " " + reason;
  }
  return "";
}

/* What is of first order nevertheless. */

std::vector<std::string> notes_on_bodies(GranularSystem &system)
{
  std::vector<std::string> notes;
  for (LargeBody *body : system.bodies().in_order()) {
    const std::string note = body->note_on_second_order();
    if (!note.empty()) notes.push_back(body->name() + ": " + note);
  }
  return notes;
}

}    // namespace

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
  for (const auto &other : Talus::fix_list(*modify)) {
    seen = seen || other == fix;
    if (other == fix || !other->time_integrate) continue;
    const auto *talus_fix = Talus::SystemFix::of(other);
    if (!talus_fix || talus_fix->order() != 2)
      error->all(FLERR, Error::NOLASTLINE,
                 "{} order 2: fix {} ({}) moves particles as well, with order 1: use order 1, or "
                 "only fixes nve/sphere/symplectic and rigid/small/symplectic with 'order 2'",
                 title, other->id, other->style);
    if (start.lag() == 0.0) start.set_lag(talus_fix->lag());
    if (!seen) announced = true;    // by that one
  }
  for (const auto &other : Talus::fix_list(*modify))
    if (utils::strmatch(other->style, "^wall/gran"))
      error->all(FLERR, Error::NOLASTLINE,
                 "{} order 2: contacts with fix {} ({}) are of first order: use fix large/body, or "
                 "order 1",
                 title, other->id, other->style);
  const std::string reason = reason_of_contacts(system);
  if (!reason.empty())
    error->all(FLERR, Error::NOLASTLINE, "{} order 2: {}; or use order 1", title, reason);
  if (!announced) announce(system);
  announced = true;
}

void SecondOrderCheck::announce(Talus::GranularSystem &system)
{
  const std::vector<std::string> notes = notes_on_bodies(system);
  if (comm->me) return;
  utils::logmesg(lmp,
                 "{} {}: order 2: errors of {} contacts are of second order "
                 "in the time step\n",
                 title, fix->id, notes.empty() ? "all" : "most");
  for (const std::string &note : notes) utils::logmesg(lmp, "  {}\n", note);
}
