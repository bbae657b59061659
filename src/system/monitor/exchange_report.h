// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The plan and the counters of all ranks as text: comm_proxy info, and the summary of a run.

#ifndef TALUS_SYSTEM_MONITOR_EXCHANGE_REPORT_H
#define TALUS_SYSTEM_MONITOR_EXCHANGE_REPORT_H

#include "system/exchange/direct_exchange.h"

#include <mpi.h>

#include <string>

namespace Talus {

/// Least, mean and largest value over the ranks.
struct Spread {
  double least, mean, largest;
};
/// Collective.
Spread spread_over_ranks(double value, MPI_Comm world);

/// Several lines: plan, message, counters. Collective; the text is complete on all ranks.
std::string describe_exchange(DirectExchange &proxies, double share_without_proxies,
                              MPI_Comm world);

/// One line for the end of a run of verlet/proxy, which has added `c`. Collective.
std::string summarize_exchange(const ExchangeCounters &c, MPI_Comm world);

}    // namespace Talus

#endif
