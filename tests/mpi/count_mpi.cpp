// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A library for LD_PRELOAD that counts what a program sends and where it waits for all ranks,
// through the profiling interface of MPI. Independent of the counters of Talus.
//
// At MPI_Finalize each rank writes the file $TALUS_COUNTS.RANK:
//   collectives N      blocking ones: barrier, broadcast, reductions, gathers, all-to-all
//   started N          non-blocking ones
//   beside N           tests for messages in a parallel region of several threads
//   gathered N         bytes that it has given to MPI_Allgatherv
//   to RANK messages N bytes N      point to point, per rank of MPI_COMM_WORLD
// A program that needs no numbering of its own in duplicated communicators is assumed. If
// $TALUS_THREAD_LEVEL is given, MPI_Query_thread() answers with that number.

#include "../../bench/exchange/preloaded_sends.h"

#include <omp.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

namespace {

struct Sent {
  long messages = 0, bytes = 0;
};
std::map<int, Sent> sent;
long collectives = 0, started = 0, beside = 0, all_gathered = 0;

void write_counts()
{
  const char *stem = std::getenv("TALUS_COUNTS");
  if (!stem) return;
  int me = 0;
  PMPI_Comm_rank(MPI_COMM_WORLD, &me);
  std::FILE *file = std::fopen((std::string(stem) + "." + std::to_string(me)).c_str(), "w");
  if (!file) return;
  std::fprintf(file, "collectives %ld\nstarted %ld\nbeside %ld\ngathered %ld\n", collectives,
               started, beside, all_gathered);
  for (const auto &[rank, s] : sent)
    std::fprintf(file, "to %d messages %ld bytes %ld\n", rank, s.messages, s.bytes);
  std::fclose(file);
}

}    // namespace

static void sees_send(int count, MPI_Datatype type, int to, int, MPI_Comm)
{
  if (to == MPI_PROC_NULL) return;
  int size = 0;
  PMPI_Type_size(type, &size);
  sent[to].messages++;
  sent[to].bytes += static_cast<long>(count) * size;
}

EXPORTED int MPI_Finalize()
{
  write_counts();
  return PMPI_Finalize();
}

EXPORTED int MPI_Sendrecv(const void *out, int out_count, MPI_Datatype out_type, int to,
                          int out_tag, void *in, int in_count, MPI_Datatype in_type, int from,
                          int in_tag, MPI_Comm comm, MPI_Status *status)
{
  sees_send(out_count, out_type, to, out_tag, comm);
  return PMPI_Sendrecv(out, out_count, out_type, to, out_tag, in, in_count, in_type, from, in_tag,
                       comm, status);
}

EXPORTED int MPI_Barrier(MPI_Comm comm)
{
  collectives++;
  return PMPI_Barrier(comm);
}

EXPORTED int MPI_Bcast(void *buffer, int count, MPI_Datatype type, int root, MPI_Comm comm)
{
  collectives++;
  return PMPI_Bcast(buffer, count, type, root, comm);
}

EXPORTED int MPI_Reduce(const void *in, void *out, int count, MPI_Datatype type, MPI_Op op,
                        int root, MPI_Comm comm)
{
  collectives++;
  return PMPI_Reduce(in, out, count, type, op, root, comm);
}

EXPORTED int MPI_Allreduce(const void *in, void *out, int count, MPI_Datatype type, MPI_Op op,
                           MPI_Comm comm)
{
  collectives++;
  return PMPI_Allreduce(in, out, count, type, op, comm);
}

EXPORTED int MPI_Scan(const void *in, void *out, int count, MPI_Datatype type, MPI_Op op,
                      MPI_Comm comm)
{
  collectives++;
  return PMPI_Scan(in, out, count, type, op, comm);
}

EXPORTED int MPI_Gather(const void *in, int in_count, MPI_Datatype in_type, void *out,
                        int out_count, MPI_Datatype out_type, int root, MPI_Comm comm)
{
  collectives++;
  return PMPI_Gather(in, in_count, in_type, out, out_count, out_type, root, comm);
}

EXPORTED int MPI_Allgather(const void *in, int in_count, MPI_Datatype in_type, void *out,
                           int out_count, MPI_Datatype out_type, MPI_Comm comm)
{
  collectives++;
  return PMPI_Allgather(in, in_count, in_type, out, out_count, out_type, comm);
}

EXPORTED int MPI_Allgatherv(const void *in, int in_count, MPI_Datatype in_type, void *out,
                            const int *out_counts, const int *places, MPI_Datatype out_type,
                            MPI_Comm comm)
{
  int size = 0;
  PMPI_Type_size(in_type, &size);
  all_gathered += static_cast<long>(in_count) * size;
  return PMPI_Allgatherv(in, in_count, in_type, out, out_counts, places, out_type, comm);
}

EXPORTED int MPI_Alltoall(const void *in, int in_count, MPI_Datatype in_type, void *out,
                          int out_count, MPI_Datatype out_type, MPI_Comm comm)
{
  collectives++;
  return PMPI_Alltoall(in, in_count, in_type, out, out_count, out_type, comm);
}

EXPORTED int MPI_Reduce_scatter(const void *in, void *out, const int *counts, MPI_Datatype type,
                                MPI_Op op, MPI_Comm comm)
{
  collectives++;
  return PMPI_Reduce_scatter(in, out, counts, type, op, comm);
}

EXPORTED int MPI_Iallreduce(const void *in, void *out, int count, MPI_Datatype type, MPI_Op op,
                            MPI_Comm comm, MPI_Request *request)
{
  started++;
  return PMPI_Iallreduce(in, out, count, type, op, comm, request);
}

EXPORTED int MPI_Ibarrier(MPI_Comm comm, MPI_Request *request)
{
  started++;
  return PMPI_Ibarrier(comm, request);
}

EXPORTED int MPI_Testsome(int count, MPI_Request *requests, int *ended, int *which,
                          MPI_Status *statuses)
{
  beside += omp_in_parallel();
  return PMPI_Testsome(count, requests, ended, which, statuses);
}

EXPORTED int MPI_Query_thread(int *level)
{
  const int result = PMPI_Query_thread(level);
  if (const char *wanted = std::getenv("TALUS_THREAD_LEVEL")) *level = std::atoi(wanted);
  return result;
}
