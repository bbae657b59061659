// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A model of a network, for LD_PRELOAD: ranks on one machine, but no message is delivered before
//   time of sending + TALUS_LATENCY + bytes / TALUS_BANDWIDTH     (seconds, bytes per second)
// and no reduction over all ranks before the last rank has begun it + TALUS_LATENCY * ceil(log2 P).
// Messages do not share a link. It is a model: what it leaves out makes real networks slower.
//
// The two numbers are read again at every barrier: LAMMPS has one at the start of each run, and
// `shell putenv` to set them.
//
// Through the profiling interface of MPI: each message is preceded by a small one with the time of
// sending, on a duplicate of the communicator. All ranks must share one clock. Only what LAMMPS and
// Talus use in their time steps is modeled: point to point, (i)allreduce.

#include "preloaded_sends.h"

#include <cstdlib>
#include <map>
#include <vector>

namespace {

struct Incoming {
  MPI_Comm shadow;          // MPI_COMM_NULL: a reduction
  MPI_Request companion;    // of a reduction: the latest time of beginning
  double times[2];          // of a reduction: mine, everybody's
  double due;               // negative: not known yet
};

double latency = 0.0, seconds_per_byte = 0.0;
std::map<MPI_Comm, MPI_Comm> shadows;
std::map<MPI_Request, Incoming *> incoming;

double number(const char *name)
{
  const char *text = std::getenv(name);
  return text ? std::atof(text) : 0.0;
}

MPI_Comm shadow_of(MPI_Comm comm)
{
  const auto found = shadows.find(comm);
  return found == shadows.end() ? MPI_COMM_NULL : found->second;
}

void add_shadow(MPI_Comm comm)
{
  PMPI_Comm_dup(comm, &shadows[comm]);
}

void read_settings()
{
  latency = number("TALUS_LATENCY");
  const double bandwidth = number("TALUS_BANDWIDTH");
  seconds_per_byte = bandwidth > 0.0 ? 1.0 / bandwidth : 0.0;
}

void start()
{
  read_settings();
  add_shadow(MPI_COMM_WORLD);
}

double reduction_time(MPI_Comm comm)
{
  int ranks = 1, rounds = 0;
  PMPI_Comm_size(comm, &ranks);
  while (1 << rounds < ranks) rounds++;
  return latency * rounds;
}

double due_time(MPI_Comm shadow, const MPI_Status &status)
{
  double sent = 0.0;
  int bytes = 0;
  PMPI_Recv(&sent, 1, MPI_DOUBLE, status.MPI_SOURCE, status.MPI_TAG, shadow, MPI_STATUS_IGNORE);
  PMPI_Get_count(&status, MPI_BYTE, &bytes);
  return sent + latency + seconds_per_byte * bytes;
}

// Waiting ranks keep their core: given away, it comes back milliseconds later if anyone wants it.
void wait_until(double due)
{
  while (PMPI_Wtime() < due) {
  }
}

// Whether a request may be seen as complete. Does not complete it.
bool delivered(MPI_Request request)
{
  int there = 0;
  MPI_Status status;
  PMPI_Request_get_status(request, &there, &status);
  if (!there) return false;
  const auto found = incoming.find(request);
  if (found == incoming.end()) return true;
  Incoming &message = *found->second;
  if (message.due < 0.0) {
    if (message.shadow == MPI_COMM_NULL) {
      int ended = 0;
      PMPI_Test(&message.companion, &ended, MPI_STATUS_IGNORE);
      if (!ended) return false;
      message.due += message.times[1] + 1e9;    // it held the time of the reduction, less 1e9
    } else
      message.due = due_time(message.shadow, status);
  }
  return PMPI_Wtime() >= message.due;
}

int complete(MPI_Request *request, MPI_Status *status)
{
  const auto found = incoming.find(*request);
  if (found != incoming.end()) {
    delete found->second;
    incoming.erase(found);
  }
  return PMPI_Wait(request, status);
}

MPI_Status *entry(MPI_Status *statuses, int k)
{
  return statuses == MPI_STATUSES_IGNORE ? MPI_STATUS_IGNORE : statuses + k;
}

}    // namespace

// The small message is on its way before the one it belongs to.
static void sees_send(int, MPI_Datatype, int to, int tag, MPI_Comm comm)
{
  const MPI_Comm shadow = shadow_of(comm);
  if (shadow == MPI_COMM_NULL || to == MPI_PROC_NULL) return;
  const double now = PMPI_Wtime();
  PMPI_Send(&now, 1, MPI_DOUBLE, to, tag, shadow);
}

EXPORTED int MPI_Init(int *argc, char ***argv)
{
  const int result = PMPI_Init(argc, argv);
  start();
  return result;
}

EXPORTED int MPI_Init_thread(int *argc, char ***argv, int required, int *provided)
{
  const int result = PMPI_Init_thread(argc, argv, required, provided);
  start();
  return result;
}

EXPORTED int MPI_Barrier(MPI_Comm comm)
{
  read_settings();
  return PMPI_Barrier(comm);
}

EXPORTED int MPI_Comm_dup(MPI_Comm comm, MPI_Comm *copy)
{
  const int result = PMPI_Comm_dup(comm, copy);
  add_shadow(*copy);
  return result;
}

EXPORTED int MPI_Comm_free(MPI_Comm *comm)
{
  const auto found = shadows.find(*comm);
  if (found != shadows.end()) {
    PMPI_Comm_free(&found->second);
    shadows.erase(found);
  }
  return PMPI_Comm_free(comm);
}

EXPORTED int MPI_Irecv(void *buffer, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
                       MPI_Request *request)
{
  const int result = PMPI_Irecv(buffer, count, type, from, tag, comm, request);
  const MPI_Comm shadow = shadow_of(comm);
  if (shadow != MPI_COMM_NULL && from != MPI_PROC_NULL)
    incoming[*request] = new Incoming{shadow, MPI_REQUEST_NULL, {0.0, 0.0}, -1.0};
  return result;
}

// A receive that is canceled waits for nothing.
EXPORTED int MPI_Cancel(MPI_Request *request)
{
  const auto found = incoming.find(*request);
  if (found != incoming.end()) {
    delete found->second;
    incoming.erase(found);
  }
  return PMPI_Cancel(request);
}

EXPORTED int MPI_Recv(void *buffer, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
                      MPI_Status *status)
{
  MPI_Status own;
  const int result = PMPI_Recv(buffer, count, type, from, tag, comm, &own);
  const MPI_Comm shadow = shadow_of(comm);
  if (shadow != MPI_COMM_NULL && own.MPI_SOURCE != MPI_PROC_NULL) wait_until(due_time(shadow, own));
  if (status != MPI_STATUS_IGNORE) *status = own;
  return result;
}

EXPORTED int MPI_Wait(MPI_Request *request, MPI_Status *status)
{
  if (*request != MPI_REQUEST_NULL)
    while (!delivered(*request)) {
    }
  return complete(request, status);
}

EXPORTED int MPI_Waitall(int count, MPI_Request *requests, MPI_Status *statuses)
{
  for (int k = 0; k < count; k++) MPI_Wait(&requests[k], entry(statuses, k));
  return MPI_SUCCESS;
}

EXPORTED int MPI_Waitany(int count, MPI_Request *requests, int *index, MPI_Status *status)
{
  for (;;) {
    bool active = false;
    for (int k = 0; k < count; k++) {
      if (requests[k] == MPI_REQUEST_NULL) continue;
      active = true;
      if (!delivered(requests[k])) continue;
      *index = k;
      return complete(&requests[k], status);
    }
    if (!active) break;
  }
  *index = MPI_UNDEFINED;
  return MPI_SUCCESS;
}

EXPORTED int MPI_Test(MPI_Request *request, int *flag, MPI_Status *status)
{
  *flag = *request == MPI_REQUEST_NULL || delivered(*request);
  return *flag ? complete(request, status) : MPI_SUCCESS;
}

EXPORTED int MPI_Testall(int count, MPI_Request *requests, int *flag, MPI_Status *statuses)
{
  *flag = 1;
  for (int k = 0; k < count; k++)
    if (requests[k] != MPI_REQUEST_NULL && !delivered(requests[k])) *flag = 0;
  return *flag ? MPI_Waitall(count, requests, statuses) : MPI_SUCCESS;
}

EXPORTED int MPI_Testsome(int count, MPI_Request *requests, int *ended, int *indices,
                          MPI_Status *statuses)
{
  bool active = false;
  int n = 0;
  for (int k = 0; k < count; k++) {
    if (requests[k] == MPI_REQUEST_NULL) continue;
    active = true;
    if (!delivered(requests[k])) continue;
    complete(&requests[k], entry(statuses, n));
    indices[n++] = k;
  }
  *ended = active ? n : MPI_UNDEFINED;
  return MPI_SUCCESS;
}

EXPORTED int MPI_Sendrecv(const void *out, int out_count, MPI_Datatype out_type, int to,
                          int out_tag, void *in, int in_count, MPI_Datatype in_type, int from,
                          int in_tag, MPI_Comm comm, MPI_Status *status)
{
  MPI_Request requests[2];
  MPI_Irecv(in, in_count, in_type, from, in_tag, comm, &requests[0]);
  MPI_Isend(out, out_count, out_type, to, out_tag, comm, &requests[1]);
  MPI_Wait(&requests[0], status);
  return MPI_Wait(&requests[1], MPI_STATUS_IGNORE);
}

EXPORTED int MPI_Allreduce(const void *in, void *out, int count, MPI_Datatype type, MPI_Op op,
                           MPI_Comm comm)
{
  const double begun = PMPI_Wtime();
  double last = begun;
  const int result = PMPI_Allreduce(in, out, count, type, op, comm);
  PMPI_Allreduce(&begun, &last, 1, MPI_DOUBLE, MPI_MAX, comm);
  wait_until(last + reduction_time(comm));
  return result;
}

EXPORTED int MPI_Iallreduce(const void *in, void *out, int count, MPI_Datatype type, MPI_Op op,
                            MPI_Comm comm, MPI_Request *request)
{
  const int result = PMPI_Iallreduce(in, out, count, type, op, comm, request);
  auto *reduction = new Incoming{
      MPI_COMM_NULL, MPI_REQUEST_NULL, {PMPI_Wtime(), 0.0}, reduction_time(comm) - 1e9};
  PMPI_Iallreduce(&reduction->times[0], &reduction->times[1], 1, MPI_DOUBLE, MPI_MAX, comm,
                  &reduction->companion);
  incoming[*request] = reduction;
  return result;
}
