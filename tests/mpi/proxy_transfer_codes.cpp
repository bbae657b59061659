// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// ProxyExchange without LAMMPS: random proxies between any ranks, each with a code that tells
// owner, particle, shift and round. What becomes of each receive is counted through the profiling
// interface of MPI. Prints "codes right" on rank 0; any other end is a failure.

#include "exchange/proxy_exchange.h"

#include "../unit/random_source.h"

#include <mpi.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>
#include <vector>

using namespace Talus;

namespace {

int integer(RandomSource &random, int low, int high)
{
  return low + random.below(high - low + 1);
}

constexpr int owned_particles = 40, largest_stride = 9;

/// Receives without blocking of this rank.
struct Receives {
  int opened = 0, canceled = 0, completed = 0;
  std::set<MPI_Request> requests;    ///< that are open

  int open() const { return static_cast<int>(requests.size()); }

  /// Counts the requests that a call completes.
  template <class Call> int watch(int count, MPI_Request *handles, Call call)
  {
    const std::vector<MPI_Request> before(handles, handles + count);
    const int result = call();
    for (int k = 0; k < count; k++)
      if (handles[k] == MPI_REQUEST_NULL) completed += static_cast<int>(requests.erase(before[k]));
    return result;
  }
};
Receives receives;

double code(int owner, int index, int round, int entry)
{
  double c = owner;
  c = 64.0 * c + index;
  c = 64.0 * c + round;
  return 16.0 * c + entry;
}

/// What the receiver adds for an image.
double code_of_shift(const PeriodicShift &shift)
{
  double c = 0.0;
  for (const int s : shift) c = 8.0 * c + (s + 4);
  return 1e9 * c;
}

class CodePacker : public ProxyPacker {
 public:
  CodePacker(int rank, int proxies) : me(rank), state(owned_particles + proxies) {}

  int width = 1, round = 0;

  int stride() const override { return width; }
  void pack(const ExchangeNeighbor &to, double *out) override
  {
    for (const int particle : to.send_index)
      for (int e = 0; e < width; e++) *out++ = code(me, particle, round, e);
  }
  void unpack(const ExchangeNeighbor &from, const double *message) override
  {
    from.for_each_proxy([&](int index, int place, const PeriodicShift &shift) {
      std::vector<double> &proxy = state[index];
      const double *in = message + static_cast<std::size_t>(width) * place;
      proxy.insert(proxy.end(), in, in + width);    // once: forget() has been called
      for (double &entry : proxy) entry += code_of_shift(shift);
    });
  }

  void forget()
  {
    for (auto &s : state) s.clear();
  }
  int num_wrong(const std::vector<ProxyOrigin> &origins) const
  {
    int wrong = 0;
    for (std::size_t k = 0; k < origins.size(); k++) {
      std::vector<double> expected;
      for (int e = 0; e < width; e++)
        expected.push_back(code(origins[k].owner, origins[k].index, round, e) +
                           code_of_shift(origins[k].shift));
      wrong += state[owned_particles + k] != expected;
    }
    for (int i = 0; i < owned_particles; i++) wrong += !state[i].empty();
    return wrong;
  }

 private:
  int me;
  std::vector<std::vector<double>> state;    // of owned particles, never written, and proxies
};

/// Proxies of a few ranks only, and of none on some ranks.
std::vector<ProxyOrigin> draw_origins(RandomSource &random, int ranks)
{
  std::vector<ProxyOrigin> origins;
  for (int runs = integer(random, 0, 12); runs > 0; runs--) {
    ProxyOrigin o{integer(random, 0, ranks - 1), 0, {0, 0, 0}};
    for (int &s : o.shift) s = integer(random, -2, 2);
    for (int k = integer(random, 1, 300); k > 0; k--) {
      o.index = integer(random, 0, owned_particles - 1);
      origins.push_back(o);
    }
  }
  return origins;
}

/// How many messages an exchange brings.
int num_messages(const ExchangePlan &plan)
{
  int count = 0;
  for (const ExchangeNeighbor &n : plan.neighbors()) count += n.receive_count() > 0;
  return count;
}

int failures = 0;
void expect(bool holds, const char *what)
{
  if (holds) return;
  failures++;
  std::fprintf(stderr, "failed: %s\n", what);
}

void exchange_codes(ProxyExchange &exchange, CodePacker &packer,
                    const std::vector<ProxyOrigin> &origins, RandomSource &random)
{
  packer.forget();
  const ExchangeCounters before = exchange.counters;
  const Receives opened_before = receives;
  expect(receives.open() == num_messages(exchange.plan()), "receives wait for messages");
  exchange.begin(packer);
  expect(receives.opened == opened_before.opened, "no receive is opened late");
  expect(exchange.pending(), "pending after begin");
  for (int k = integer(random, 0, 5); k > 0; k--) exchange.progress();
  exchange.finish();
  expect(!exchange.pending(), "not pending after finish");
  expect(packer.num_wrong(origins) == 0, "codes");
  expect(receives.completed - opened_before.completed == num_messages(exchange.plan()),
         "one message for each receive");
  expect(receives.open() == num_messages(exchange.plan()), "receives are open again");

  double messages = 0.0, proxies = 0.0;
  for (const ExchangeNeighbor &n : exchange.plan().neighbors()) {
    messages += n.send_count() > 0;
    proxies += n.send_count();
  }
  const ExchangeCounters &now = exchange.counters;
  expect(now.messages - before.messages == messages, "messages counted");
  expect(now.bytes - before.bytes == 8.0 * packer.width * proxies, "bytes counted");
  expect(exchange.bytes_per_exchange(packer.width) == 8.0 * packer.width * proxies, "bytes");
}

template <class Exception, class Call> bool throws(Call call)
{
  try {
    call();
  } catch (const Exception &) {
    return true;
  }
  return false;
}

void run(int me, int ranks)
{
  RandomSource random(100 + me), common(7);    // `common` draws the same on all ranks
  auto exchange = std::make_unique<ProxyExchange>(MPI_COMM_WORLD);
  std::vector<int> others;
  for (int r = ranks - 1; r >= 0; r--)
    if (r != me) others.push_back(r);

  for (int plan = 0; plan < 25; plan++) {
    const std::vector<ProxyOrigin> origins = draw_origins(random, ranks);
    exchange->make_plan(owned_particles, origins, others, largest_stride);
    expect(receives.open() == num_messages(exchange->plan()), "receives of old plans are gone");
    CodePacker packer(me, static_cast<int>(origins.size()));
    for (packer.round = 1; packer.round < 8; packer.round++) {
      packer.width = integer(common, 1, largest_stride);
      exchange_codes(*exchange, packer, origins, random);
    }
    // left before it is finished: nothing is unpacked, and the next one is right
    packer.forget();
    exchange->begin(packer);
    expect(throws<std::logic_error>([&] { exchange->begin(packer); }), "begin while pending");
    if (plan % 2) {
      exchange->abandon();
      expect(!exchange->pending(), "abandoned");
      exchange_codes(*exchange, packer, origins, random);
      exchange->begin(packer);
    }
    if (plan % 5 == 0) {
      exchange.reset();
      expect(receives.open() == 0, "no receive is left behind");
      exchange = std::make_unique<ProxyExchange>(MPI_COMM_WORLD);
    }
    if (plan % 3 == 1) {    // receives that wait for an exchange when the next plan comes
      exchange->make_plan(owned_particles, {}, others, largest_stride);
      exchange->make_plan(owned_particles, origins, others, largest_stride);
      packer.width = largest_stride + 1;
      expect(throws<std::logic_error>([&] { exchange->begin(packer); }), "stride too large");
    }
  }
  int canceled = 0;
  MPI_Allreduce(&receives.canceled, &canceled, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  expect(ranks == 1 || canceled > 0, "some plans came instead of an exchange");
  // the last exchange is pending when the object goes
}

}    // namespace

// ---- the calls of MPI that end a receive

extern "C" {

int MPI_Irecv(void *buffer, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
              MPI_Request *request)
{
  const int result = PMPI_Irecv(buffer, count, type, from, tag, comm, request);
  receives.requests.insert(*request);
  receives.opened++;
  return result;
}

int MPI_Cancel(MPI_Request *request)
{
  receives.canceled += static_cast<int>(receives.requests.erase(*request));
  return PMPI_Cancel(request);
}

int MPI_Waitall(int count, MPI_Request *requests, MPI_Status *statuses)
{
  return receives.watch(count, requests, [&] { return PMPI_Waitall(count, requests, statuses); });
}

int MPI_Testall(int count, MPI_Request *requests, int *flag, MPI_Status *statuses)
{
  return receives.watch(count, requests,
                        [&] { return PMPI_Testall(count, requests, flag, statuses); });
}

int MPI_Waitany(int count, MPI_Request *requests, int *which, MPI_Status *status)
{
  return receives.watch(count, requests,
                        [&] { return PMPI_Waitany(count, requests, which, status); });
}

int MPI_Testsome(int count, MPI_Request *requests, int *ended, int *which, MPI_Status *statuses)
{
  return receives.watch(count, requests,
                        [&] { return PMPI_Testsome(count, requests, ended, which, statuses); });
}
}

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  int me = 0, ranks = 1, all = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  run(me, ranks);
  MPI_Allreduce(&failures, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  if (me == 0 && all == 0) std::puts("codes right");
  MPI_Finalize();
  return all != 0;
}
