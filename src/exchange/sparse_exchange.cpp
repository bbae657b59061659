// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "exchange/sparse_exchange.h"

#include "exchange/large_messages.h"

namespace Talus {

SparseExchange::SparseExchange(MPI_Comm parent)
{
  MPI_Comm_dup(parent, &comm);
}

SparseExchange::~SparseExchange()
{
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (!finalized) MPI_Comm_free(&comm);
}

bool SparseExchange::take_one(const std::function<void(const std::vector<double> &)> &take)
{
  int there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, tag, comm, &there, &status);
  if (!there) return false;
  std::vector<double> message(doubles_of(status));
  const LargeMessage whole(message.size());
  MPI_Recv(message.data(), whole.count(), whole.type(), status.MPI_SOURCE, tag, comm,
           MPI_STATUS_IGNORE);
  take(message);
  return true;
}

int SparseExchange::run(const std::map<int, std::vector<double>> &messages, int number,
                        const std::function<void(const std::vector<double> &)> &take)
{
  std::vector<MPI_Request> sends;
  sends.reserve(messages.size());
  for (const auto &[rank, message] : messages) {
    const LargeMessage whole(message.size());    // its type may go before the message has gone
    MPI_Issend(message.data(), whole.count(), whole.type(), rank, tag, comm, &sends.emplace_back());
  }

  int largest = number, all_sent = 0, over = 0;
  MPI_Request reduction = MPI_REQUEST_NULL;
  while (!over) {
    while (take_one(take)) {
    }
    if (all_sent) {
      MPI_Test(&reduction, &over, MPI_STATUS_IGNORE);
      continue;
    }
    MPI_Testall(static_cast<int>(sends.size()), sends.data(), &all_sent, MPI_STATUSES_IGNORE);
    if (all_sent) MPI_Iallreduce(&number, &largest, 1, MPI_INT, MPI_MAX, comm, &reduction);
  }
  tag = 1 - tag;
  return largest;
}

}    // namespace Talus
