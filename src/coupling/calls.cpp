// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The table of calls, and those of life and time; doc/coupling.md.

#include "coupling/calls.h"
#include "coupling/partner.h"
#include "system/host/fix_list.h"

#include "fix.h"
#include "fmt/format.h"
#include "lammps.h"
#include "lmptype.h"
#include "update.h"
#include "utils.h"

#include <cmath>
#include <memory>
#include <string>

using namespace LAMMPS_NS;

namespace Talus {

const CallTable &call_table()
{
#define TALUS_ENTRY(name, parameters, arguments) &call_##name,
  static const CallTable table{TALUS_INTERFACE, TALUS_CALLS(TALUS_ENTRY) & call_error,
                               &call_snapshot_size};
#undef TALUS_ENTRY
  return table;
}

namespace {

std::string error_without_partner;

}    // namespace

const char *call_error(const talus_partner *partner)
{
  return (partner ? partner->error_text() : error_without_partner).c_str();
}

/* ---- life ----------------------------------------------------------------------------------- */

int call_open(void *lmp, int root, talus_partner **partner)
{
  error_without_partner.clear();
  try {
    if (partner) *partner = nullptr;
    auto opened = std::make_unique<talus_partner>(static_cast<LAMMPS *>(lmp), root);
    opened->refuse_if(partner ? "" : "talus_open: where the partner goes is NULL");
    GranularSystem::of(&opened->instance())->external_loads().make_fix();
    *partner = opened.release();
    return TALUS_OK;
  } catch (const std::exception &problem) {
    error_without_partner = problem.what();
    return TALUS_REFUSED;
  }
}

int call_close(talus_partner *partner)
{
  const std::unique_ptr<talus_partner> owner(partner);
  const int code = owner->close();
  error_without_partner = owner->error_text();
  return code;
}

int call_fail(talus_partner *partner, const char *why)
{
  return partner->fail(why);
}

/* ---- time ----------------------------------------------------------------------------------- */

int call_get_time(const talus_partner *partner, double *time, double *dt, int64_t *step)
{
  Update &update = *partner->instance().update;
  if (time)
    *time = update.atime + static_cast<double>(update.ntimestep - update.atimestep) * update.dt;
  if (dt) *dt = update.dt;
  if (step) *step = update.ntimestep;
  return TALUS_OK;
}

namespace {

/// fix deform finds where the box ends, for the length of the run, when a run is set up.
bool is_set_up_for_a_length(LAMMPS &lmp)
{
  for (const Fix *fix : fix_list(*lmp.modify))
    if (utils::strmatch(fix->style, "^deform")) return true;
  return false;
}

void advance(talus_partner &partner, std::int64_t steps)
{
  if (steps < 0) throw Refusal("steps is " + std::to_string(steps) + ", expected 0 or more");
  if (steps > MAXSMALLINT)
    throw Refusal("steps is " + std::to_string(steps) + ", expected at most " +
                  std::to_string(MAXSMALLINT));
  partner.set_up_if_needed();
  const char *const go_on = is_set_up_for_a_length(partner.instance()) ? "" : " pre no";
  if (steps) partner.command("run " + std::to_string(steps) + go_on + " post no");
  partner.system().setup_state().record();
}

}    // namespace

int call_advance(talus_partner *partner, int64_t steps)
{
  return partner->collective("talus_advance",
                             [&] { advance(*partner, partner->integer_of("steps", steps)); });
}

int call_advance_by(talus_partner *partner, double duration)
{
  return partner->collective("talus_advance_by", [&] {
    const double asked = partner->number_of("duration", duration),
                 dt = partner->instance().update->dt, steps = asked / dt, whole = std::round(steps);
    if (asked < 0.0) throw Refusal(fmt::format("duration is {:.8g}, expected 0 or more", asked));
    if (std::fabs(steps - whole) > 1e-6)
      throw Refusal(fmt::format(
          "duration is {:.8g}, which is {:.8g} time steps of {:.8g}: give a whole number of them",
          asked, steps, dt));
    advance(*partner, static_cast<std::int64_t>(whole));
  });
}

int call_set_up(talus_partner *partner)
{
  return partner->collective("talus_set_up", [&] { partner->needs_set_up = true; });
}

}    // namespace Talus
