// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Sends seen by a library for LD_PRELOAD, through the profiling interface of MPI. The library that
// includes this, in one file only, defines sees_send(), which is called before each of them;
// MPI_Sendrecv() is left to it.

#ifndef TALUS_BENCH_EXCHANGE_PRELOADED_SENDS_H
#define TALUS_BENCH_EXCHANGE_PRELOADED_SENDS_H

#include <mpi.h>

#define EXPORTED extern "C" __attribute__((visibility("default")))

static void sees_send(int count, MPI_Datatype type, int to, int tag, MPI_Comm comm);

EXPORTED int MPI_Send(const void *buffer, int count, MPI_Datatype type, int to, int tag,
                      MPI_Comm comm)
{
  sees_send(count, type, to, tag, comm);
  return PMPI_Send(buffer, count, type, to, tag, comm);
}

EXPORTED int MPI_Rsend(const void *buffer, int count, MPI_Datatype type, int to, int tag,
                       MPI_Comm comm)
{
  sees_send(count, type, to, tag, comm);
  return PMPI_Rsend(buffer, count, type, to, tag, comm);
}

EXPORTED int MPI_Issend(const void *buffer, int count, MPI_Datatype type, int to, int tag,
                        MPI_Comm comm, MPI_Request *request)
{
  sees_send(count, type, to, tag, comm);
  return PMPI_Issend(buffer, count, type, to, tag, comm, request);
}

EXPORTED int MPI_Isend(const void *buffer, int count, MPI_Datatype type, int to, int tag,
                       MPI_Comm comm, MPI_Request *request)
{
  sees_send(count, type, to, tag, comm);
  return PMPI_Isend(buffer, count, type, to, tag, comm, request);
}

#endif
