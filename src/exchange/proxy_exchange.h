// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The transfer: one message to each rank that holds a proxy of a particle of ours. MPI only, no
// LAMMPS. Sends nothing to ourselves, has no collective operation and no barrier after its
// construction.
//
//   make_plan()                 after every rebuild; with all ranks that may be involved
//   begin(packer)               packs and sends; returns at once
//   progress()                  now and then while doing something else
//   finish()                    waits for what is to be received and unpacks it
//
// begin() must find nothing pending. The buffers of messages still on their way out after finish()
// stay untouched until the next begin(), which waits for them.
//
// Receives are open whenever there is a plan: make_plan() opens them, and finish() again as soon as
// their buffers have been read, long before particles move and the next messages leave. So a
// message never waits for its receiver, nor is it stored elsewhere first. A receive does not know
// how long its message will be: all are as long as the largest stride that make_plan() was told.
// Where another plan comes instead of another exchange, the open receives are canceled. No message
// can have reached one of them: all ranks make plans together, and no rank sends states between the
// last finish() and the new plan. Messages with states are told apart by their order alone, so an
// exchange that has begun is always received, even if it is then abandoned.

#ifndef TALUS_EXCHANGE_PROXY_EXCHANGE_H
#define TALUS_EXCHANGE_PROXY_EXCHANGE_H

#include "base/aligned_vector.h"
#include "exchange/exchange_counters.h"
#include "exchange/exchange_plan.h"
#include "exchange/proxy_packer.h"

#include <mpi.h>

#include <vector>

namespace Talus {

class ProxyExchange {
 public:
  /// Collective over `parent`: works on a duplicate of it, so that no message of LAMMPS can be
  /// taken for one of ours.
  explicit ProxyExchange(MPI_Comm parent);
  /// Completes what is under way, without unpacking; after a second without progress (a rank has
  /// left with an error) cancels what is left, as it does with receives that wait for the next
  /// exchange. Collective over the communicator.
  ~ProxyExchange();
  ProxyExchange(const ProxyExchange &) = delete;
  ProxyExchange &operator=(const ProxyExchange &) = delete;

  /// Builds the plan from the origins of our proxies, see ExchangePlan::build(). `candidates`:
  /// all ranks that may share a proxy with us, each once, without us; if rank a is a candidate of
  /// rank b, then b is one of a. `largest_stride`: of all packers until the next plan; the same on
  /// all ranks. Blocks until all candidates call it too. Throws std::invalid_argument for a wrong
  /// request, and what message_length() throws.
  void make_plan(int first_proxy, const std::vector<ProxyOrigin> &origins,
                 const std::vector<int> &candidates, int largest_stride);

  /// Starts to send the state of our particles. `packer` must live until finish(). Throws
  /// std::logic_error if an exchange is pending, or if the stride of the packer is larger than
  /// make_plan() was told.
  void begin(ProxyPacker &packer);

  /// Never waits. Unpacks what has arrived.
  void progress();

  /// Whether the thread that started MPI may call progress() while so many threads are at work: one
  /// may always, several only if MPI has been started for that (MPI_THREAD_FUNNELED).
  static bool may_progress_beside(int threads);

  /// Waits for all receives. Does nothing if nothing is pending.
  void finish();

  /// Ends a pending exchange without unpacking: for indices that are no longer valid.
  void abandon();

  bool pending() const { return packer != nullptr; }
  const ExchangePlan &plan() const { return the_plan; }
  MPI_Comm communicator() const { return comm; }
  int my_rank() const { return me; }

  /// Bytes of the messages of one exchange with the given stride.
  double bytes_per_exchange(int stride) const;

  ExchangeCounters counters;

 private:
  void ask_owners(const std::vector<int> &candidates);
  void size_buffers();
  void open_receives();
  void cancel_receives();
  void pack_and_send(int n);
  void copy_to_self();
  void take_states();
  void unpack_from(int n);
  void complete_sends();
  void complete_or_cancel();

  MPI_Comm comm = MPI_COMM_NULL;
  int me = 0;
  ExchangePlan the_plan;
  ProxyPacker *packer = nullptr;    ///< of the pending exchange
  int largest_stride = 0;           ///< of the present plan

  std::vector<MPI_Request> receives, sends;    ///< one per neighbor; MPI_REQUEST_NULL when done
  AlignedVector<double> send_buffer, receive_buffer, self_buffer;
  std::vector<std::size_t> send_start, receive_start;    ///< of each neighbor in its buffer
  std::vector<int> arrived;                              ///< scratch of progress()
};

}    // namespace Talus

#endif
