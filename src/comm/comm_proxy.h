// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// LAMMPS' communication object with a direct exchange: ExchangeSwitch puts it in the place of
// the stock CommBrick. doc/comm_proxy.md is the user's page.
//
// Migration, borders and all exchanges of single styles stay LAMMPS' staged ones, so that the
// order of ghost particles, and with it every neighbor list, is the stock one. At the end of
// borders() a plan is derived that goes from owner to proxy without stages; forward_comm(), which
// runs in every other step, uses it.
//
// forward_comm() is blocking, for every caller. Only the run style of Talus calls begin().
// Every method finishes a pending exchange first.

#ifndef LMP_COMM_PROXY_H
#define LMP_COMM_PROXY_H

#include "comm/atom_packers.h"
#include "exchange/packer_with_rows.h"
#include "exchange/proxy_exchange.h"

#include "system/granular_system.h"

#include "comm_brick.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class CommProxy : public CommBrick, public Talus::ProxyUpdates {
 public:
  /// Takes over the settings of `old`, which the caller deletes afterwards. Collective.
  CommProxy(class LAMMPS *, class Comm *old);
  ~CommProxy() override;

  // ---- LAMMPS' interface

  void init() override;
  void setup() override;
  void set_proc_grid(int outflag = 1) override;
  void exchange() override;
  void borders() override;
  void forward_comm(int dummy = 0) override;

  void reverse_comm() override;
  void forward_comm(class Pair *, int size = 0) override;
  void reverse_comm(class Pair *, int size = 0) override;
  void forward_comm(class Bond *, int size = 0) override;
  void reverse_comm(class Bond *, int size = 0) override;
  void forward_comm(class Fix *, int size = 0) override;
  void reverse_comm(class Fix *, int size = 0) override;
  void reverse_comm_variable(class Fix *) override;
  void forward_comm(class Compute *, int size = 0) override;
  void reverse_comm(class Compute *, int size = 0) override;
  void forward_comm(class Dump *, int size = 0) override;
  void reverse_comm(class Dump *, int size = 0) override;
  void forward_comm_array(int, double **) override;
  double memory_usage() override;

  // ---- ours

  bool falls_back() const override { return fell_back; }

  /// Whether begin() can be called: after borders() until the next exchange(). The same on all
  /// ranks.
  bool has_plan() const override { return have_plan; }

  /// Starts the update of all proxies; the caller ensures that they are not read before
  /// finish(). Collective among neighbors, like forward_comm(). `packer`: if states are not in the
  /// arrays of LAMMPS, on all ranks.
  void begin(Talus::ProxyPacker *packer) override;

  /// For the run style, at the start of a run: whether it will call begin().
  void set_overlap(bool yes) override { overlapped_run = yes; }

  // ProxyUpdates
  bool overlaps() const override { return overlapped_run; }
  bool pending() const override { return transfer.pending(); }
  void progress() override { transfer.progress(); }
  bool may_progress_beside(int threads) const override
  {
    return Talus::ProxyExchange::may_progress_beside(threads);
  }
  void finish() override;

  /// Invariant checks: proxies are poisoned with NaN until they are valid, and every state is
  /// compared with the one that the staged exchange brings. The same on all ranks.
  void check(bool yes) { checks = yes; }
  bool is_checking() const override { return checks; }

  const Talus::ExchangePlan &plan() const override { return transfer.plan(); }
  Talus::ExchangeCounters &counters() override { return transfer.counters; }
  /// Of this rank, for one exchange with the present plan.
  double messages_per_exchange() const override;
  double bytes_per_exchange() const override;
  /// What a proxy's message holds, as text for messages.
  std::string describe_message() const override;

 private:
  Talus::ProxyPacker &choose_packer(Talus::ProxyPacker *given);
  int stride() const;
  void look_for_unsupported();
  void derive_plan();
  int largest_stride() const;
  std::vector<Talus::ProxyOrigin> trace_origins();
  std::vector<int> possible_neighbors() const;
  void poison_proxies();
  void check_owners();
  void check_states();

  std::shared_ptr<Talus::GranularSystem> system;
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
