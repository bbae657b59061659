// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Numbers that belong to items of which each has an owner, some rank: sums of what all ranks have for an item go to its
// owner, and what the owner has for it goes to those who ask. Messages go between ranks that share items only, and which
// these are is found anew each time. Sums have the same bits however items and parts are divided among ranks.

#ifndef TALUS_EXCHANGE_OWNER_EXCHANGE_H
#define TALUS_EXCHANGE_OWNER_EXCHANGE_H

#include "base/scaled_sum.h"
#include "exchange/sparse_exchange.h"

#include <mpi.h>

#include <cstddef>
#include <map>
#include <vector>

namespace Talus {

class OwnerExchange {
 public:
  /// The rank that has an item, and its place there.
  struct Home {
    int rank, place;
  };
  /// Collective; the same list on all ranks: the home of each item.
  OwnerExchange(MPI_Comm parent, std::vector<Home> homes);

  /// Of this rank.
  int num_owned() const { return owned; }

  /// Collective. `width` sums for each of these items, which come once. Returns the sums of all ranks, in the order of the
  /// places of this rank's items.
  std::vector<ScaledSum> to_owners(const std::vector<int> &items,
                                   const std::vector<ScaledSum> &sums, int width);
  /// Collective. `width` numbers for each place of this rank; returns those of these items, in their order.
  std::vector<double> from_owners(const std::vector<int> &items, const std::vector<double> &values,
                                  int width);

 private:
  using Messages = std::map<int, std::vector<double>>;

  int me = 0, owned = 0;
  std::vector<Home> homes;
  SparseExchange exchange;
};

}    // namespace Talus

#endif
