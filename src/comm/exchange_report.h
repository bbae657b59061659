// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The plan and the counters of all ranks as text: comm_proxy info, and the summary of a run.

#ifndef TALUS_COMM_EXCHANGE_REPORT_H
#define TALUS_COMM_EXCHANGE_REPORT_H

#include "exchange/exchange_counters.h"

#include <mpi.h>

#include <string>

namespace LAMMPS_NS {
class CommProxy;
}

namespace Talus {

/// Least, mean and largest value over the ranks.
struct Spread {
  double least, mean, largest;
};
/// Collective.
Spread spread_over_ranks(double value, MPI_Comm world);

/// Several lines: plan, message, counters. Collective; the text is complete on all ranks.
std::string describe_exchange(LAMMPS_NS::CommProxy &comm, MPI_Comm world);

/// One line for the end of a run of verlet/proxy, which has added `c`. Collective.
std::string summarize_exchange(const ExchangeCounters &c, MPI_Comm world);

}    // namespace Talus

#endif
