// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What MPI does with any number of values: it counts them with int.

#ifndef TALUS_EXCHANGE_LARGE_MESSAGES_H
#define TALUS_EXCHANGE_LARGE_MESSAGES_H

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace Talus {

/// Values of all ranks together in one call of MPI; tests take less.
inline constexpr std::size_t most_at_once = std::size_t(1) << 30U;

/// Collective, `count` is the same on all ranks.
template <class Number>
void broadcast(Number *values, std::size_t count, MPI_Datatype type, int from, MPI_Comm comm,
               std::size_t at_once = most_at_once)
{
  for (std::size_t first = 0; first < count; first += at_once)
    MPI_Bcast(values + first, static_cast<int>(std::min(at_once, count - first)), type, from, comm);
}

/// Sums over ranks, in their place on the rank `root`, on all with a negative one. Collective, the same count on all.
inline void sum_over_ranks(std::vector<double> &numbers, int root, MPI_Comm comm,
                           std::size_t at_once = most_at_once)
{
  int me;
  MPI_Comm_rank(comm, &me);
  for (std::size_t first = 0; first < numbers.size(); first += at_once) {
    double *const part = &numbers[first];
    const int count = static_cast<int>(std::min(at_once, numbers.size() - first));
    if (root < 0)
      MPI_Allreduce(MPI_IN_PLACE, part, count, MPI_DOUBLE, MPI_SUM, comm);
    else if (me == root)
      MPI_Reduce(MPI_IN_PLACE, part, count, MPI_DOUBLE, MPI_SUM, root, comm);
    else
      MPI_Reduce(part, nullptr, count, MPI_DOUBLE, MPI_SUM, root, comm);
  }
}

/// The values of all ranks, in the order of ranks, on the rank `root`, on all with a negative one; empty on others.
/// Collective.
template <class Number>
std::vector<Number> gather(const std::vector<Number> &mine, MPI_Datatype type, int root,
                           MPI_Comm comm, std::size_t at_once = most_at_once)
{
  int me, ranks;
  MPI_Comm_rank(comm, &me);
  MPI_Comm_size(comm, &ranks);
  const std::uint64_t here = mine.size();
  std::vector<std::uint64_t> counts(ranks), first(ranks + 1, 0);
  MPI_Allgather(&here, 1, MPI_UINT64_T, counts.data(), 1, MPI_UINT64_T, comm);
  std::partial_sum(counts.begin(), counts.end(), first.begin() + 1);
  const std::uint64_t most = *std::max_element(counts.begin(), counts.end()),
                      share = std::max<std::uint64_t>(at_once / ranks, 1);
  const bool takes = root < 0 || me == root;
  std::vector<Number> all(takes ? first[ranks] : 0), round;
  std::vector<int> size(ranks), begin(ranks + 1, 0);
  for (std::uint64_t done = 0; done < most; done += share) {
    for (int r = 0; r < ranks; r++) {
      size[r] = static_cast<int>(counts[r] > done ? std::min(share, counts[r] - done) : 0);
      begin[r + 1] = begin[r] + size[r];
    }
    round.resize(takes ? begin[ranks] : 0);
    const Number *const part = mine.data() + std::min(done, here);
    if (root < 0)
      MPI_Allgatherv(part, size[me], type, round.data(), size.data(), begin.data(), type, comm);
    else
      MPI_Gatherv(part, size[me], type, round.data(), size.data(), begin.data(), type, root, comm);
    for (int r = 0; r < ranks && takes; r++)
      std::copy_n(&round[0] + begin[r], size[r], &all[0] + (first[r] + done));
  }
  return all;
}

/// Doubles of one message, also more than MPI counts: `count` elements of `type`. `at_once`: of tests.
class LargeMessage {
 public:
  explicit LargeMessage(std::size_t doubles, std::size_t at_once = most_at_once)
  {
    if (doubles <= at_once) {
      number = static_cast<int>(doubles);
      return;
    }
    const int rest = static_cast<int>(doubles % at_once);
    MPI_Datatype block;
    MPI_Type_contiguous(static_cast<int>(at_once), MPI_DOUBLE, &block);
    const int lengths[2] = {static_cast<int>(doubles / at_once), rest};
    const MPI_Aint places[2] = {0, static_cast<MPI_Aint>((doubles - rest) * sizeof(double))};
    const MPI_Datatype types[2] = {block, MPI_DOUBLE};
    MPI_Type_create_struct(2, lengths, places, types, &made);
    MPI_Type_commit(&made);
    MPI_Type_free(&block);
    number = 1;
  }
  ~LargeMessage()
  {
    if (made != MPI_DATATYPE_NULL) MPI_Type_free(&made);
  }
  LargeMessage(const LargeMessage &) = delete;
  LargeMessage &operator=(const LargeMessage &) = delete;

  int count() const { return number; }
  MPI_Datatype type() const { return made != MPI_DATATYPE_NULL ? made : MPI_DOUBLE; }

 private:
  int number;
  MPI_Datatype made = MPI_DATATYPE_NULL;
};

/// How many doubles a message has that was probed for.
inline std::size_t doubles_of(const MPI_Status &status)
{
  MPI_Count count;
  MPI_Get_elements_x(&status, MPI_DOUBLE, &count);
  return static_cast<std::size_t>(count);
}

}    // namespace Talus

#endif
