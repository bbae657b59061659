// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the exchange of one rank has cost, for comm_proxy info, compute penalty/stats and the
// summary of a run.

#ifndef TALUS_EXCHANGE_EXCHANGE_COUNTERS_H
#define TALUS_EXCHANGE_EXCHANGE_COUNTERS_H

namespace Talus {

/// Sums since the exchange exists. Only messages to other ranks count: images of a rank's own
/// particles are copied.
struct ExchangeCounters {
  double exchanges = 0.0;     ///< updates of all proxies
  double overlapped = 0.0;    ///< of them begun without being finished at once
  double messages = 0.0;      ///< sent
  double bytes = 0.0;         ///< sent
  double particles = 0.0;     ///< whose states have been sent
  double pack_seconds = 0.0, wait_seconds = 0.0, unpack_seconds = 0.0;

  /// What has been added since `then`.
  ExchangeCounters since(const ExchangeCounters &then) const
  {
    return {exchanges - then.exchanges,       overlapped - then.overlapped,
            messages - then.messages,         bytes - then.bytes,
            particles - then.particles,       pack_seconds - then.pack_seconds,
            wait_seconds - then.wait_seconds, unpack_seconds - then.unpack_seconds};
  }
};

}    // namespace Talus

#endif
