// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What a force computation needs to know of an exchange that may be under way: the states of
// proxies are valid only once nothing is pending. The host's communication object implements it
// when `comm_proxy yes` is in force; a pair style asks
//
//   auto *exchange = dynamic_cast<Talus::PendingExchange *>(comm);
//
// anew in every step, because scripts may replace that object at any time.

#ifndef TALUS_COMM_PENDING_EXCHANGE_H
#define TALUS_COMM_PENDING_EXCHANGE_H

namespace Talus {

class PendingExchange {
 public:
  /// In this run, exchanges will be pending when forces are computed. The same on all ranks.
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

 protected:
  ~PendingExchange() = default;    // never deleted through this interface
};

}    // namespace Talus

#endif
