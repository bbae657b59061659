// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The transfer: one message to each rank that holds a proxy of a particle of ours. MPI only, no
// LAMMPS. Sends nothing to ourselves, has no collective operation and no barrier after its
// construction.
//
//   make_plan()                 after every rebuild; with all ranks that may be involved
//   begin(packer)               packs and sends, opens the receives; returns at once
//   progress()                  now and then while doing something else
//   finish()                    waits for what is to be received and unpacks it
//
// begin() must find nothing pending. The buffers of messages still on their way out after finish()
// stay untouched until the next begin(), which waits for them.

#ifndef TALUS_EXCHANGE_PROXY_EXCHANGE_H
#define TALUS_EXCHANGE_PROXY_EXCHANGE_H

#include "exchange/exchange_counters.h"
#include "exchange/exchange_plan.h"
#include "exchange/proxy_packer.h"

#include <mpi.h>

#include <vector>

namespace Talus {

class ProxyExchange {
 public:
  /// Collective over `parent`: works on a duplicate of it, so that no message of the host can be
  /// taken for one of ours.
  explicit ProxyExchange(MPI_Comm parent);
  /// Completes what is under way, without unpacking; after a second without progress (a rank has
  /// left with an error) cancels what is left. Collective over the communicator.
  ~ProxyExchange();
  ProxyExchange(const ProxyExchange &) = delete;
  ProxyExchange &operator=(const ProxyExchange &) = delete;

  /// Builds the plan from the origins of our proxies, see ExchangePlan::build(). `candidates`:
  /// all ranks that may share a proxy with us, each once, without us; if rank a is a candidate of
  /// rank b, then b is one of a. Blocks until all candidates call it too. Throws
  /// std::invalid_argument for a wrong request.
  void make_plan(int first_proxy, const std::vector<ProxyOrigin> &origins,
                 const std::vector<int> &candidates);

  /// Starts to send the state of our particles. `packer` must live until finish(). Throws
  /// std::logic_error if an exchange is pending, and what message_length() throws.
  void begin(ProxyPacker &packer);

  /// Never waits. Unpacks what has arrived.
  void progress();

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
  void size_buffers(int stride);
  void pack_and_send(int n);
  void copy_to_self();
  void unpack_from(const ExchangeNeighbor &from, const double *buffer);
  void complete_sends();
  void complete_or_cancel();

  MPI_Comm comm = MPI_COMM_NULL;
  int me = 0;
  ExchangePlan the_plan;
  ProxyPacker *packer = nullptr;    ///< of the pending exchange
  int stride = 0;                   ///< of the present buffers

  std::vector<MPI_Request> receives, sends;    ///< one per neighbor; MPI_REQUEST_NULL when done
  std::vector<double> send_buffer, receive_buffer, self_buffer;
  std::vector<std::size_t> send_start, receive_start;    ///< of each neighbor in its buffer
  std::vector<int> arrived;                              ///< scratch of progress()
};

}    // namespace Talus

#endif
