// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "compute/compute_penalty_stats.h"

#include "comm/comm_proxy.h"
#include "fix/fix_large_body.h"
#include "pair/pair_gran_penalty.h"

#include "error.h"
#include "force.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {
enum {
  CANDIDATES,
  CONTACTS,
  OVERLAP,
  ELASTIC,
  NORMAL,
  TANGENTIAL,
  RESISTANCE,
  MESSAGES,
  BYTES,
  EXCHANGE_TIME,
  WAITING_TIME,
  SIZE
};
}

ComputePenaltyStats::ComputePenaltyStats(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg)
{
  if (narg > 3) error->all(FLERR, 3, "compute penalty/stats: surplus word '{}'", arg[3]);
  if (igroup)
    error->all(FLERR, 1, "compute penalty/stats: expected group all instead of '{}'", arg[1]);
  vector_flag = 1;
  size_vector = SIZE;
  extvector = 0;
  vector = new double[size_vector]();
}

ComputePenaltyStats::~ComputePenaltyStats()
{
  delete[] vector;
}

/* Energies cost time: pair style and bodies account for them only once this compute exists. */

void ComputePenaltyStats::init()
{
  pair = dynamic_cast<PairGranPenalty *>(force->pair_match("gran/penalty", 1, 0));
  if (!pair) error->all(FLERR, "Compute penalty/stats requires one pair style gran/penalty");
  pair->keep_account();
  for (const auto &ifix : modify->get_fix_by_style("^large/body$"))
    if (auto *body = dynamic_cast<FixLargeBody *>(ifix)) body->keep_account();
}

void ComputePenaltyStats::compute_vector()
{
  invoked_vector = update->ntimestep;
  double mine[SIZE] = {};
  const auto add = [&mine](const Talus::EnergyAccount &account) {
    mine[ELASTIC] += account.elastic();
    mine[NORMAL] += account.dissipated_normal();
    mine[TANGENTIAL] += account.dissipated_tangential();
    mine[RESISTANCE] += account.dissipated_resistance();
  };

  mine[CANDIDATES] = pair->contacts().count_candidates();
  mine[CONTACTS] = pair->contacts().count_contacts();
  add(pair->energy_account());
  for (const auto &ifix : modify->get_fix_by_style("^large/body$")) {
    const auto *body = dynamic_cast<FixLargeBody *>(ifix);
    if (!body) continue;
    mine[CONTACTS] += body->contacts_here();
    add(body->energy_account());
  }
  if (auto *proxy = dynamic_cast<CommProxy *>(comm)) {
    const Talus::ExchangeCounters &c = proxy->counters();
    mine[MESSAGES] = proxy->messages_per_exchange();
    mine[BYTES] = proxy->bytes_per_exchange();
    mine[EXCHANGE_TIME] = (c.pack_seconds + c.unpack_seconds) / comm->nprocs;
    mine[WAITING_TIME] = c.wait_seconds / comm->nprocs;
  }
  MPI_Allreduce(mine, vector, SIZE, MPI_DOUBLE, MPI_SUM, world);
  const double largest = pair->contacts().largest_overlap_ratio();
  MPI_Allreduce(&largest, &vector[OVERLAP], 1, MPI_DOUBLE, MPI_MAX, world);
}
