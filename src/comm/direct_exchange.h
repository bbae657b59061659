// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The update of proxies without stages: at the end of borders() a plan is derived from the swaps of
// LAMMPS that goes from owner to proxy, and every update follows it.
//
// An update is blocking for every caller of forward_comm(). Only the run style of Talus calls begin().

#ifndef LMP_DIRECT_EXCHANGE_H
#define LMP_DIRECT_EXCHANGE_H

#include "comm/atom_packers.h"
#include "exchange/packer_with_rows.h"
#include "exchange/proxy_exchange.h"

#include "system/step/granular_system.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// The staged exchange of LAMMPS, after its borders().
class StagedExchange {
 public:
  /// Runs once through its swaps, with the identity of particles instead of their state: what a rank
  /// passes on is known to belong to someone else. Of ghosts, in their order. Collective; messages of
  /// this communicator have TAG_ORIGIN.
  virtual std::vector<Talus::ProxyOrigin> trace_origins(MPI_Comm communicator) = 0;
  /// All ranks that may share a proxy with this one, without it. If a rank is one of another's, then
  /// this is one of its. Collective.
  virtual std::vector<int> possible_neighbors() = 0;
  /// Its update of all ghosts.
  virtual void forward_staged() = 0;

 protected:
  ~StagedExchange() = default;    // never deleted through this interface
};

class DirectExchange : protected Pointers, public Talus::ProxyUpdates {
 public:
  /// Of the communication object `owner`. Collective.
  DirectExchange(LAMMPS *lmp, const class Comm *owner, StagedExchange &staged);
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

  // ---- ProxyUpdates

  bool falls_back() const override { return fell_back; }
  bool has_plan() const override { return have_plan; }
  void begin(Talus::ProxyPacker *packer) override;
  void set_overlap(bool yes) override { overlapped_run = yes; }
  bool overlaps() const override { return overlapped_run; }
  bool pending() const override { return transfer.pending(); }
  void progress() override { transfer.progress(); }
  bool may_progress_beside(int threads) const override
  {
    return Talus::ProxyExchange::may_progress_beside(threads);
  }
  void finish() override;
  void check(bool yes) override { checks = yes; }
  bool is_checking() const override { return checks; }
  const Talus::ExchangePlan &plan() const override { return transfer.plan(); }
  Talus::ExchangeCounters &counters() override { return transfer.counters; }
  double messages_per_exchange() const override;
  double bytes_per_exchange() const override;
  std::string describe_message() const override;

 private:
  Talus::ProxyPacker &choose_packer(Talus::ProxyPacker *given);
  int stride() const;
  void look_for_unsupported();
  int largest_stride() const;
  void poison_proxies();
  void check_owners();
  void check_states();

  std::shared_ptr<Talus::GranularSystem> system;
  StagedExchange &staged;
  const Comm *owner;
  Talus::ProxyExchange transfer;
  Talus::AtomVecPacker atom_vec_packer;
  Talus::SpherePacker sphere_packer;
  Talus::PackerWithRows with_orientations;
  bool have_plan = false;                ///< the same on all ranks
  bool plan_has_orientations = false;    ///< room for them in its messages
  bool fell_back = false;                ///< in this run, see falls_back()
  bool own_packing = false;              ///< atom style sphere
  bool checks = false;
  bool overlapped_run = false;
};

}    // namespace LAMMPS_NS

#endif
