// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Messages of any length to a few ranks that do not know of them. Messages are not counted: each
// rank sends synchronously, takes what comes, and starts a reduction over all ranks once its own
// messages are being received. When the reduction is over, no message is under way any more
// (Hoefler, Siebert and Lumsdaine, "Scalable communication protocols for dynamic sparse data
// exchange", PPoPP 2010). The reduction finds the largest of a number on the way, for which one
// would be needed anyway.

#ifndef TALUS_EXCHANGE_SPARSE_EXCHANGE_H
#define TALUS_EXCHANGE_SPARSE_EXCHANGE_H

#include <mpi.h>

#include <functional>
#include <map>
#include <vector>

namespace Talus {

class SparseExchange {
 public:
  /// Collective over `parent`, which is duplicated.
  explicit SparseExchange(MPI_Comm parent);
  ~SparseExchange();
  SparseExchange(const SparseExchange &) = delete;
  SparseExchange &operator=(const SparseExchange &) = delete;

  /// Collective. Sends messages[rank] to each rank of the map, other ranks than this one, and calls
  /// take(message) for those that come in, in any order. Returns the largest `number` of all ranks.
  int run(const std::map<int, std::vector<double>> &messages, int number,
          const std::function<void(const std::vector<double> &)> &take);

 private:
  bool take_one(const std::function<void(const std::vector<double> &)> &take);

  MPI_Comm comm = MPI_COMM_NULL;
  int tag = 0;    // 0 and 1 in turn: who is through may send the next ones already
};

}    // namespace Talus

#endif
