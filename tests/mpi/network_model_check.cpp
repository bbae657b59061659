// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Run with bench/libnetwork_model.so preloaded, on two or more ranks: messages and reductions must
// be right, and must not be there before the model allows it, however they are waited for. Prints
// "model right".

#include <mpi.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

int failures = 0;

void expect(bool holds, const char *what)
{
  if (holds) return;
  failures++;
  std::fprintf(stderr, "failed: %s\n", what);
}

double number(const char *name)
{
  const char *text = std::getenv(name);
  return text ? std::atof(text) : -1.0;
}

enum Way { RECV, WAIT, WAITALL, WAITANY, TEST, TESTALL, TESTSOME, SENDRECV, NUM_WAYS };

void complete(Way way, MPI_Request *request)
{
  int flag = 0, count = 0, index = -1;
  if (way == WAIT) MPI_Wait(request, MPI_STATUS_IGNORE);
  if (way == WAITALL) MPI_Waitall(1, request, MPI_STATUSES_IGNORE);
  if (way == WAITANY) {
    MPI_Waitany(1, request, &index, MPI_STATUS_IGNORE);
    expect(index == 0, "index of waitany");
  }
  while (way == TEST && !flag) MPI_Test(request, &flag, MPI_STATUS_IGNORE);
  while (way == TESTALL && !flag) MPI_Testall(1, request, &flag, MPI_STATUSES_IGNORE);
  while (way == TESTSOME && count != 1)
    MPI_Testsome(1, request, &count, &index, MPI_STATUSES_IGNORE);
  expect(*request == MPI_REQUEST_NULL, "request is complete");
}

// Everybody sends to the next rank, with the time of sending first.
void pass_on(Way way, int size, MPI_Comm comm)
{
  int me = 0, ranks = 1;
  MPI_Comm_rank(comm, &me);
  MPI_Comm_size(comm, &ranks);
  const int next = (me + 1) % ranks, before = (me + ranks - 1) % ranks;
  std::vector<double> out(size, me), in(size, -1.0);
  MPI_Request received, sent;
  if (way != RECV && way != SENDRECV)
    MPI_Irecv(in.data(), size, MPI_DOUBLE, before, way, comm, &received);
  out[0] = MPI_Wtime();
  if (way == SENDRECV)
    MPI_Sendrecv(out.data(), size, MPI_DOUBLE, next, way, in.data(), size, MPI_DOUBLE, before, way,
                 comm, MPI_STATUS_IGNORE);
  else
    MPI_Isend(out.data(), size, MPI_DOUBLE, next, way, comm, &sent);
  if (way == RECV)
    MPI_Recv(in.data(), size, MPI_DOUBLE, before, way, comm, MPI_STATUS_IGNORE);
  else if (way != SENDRECV)
    complete(way, &received);
  const double took = MPI_Wtime() - in[0];
  if (way != SENDRECV) MPI_Wait(&sent, MPI_STATUS_IGNORE);
  expect(took >= number("TALUS_LATENCY") + 8.0 * size / number("TALUS_BANDWIDTH"), "not too early");
  for (int k = 1; k < size; k++) expect(in[k] == before, "content");
}

// A receive for which no message comes ends when it is canceled, and the next message is not lost.
void give_up(MPI_Comm comm)
{
  double in = 0.0;
  MPI_Request request;
  MPI_Irecv(&in, 1, MPI_DOUBLE, MPI_ANY_SOURCE, NUM_WAYS, comm, &request);
  MPI_Cancel(&request);
  MPI_Waitall(1, &request, MPI_STATUSES_IGNORE);
  expect(request == MPI_REQUEST_NULL, "canceled request is complete");
}

void reduce(bool blocking, MPI_Comm comm)
{
  int ranks = 1, sum = 0, one = 1;
  MPI_Comm_size(comm, &ranks);
  const double begun = MPI_Wtime();
  if (blocking)
    MPI_Allreduce(&one, &sum, 1, MPI_INT, MPI_SUM, comm);
  else {
    MPI_Request request;
    MPI_Iallreduce(&one, &sum, 1, MPI_INT, MPI_SUM, comm, &request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
  }
  expect(MPI_Wtime() - begun >= number("TALUS_LATENCY"), "reduction not too early");
  expect(sum == ranks, "sum");
}

}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  MPI_Comm copy;
  MPI_Comm_dup(MPI_COMM_WORLD, &copy);
  for (MPI_Comm comm : {MPI_COMM_WORLD, copy})
    for (int round = 0; round < 3; round++) {
      give_up(comm);
      for (int way = 0; way < NUM_WAYS; way++)
        for (const int size : {2, 200, 20000}) pass_on(static_cast<Way>(way), size, comm);
      reduce(true, comm);
      reduce(false, comm);
    }
  MPI_Comm_free(&copy);
  int me = 0, all = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  MPI_Allreduce(&failures, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  if (me == 0 && all == 0) std::puts("model right");
  MPI_Finalize();
  return all != 0;
}
