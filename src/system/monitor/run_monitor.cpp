// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/monitor/run_monitor.h"

#include "comm.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;

void RunMonitor::add(const void *owner, std::vector<Check> checks)
{
  for (Check &check : checks) entries.push_back({owner, std::move(check), false});
}

void RunMonitor::remove(const void *owner)
{
  entries.erase(std::remove_if(entries.begin(), entries.end(),
                               [owner](const Entry &entry) { return entry.owner == owner; }),
                entries.end());
}

void RunMonitor::start()
{
  for (Entry &entry : entries) entry.said = false;
  last_step = -1;
}

/* What has been said is the same on all ranks, and so is the number of values. Of equal values
   that of the lowest rank is taken. */

void RunMonitor::look(Moment moment)
{
  if (last_step == update->ntimestep && last_moment == moment) return;
  last_step = update->ntimestep;
  last_moment = moment;

  struct Value {
    double value;
    int rank;
  };
  std::vector<Entry *> asked;
  std::vector<Finding> mine;
  std::vector<Value> here;
  for (Entry &entry : entries) {
    if (entry.said) continue;
    asked.push_back(&entry);
    mine.push_back(entry.check.evaluate());
    if (!std::isfinite(mine.back().value)) mine.back() = {};
    here.push_back({mine.back().value, comm->me});
  }
  if (asked.empty()) return;
  std::vector<Value> all(here.size());
  MPI_Allreduce(here.data(), all.data(), static_cast<int>(here.size()), MPI_DOUBLE_INT, MPI_MAXLOC,
                world);
  for (std::size_t n = 0; n < asked.size(); n++) {
    Entry &entry = *asked[n];
    const double value = all[n].value;
    if (!(value > entry.check.limit) || value <= entry.check.worse * entry.told) continue;
    entry.said = entry.check.warn(from_worst(mine[n], value, all[n].rank));
    entry.told = value;
  }
}

/* What the rank with the largest value has found. */

RunMonitor::Finding RunMonitor::from_worst(const Finding &mine, double value, int rank) const
{
  Finding worst{value, mine.details};
  MPI_Bcast(worst.details.data(), static_cast<int>(worst.details.size()), MPI_DOUBLE, rank, world);
  return worst;
}
