// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "exchange/proxy_exchange.h"

#include "exchange/exchange_tags.h"

#include <stdexcept>
#include <utility>

using namespace Talus;

namespace {

int done(std::vector<MPI_Request> &requests)
{
  int flag = 0;
  MPI_Testall(static_cast<int>(requests.size()), requests.data(), &flag, MPI_STATUSES_IGNORE);
  return flag;
}

void wait_for(std::vector<MPI_Request> &requests)
{
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

}    // namespace

ProxyExchange::ProxyExchange(MPI_Comm parent)
{
  MPI_Comm_dup(parent, &comm);
  MPI_Comm_rank(comm, &me);
}

ProxyExchange::~ProxyExchange()
{
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (finalized) return;
  complete_or_cancel();
  MPI_Comm_free(&comm);
}

/* ---------------------------------------------------------------------- */

void ProxyExchange::make_plan(int first_proxy, const std::vector<ProxyOrigin> &origins,
                              const std::vector<int> &candidates, int new_largest_stride)
{
  abandon();
  cancel_receives();
  complete_sends();
  the_plan.build(me, first_proxy, origins);
  ask_owners(candidates);
  largest_stride = new_largest_stride;
  size_buffers();
  open_receives();
}

/* One message to every candidate, empty ones included: the receiver knows how many to expect. */

void ProxyExchange::ask_owners(const std::vector<int> &candidates)
{
  const std::size_t n = candidates.size();
  std::vector<std::vector<int>> request(n);
  std::vector<MPI_Request> handle(n, MPI_REQUEST_NULL);
  for (std::size_t c = 0; c < n; c++) {
    request[c] = the_plan.request_for(candidates[c]);
    MPI_Isend(request[c].data(), message_length(1, request[c].size()), MPI_INT, candidates[c],
              TAG_REQUEST, comm, &handle[c]);
  }
  std::vector<std::vector<int>> received(n);
  for (std::size_t c = 0; c < n; c++) {
    MPI_Status status;
    int size = 0;
    MPI_Probe(candidates[c], TAG_REQUEST, comm, &status);
    MPI_Get_count(&status, MPI_INT, &size);
    received[c].resize(size);
    MPI_Recv(received[c].data(), size, MPI_INT, candidates[c], TAG_REQUEST, comm,
             MPI_STATUS_IGNORE);
  }
  wait_for(handle);
  for (std::size_t c = 0; c < n; c++) the_plan.accept_request(candidates[c], received[c]);
}

/* Places in the buffers, for the largest messages. */

void ProxyExchange::size_buffers()
{
  const std::vector<ExchangeNeighbor> &neighbors = the_plan.neighbors();
  std::size_t sent = 0, received = 0;
  send_start.clear();
  receive_start.clear();
  for (const ExchangeNeighbor &n : neighbors) {
    send_start.push_back(sent);
    receive_start.push_back(received);
    sent += message_length(largest_stride, n.send_count());
    received += message_length(largest_stride, n.receive_count());
  }
  send_buffer.resize(sent);
  receive_buffer.resize(received);
  self_buffer.resize(static_cast<std::size_t>(largest_stride) * the_plan.self().send_count());
  receives.assign(neighbors.size(), MPI_REQUEST_NULL);
  sends.assign(neighbors.size(), MPI_REQUEST_NULL);
}

void ProxyExchange::open_receives()
{
  const std::vector<ExchangeNeighbor> &neighbors = the_plan.neighbors();
  for (std::size_t n = 0; n < neighbors.size(); n++)
    if (neighbors[n].receive_count())
      MPI_Irecv(receive_buffer.data() + receive_start[n],
                message_length(largest_stride, neighbors[n].receive_count()), MPI_DOUBLE,
                neighbors[n].rank, TAG_STATE, comm, &receives[n]);
}

void ProxyExchange::cancel_receives()
{
  for (MPI_Request &request : receives)
    if (request != MPI_REQUEST_NULL) MPI_Cancel(&request);
  wait_for(receives);
}

/* ---------------------------------------------------------------------- */

void ProxyExchange::begin(ProxyPacker &with)
{
  if (pending()) throw std::logic_error("an exchange of proxies is pending");
  if (with.stride() > largest_stride)
    throw std::logic_error("states of proxies are longer than their plan was told");
  complete_sends();
  packer = &with;
  counters.exchanges++;
  if (sends.empty()) return;

  const double start = MPI_Wtime();
  const std::vector<ExchangeNeighbor> &neighbors = the_plan.neighbors();
  for (std::size_t n = 0; n < neighbors.size(); n++)
    if (neighbors[n].send_count()) pack_and_send(static_cast<int>(n));
  counters.pack_seconds += MPI_Wtime() - start;
}

/* The message leaves while the next one is packed. */

void ProxyExchange::pack_and_send(int n)
{
  const ExchangeNeighbor &to = the_plan.neighbors()[n];
  double *buffer = send_buffer.data() + send_start[n];
  packer->pack(to, buffer);
  const int size = message_length(packer->stride(), to.send_count());
  MPI_Isend(buffer, size, MPI_DOUBLE, to.rank, TAG_STATE, comm, &sends[n]);
  counters.messages++;
  counters.particles += to.send_count();
  counters.bytes += sizeof(double) * static_cast<double>(size);
}

/* ---------------------------------------------------------------------- */

void ProxyExchange::unpack_from(int n)
{
  packer->unpack(the_plan.neighbors()[n], receive_buffer.data() + receive_start[n]);
}

void ProxyExchange::copy_to_self()
{
  packer->pack(the_plan.self(), self_buffer.data());
  packer->unpack(the_plan.self(), self_buffer.data());
}

void ProxyExchange::progress()
{
  if (!pending() || receives.empty()) return;
  int count = 0;
  arrived.resize(receives.size());
  MPI_Testsome(static_cast<int>(receives.size()), receives.data(), &count, arrived.data(),
               MPI_STATUSES_IGNORE);
  if (count == MPI_UNDEFINED || count == 0) return;
  const double start = MPI_Wtime();
  for (int k = 0; k < count; k++) unpack_from(arrived[k]);
  counters.unpack_seconds += MPI_Wtime() - start;
}

bool ProxyExchange::may_progress_beside(int threads)
{
  if (threads == 1) return true;
  int level = MPI_THREAD_SINGLE;
  MPI_Query_thread(&level);
  return level >= MPI_THREAD_FUNNELED;
}

void ProxyExchange::finish()
{
  if (!pending()) return;
  if (!receives.empty() || the_plan.self().send_count()) take_states();
  packer = nullptr;
  open_receives();
}

void ProxyExchange::take_states()
{
  double before = MPI_Wtime();
  const auto lap = [&before](double &sum) {
    const double now = MPI_Wtime();
    sum += now - before;
    before = now;
  };

  copy_to_self();
  lap(counters.unpack_seconds);
  while (!receives.empty()) {
    int n = MPI_UNDEFINED;
    MPI_Waitany(static_cast<int>(receives.size()), receives.data(), &n, MPI_STATUS_IGNORE);
    lap(counters.wait_seconds);
    if (n == MPI_UNDEFINED) break;
    unpack_from(n);
    lap(counters.unpack_seconds);
  }
}

/* ---------------------------------------------------------------------- */

void ProxyExchange::abandon()
{
  if (!pending()) return;
  wait_for(receives);
  packer = nullptr;
  open_receives();
}

/* A message can still be on its way out when all that we wait for has arrived: a receiver that is
   late has our buffer. */

void ProxyExchange::complete_sends()
{
  if (sends.empty()) return;
  const double start = MPI_Wtime();
  wait_for(sends);
  counters.wait_seconds += MPI_Wtime() - start;
}

void ProxyExchange::complete_or_cancel()
{
  constexpr double patience = 1.0;    // seconds
  const double start = MPI_Wtime();
  bool complete = false;
  while (!complete && MPI_Wtime() - start < patience) {
    const bool received = !pending() || done(receives);
    complete = done(sends) && received;
  }
  packer = nullptr;
  cancel_receives();
  bool unsent = false;
  for (MPI_Request &request : sends)
    if (request != MPI_REQUEST_NULL) {
      MPI_Request_free(&request);
      unsent = true;
    }
  // A send that was given up may still be read by its receiver: its buffer must outlive us.
  if (unsent) new AlignedVector<double>(std::move(send_buffer));
}

double ProxyExchange::bytes_per_exchange(int of_stride) const
{
  double count = 0.0;
  for (const ExchangeNeighbor &n : the_plan.neighbors()) count += n.send_count();
  return sizeof(double) * of_stride * count;
}
