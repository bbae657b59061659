// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The state of the body in snapshots and restart files.

#include "fix/body/fix_large_body.h"

#include "base/state_exchange.h"
#include "system/host/restart_data.h"

#include "comm.h"
#include "error.h"

using namespace LAMMPS_NS;
using namespace Talus;

static constexpr int restart_format = 10;

void FixLargeBody::exchange_state(StateExchange &x)
{
  body->exchange_state(x);
}

void FixLargeBody::write_restart(FILE *fp)
{
  const std::vector<double> values = body->state_of_all_ranks();
  if (comm->me) return;
  write_restart_data_of_fix(fp, restart_format, values.data(), values.size() * sizeof(double));
}

void FixLargeBody::restart(char *buf)
{
  const std::vector<double> values =
      restart_data_of_fix(lmp, std::string("Fix large/body ") + id, restart_format, buf);
  const LargeBody::RestartProblem problem =
      body->restart_from(values.data(), values.data() + values.size());
  if (!problem.error.empty()) error->all(FLERR, "Fix large/body {}: {}", id, problem.error);
  if (!problem.warning.empty() && comm->me == 0)
    error->warning(FLERR, "Fix large/body {}: {}", id, problem.warning);
}
