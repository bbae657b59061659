// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Run on some ranks: sums, gathers, broadcasts and messages of more values than go at once, which are 7 here and 2^30 in
// use. Prints "all right".

#include "exchange/large_messages.h"

#include <cstdio>

using namespace Talus;

namespace {

constexpr std::size_t at_once = 7;
int me, ranks, failures = 0;

void expect(bool holds, const char *what)
{
  if (holds) return;
  failures++;
  std::fprintf(stderr, "rank %d: failed: %s\n", me, what);
}

/// Of this rank; some ranks have none.
std::vector<std::int64_t> values_of(int rank)
{
  std::vector<std::int64_t> values;
  for (int n = 0; n < (rank % 3 == 1 ? 0 : 20 + 3 * rank); n++) values.push_back(1000 * rank + n);
  return values;
}

void check_sums()
{
  for (int root = -1; root < ranks; root++) {
    std::vector<double> numbers;
    for (int n = 0; n < 23; n++) numbers.push_back(n + 100.0 * me);
    sum_over_ranks(numbers, root, MPI_COMM_WORLD, at_once);
    for (int n = 0; n < 23 && (root < 0 || root == me); n++)
      expect(numbers[n] == n * ranks + 50.0 * ranks * (ranks - 1), "sum");
  }
}

void check_gathers()
{
  std::vector<std::int64_t> all;
  for (int rank = 0; rank < ranks; rank++)
    for (const std::int64_t value : values_of(rank)) all.push_back(value);
  for (int root = -1; root < ranks; root++)
    for (const std::size_t most : {std::size_t(1), at_once, most_at_once}) {
      const auto found = gather(values_of(me), MPI_INT64_T, root, MPI_COMM_WORLD, most);
      expect(found == (root < 0 || root == me ? all : std::vector<std::int64_t>{}), "gather");
    }
}

void check_broadcast()
{
  std::vector<std::int64_t> values =
      me == ranks - 1 ? values_of(3) : std::vector<std::int64_t>(29, -1);
  broadcast(values.data(), values.size(), MPI_INT64_T, ranks - 1, MPI_COMM_WORLD, at_once);
  expect(values == values_of(3), "broadcast");
}

/// From each rank to the next, of one type to another.
void check_message(std::size_t doubles, std::size_t most)
{
  std::vector<double> out(doubles);
  for (std::size_t n = 0; n < doubles; n++) out[n] = static_cast<double>(n + 1000 * me);
  MPI_Request request;
  const int to = (me + 1) % ranks, from = (me + ranks - 1) % ranks;
  {
    const LargeMessage whole(doubles, most);
    MPI_Isend(out.data(), whole.count(), whole.type(), to, 0, MPI_COMM_WORLD, &request);
  }
  MPI_Status status;
  MPI_Probe(from, 0, MPI_COMM_WORLD, &status);
  expect(doubles_of(status) == doubles, "size of a message");
  std::vector<double> in(doubles_of(status));
  const LargeMessage whole(in.size(), most);
  MPI_Recv(in.data(), whole.count(), whole.type(), from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  MPI_Wait(&request, MPI_STATUS_IGNORE);
  for (std::size_t n = 0; n < in.size(); n++)
    if (in[n] != static_cast<double>(n + 1000 * from)) return expect(false, "message");
}

}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  check_sums();
  check_gathers();
  check_broadcast();
  for (const std::size_t doubles : {0, 1, 6, 7, 8, 21, 25}) check_message(doubles, at_once);
  MPI_Allreduce(MPI_IN_PLACE, &failures, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  if (me == 0 && !failures) std::printf("all right\n");
  MPI_Finalize();
  return failures ? 1 : 0;
}
