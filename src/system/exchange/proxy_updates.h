// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The direct exchange as the system and the run style see it: states of proxies are valid only once
// nothing is pending. The communication object of LAMMPS implements it while it is
// in force (see exchange_switch.h); scripts may replace that object at any time, so
// ExchangeSwitch::direct() looks for it again in every step.

#ifndef TALUS_SYSTEM_EXCHANGE_PROXY_UPDATES_H
#define TALUS_SYSTEM_EXCHANGE_PROXY_UPDATES_H

#include "exchange/exchange_counters.h"
#include "exchange/exchange_plan.h"
#include "exchange/proxy_packer.h"

#include <string>

namespace Talus {

class ProxyUpdates {
 public:
  /// In this run the present settings are not supported, and the user has not insisted: all is left
  /// to the exchange of LAMMPS. The same on all ranks; valid after init() of LAMMPS.
  virtual bool falls_back() const = 0;

  /// Whether begin() can be called: after borders() until the next exchange(). The same on all
  /// ranks.
  virtual bool has_plan() const = 0;
  virtual const ExchangePlan &plan() const = 0;

  /// Starts the update of all proxies; the caller sees to it that they are not read before
  /// finish(). Collective among neighbors. `packer`: if states are not in the arrays of LAMMPS,
  /// on all ranks; else nullptr.
  virtual void begin(ProxyPacker *packer) = 0;

  /// At the start of a run: whether begin() will be called without finish() in each step.
  virtual void set_overlap(bool yes) = 0;
  /// In this run, updates are pending when forces are computed. The same on all ranks.
  virtual bool overlaps() const = 0;

  /// Proxies must not be read now. The same on all ranks.
  virtual bool pending() const = 0;

  /// To be called now and then while computing without proxies: MPI moves data only inside its
  /// calls. Cheap, never waits; does nothing if nothing is pending.
  virtual void progress() = 0;

  /// Whether progress() may be called by the first of so many threads while all of them compute. If
  /// not, only between parallel regions. The same in every step.
  virtual bool may_progress_beside(int threads) const = 0;

  /// Waits for all messages and stores them; afterwards proxies are valid. Does nothing if nothing
  /// is pending.
  virtual void finish() = 0;

  /// Every state is compared with the one that the exchange of LAMMPS brings: all updates go
  /// through the arrays of LAMMPS.
  virtual bool is_checking() const = 0;
  virtual void check(bool yes) = 0;

  // for reports

  virtual ExchangeCounters &counters() = 0;
  /// Of this rank, for one update with the present plan.
  virtual double messages_per_exchange() const = 0;
  virtual double bytes_per_exchange() const = 0;
  /// What the message of a proxy holds, as text for messages.
  virtual std::string describe_message() const = 0;

 protected:
  ~ProxyUpdates() = default;    // never deleted through this interface
};

}    // namespace Talus

#endif
