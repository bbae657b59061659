// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// ProxyExchange without LAMMPS: random proxies between any ranks, each with a code that tells
// owner, particle, shift and round. Prints "codes right" on rank 0; any other end is a failure.

#include "exchange/proxy_exchange.h"

#include "../unit/random_source.h"

#include <mpi.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

using namespace Talus;

namespace {

int integer(RandomSource &random, int low, int high)
{
  return low + random.below(high - low + 1);
}

constexpr int owned_particles = 40;

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
  void pack(const int *particles, int count, double *out) override
  {
    for (int k = 0; k < count; k++)
      for (int e = 0; e < width; e++) *out++ = code(me, particles[k], round, e);
  }
  void unpack(const ProxyRun &run, const int *places, const double *message) override
  {
    for (int k = 0; k < run.count; k++) {
      std::vector<double> &proxy = state[run.first + k];
      const double *in = message + static_cast<std::size_t>(width) * places[k];
      proxy.insert(proxy.end(), in, in + width);    // once: forget() has been called
      for (double &entry : proxy) entry += code_of_shift(run.shift);
    }
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
  exchange.begin(packer);
  expect(exchange.pending(), "pending after begin");
  for (int k = integer(random, 0, 5); k > 0; k--) exchange.progress();
  exchange.finish();
  expect(!exchange.pending(), "not pending after finish");
  expect(packer.num_wrong(origins) == 0, "codes");

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
    exchange->make_plan(owned_particles, origins, others);
    CodePacker packer(me, static_cast<int>(origins.size()));
    for (packer.round = 1; packer.round < 8; packer.round++) {
      packer.width = integer(common, 1, 9);
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
    if (plan % 5 == 0) exchange = std::make_unique<ProxyExchange>(MPI_COMM_WORLD);
  }
  // the last exchange is pending when the object goes
}

}    // namespace

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
