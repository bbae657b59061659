// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The update of proxies without stages: at the end of borders() a plan is derived from the swaps of
// LAMMPS that goes from owner to proxy, and every update follows it.
//
// States of proxies are valid only once nothing is pending: an update is blocking for every caller of forward_comm(), and
// only the run style of Talus calls begin(). The communication object of LAMMPS owns it; scripts may replace that at any
// time, so ExchangeSwitch::direct() looks for it again in every step.

#ifndef TALUS_SYSTEM_EXCHANGE_DIRECT_EXCHANGE_H
#define TALUS_SYSTEM_EXCHANGE_DIRECT_EXCHANGE_H

#include "exchange/packer_with_rows.h"
#include "exchange/proxy_exchange.h"
#include "system/exchange/atom_packers.h"

#include "pointers.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Comm;
}

namespace Talus {

class GranularSystem;

/// The staged exchange of LAMMPS, after its borders().
struct StagedExchange {
  /// Runs once through its swaps, with the identity of particles instead of their state: what a rank
  /// passes on is known to belong to someone else. Of ghosts, in their order. Collective; messages of
  /// this communicator have TAG_ORIGIN.
  std::function<std::vector<ProxyOrigin>(MPI_Comm communicator)> trace_origins;
  /// All ranks that may share a proxy with this one, without it. If a rank is one of another's, then
  /// this is one of its. Collective.
  std::function<std::vector<int>()> possible_neighbors;
  /// Its update of all ghosts.
  std::function<void()> forward;
};

class DirectExchange : protected LAMMPS_NS::Pointers {
 public:
  /// Of the communication object `owner`. Collective.
  DirectExchange(LAMMPS_NS::LAMMPS *lmp, const LAMMPS_NS::Comm *owner, StagedExchange staged);
  ~DirectExchange() override;

  // ---- for the communication object

  /// At the end of its init().
  void init(int size_forward);
  /// Particles may have changed: what is under way is dropped.
  void abandon() { transfer.abandon(); }
  /// The same, and the plan is gone: particles are about to be renumbered.
  void forget_plan();
  /// At the end of its borders(), unless the present settings are not supported.
  void derive_plan();

  // ---- for the system and the run style

  /// In this run the present settings are not supported, and the user has not insisted: all is left
  /// to the exchange of LAMMPS. The same on all ranks; valid after init() of LAMMPS.
  bool falls_back() const { return fell_back; }

  /// Whether begin() can be called: after borders() until the next exchange(). The same on all
  /// ranks.
  bool has_plan() const { return have_plan; }
  const ExchangePlan &plan() const { return transfer.plan(); }

  /// Starts the update of all proxies; the caller sees to it that they are not read before
  /// finish(). Collective among neighbors. `packer`: if states are not in the arrays of LAMMPS,
  /// on all ranks; else nullptr.
  void begin(ProxyPacker *packer);

  /// At the start of a run: whether begin() will be called without finish() in each step.
  void set_overlap(bool yes) { overlapped_run = yes; }
  /// In this run, updates are pending when forces are computed. The same on all ranks.
  bool overlaps() const { return overlapped_run; }

  /// Proxies must not be read now. The same on all ranks.
  bool pending() const { return transfer.pending(); }

  /// To be called now and then while computing without proxies: MPI moves data only inside its
  /// calls. Cheap, never waits; does nothing if nothing is pending.
  void progress() { transfer.progress(); }

  /// Whether progress() may be called by the first of so many threads while all of them compute. If
  /// not, only between parallel regions. The same in every step.
  bool may_progress_beside(int threads) const
  {
    return ProxyExchange::may_progress_beside(threads);
  }

  /// Waits for all messages and stores them; afterwards proxies are valid. Does nothing if nothing
  /// is pending.
  void finish();

  /// Every state is compared with the one that the exchange of LAMMPS brings: all updates go
  /// through the arrays of LAMMPS.
  bool is_checking() const { return checks; }
  void check(bool yes) { checks = yes; }

  // ---- for reports

  ExchangeCounters &counters() { return transfer.counters; }
  /// Of this rank, for one update with the present plan.
  double messages_per_exchange() const;
  double bytes_per_exchange() const;
  /// What the message of a proxy holds, as text for messages.
  std::string describe_message() const;

 private:
  ProxyPacker &choose_packer(ProxyPacker *given);
  double *const *orientations(bool in_records) const;
  int stride() const;
  void look_for_unsupported();
  int largest_stride() const;
  void poison_proxies();
  void check_owners();
  void check_states();

  std::shared_ptr<GranularSystem> system;
  StagedExchange staged;
  const LAMMPS_NS::Comm *owner;
  ProxyExchange transfer;
  AtomVecPacker atom_vec_packer;
  SpherePacker sphere_packer;
  PackerWithRows with_orientations;
  bool have_plan = false;                ///< the same on all ranks
  bool plan_has_orientations = false;    ///< room for them in its messages
  bool fell_back = false;                ///< in this run, see falls_back()
  bool own_packing = false;              ///< atom style sphere
  bool checks = false;
  bool overlapped_run = false;
};

}    // namespace Talus

#endif
