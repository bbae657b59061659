// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Who sends which particles to whom: data only, without MPI and without LAMMPS.
//
// A proxy is a copy of a particle that another rank owns, or a periodic image of one of our own.
// After a rebuild every rank knows for each of its proxies where it comes from (ProxyOrigin). The
// plan is built from that in three steps, the same on every rank:
//
//   build(me, first, origins)       groups the proxies into runs, and finds what to ask of whom
//   request_for(rank)               what to send to `rank`, which owns some of our proxies
//   accept_request(rank, message)   what `rank` asked of us; afterwards the plan is complete
//
// A message holds the state of each particle that the receiver needs, once, however many images of
// it the receiver has; which state belongs to which proxy, and how the proxy is shifted, only the
// receiver knows. Both sides know the order, so that messages carry no indices.

#ifndef TALUS_EXCHANGE_EXCHANGE_PLAN_H
#define TALUS_EXCHANGE_EXCHANGE_PLAN_H

#include <array>
#include <cstddef>
#include <vector>

namespace Talus {

/// Periods by which an image is shifted along x, y, z against the particle.
using PeriodicShift = std::array<int, 3>;

/// Where a proxy comes from. Travels between ranks as five ints.
struct ProxyOrigin {
  int owner;    ///< rank
  int index;    ///< index of the particle on its owner, below the number of owned particles
  PeriodicShift shift;
};
static_assert(sizeof(ProxyOrigin) == 5 * sizeof(int));

/// Proxies that follow each other and have owner and shift in common.
struct ProxyRun {
  int first;    ///< index of the first proxy
  int count;
  PeriodicShift shift;

  bool shifted() const { return shift != PeriodicShift{}; }
};

/// What is exchanged with one rank, or with ourselves.
struct ExchangeNeighbor {
  int rank = -1;
  std::vector<int> send_index;       ///< our particles, in the order of the message
  std::vector<int> receive_index;    ///< theirs: indices on their rank, ascending
  std::vector<ProxyRun> receive;
  std::vector<int> receive_place;    ///< of the proxies, run after run: place in receive_index

  int send_count() const { return static_cast<int>(send_index.size()); }
  int receive_count() const { return static_cast<int>(receive_index.size()); }

  /// visit(proxy, place, shift) for each proxy: its index, and the place of its particle in the
  /// message.
  template <class Visit> void for_each_proxy(Visit visit) const
  {
    const int *place = receive_place.data();
    for (const ProxyRun &run : receive)
      for (int k = 0; k < run.count; k++) visit(run.first + k, *place++, run.shift);
  }
};

/// Numbers in a message of `count` particles with `stride` numbers each. MPI counts with an int:
/// throws std::length_error if they are more.
int message_length(int stride, std::size_t count);

class ExchangePlan {
 public:
  /// Receiving side. `first_proxy`: index of the first proxy, which is also the number of owned
  /// particles; origins[k] belongs to proxy first_proxy + k. Images of our own particles are
  /// complete at once.
  void build(int me, int first_proxy, const std::vector<ProxyOrigin> &origins);

  /// The request for a rank, empty if none of its particles is a proxy here: their indices.
  std::vector<int> request_for(int rank) const;

  /// Sending side: takes a request. Throws std::invalid_argument if it names a particle that we do
  /// not own, or one twice.
  void accept_request(int rank, const std::vector<int> &message);

  /// Drops everything.
  void clear();

  /// Ranks with which something is shared, those above our own first: not all ranks start with
  /// rank 0. We ourselves are not among them.
  const std::vector<ExchangeNeighbor> &neighbors() const { return others; }
  /// Periodic images of our own particles.
  const ExchangeNeighbor &self() const { return self_images; }

  int num_owned() const { return owned; }
  int num_proxies() const { return proxies; }
  /// Owned particles that are a proxy nowhere, not even here.
  int num_interior() const;

 private:
  ExchangeNeighbor &neighbor(int rank);
  void add_to_runs(const ProxyOrigin &origin, int proxy, ExchangeNeighbor *&last);
  static void arrange_message(ExchangeNeighbor &from);

  int me = 0, owned = 0, proxies = 0;
  ExchangeNeighbor self_images;
  std::vector<ExchangeNeighbor> others;
};

}    // namespace Talus

#endif
