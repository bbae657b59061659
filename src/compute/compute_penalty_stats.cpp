// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "compute/compute_penalty_stats.h"

#include "comm.h"
#include "error.h"
#include "update.h"

#include <algorithm>

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
    Compute(lmp, narg, arg), system(Talus::GranularSystem::of(lmp))
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

/* Energies cost time: pair style and bodies account for them only once this compute exists. What
   they have dissipated before is not of this compute. */

void ComputePenaltyStats::init()
{
  if (!system->has_pair_style())
    error->all(FLERR,
               "Compute penalty/stats requires one pair style gran/penalty, or one that is accelerated by "
               "the suffix talus: see 'Talus: styles of this run' in the log");
  system->keep_account();
  for (Talus::LargeBody *body : system->bodies()) body->keep_account();
  if (started) return;
  started = true;
  before = energies_here();
}

ComputePenaltyStats::Energies ComputePenaltyStats::energies_here() const
{
  Energies sum;
  const auto add = [&sum](const Talus::EnergyAccount &account) {
    sum.elastic += account.elastic();
    sum.normal += account.dissipated_normal();
    sum.tangential += account.dissipated_tangential();
    sum.resistance += account.dissipated_resistance();
  };
  add(system->energy_account());
  for (const Talus::LargeBody *body : system->bodies()) add(body->energy_account());
  return sum;
}

void ComputePenaltyStats::compute_vector()
{
  invoked_vector = update->ntimestep;
  const Energies now = energies_here();
  double mine[SIZE] = {};
  mine[ELASTIC] = now.elastic;
  mine[NORMAL] = now.normal - before.normal;
  mine[TANGENTIAL] = now.tangential - before.tangential;
  mine[RESISTANCE] = now.resistance - before.resistance;
  mine[CANDIDATES] = system->contacts().count_candidates();
  mine[CONTACTS] = system->contacts().count_contacts();
  double largest = system->contacts().deepest_contact().overlap_ratio;
  for (const Talus::LargeBody *body : system->bodies()) {
    mine[CONTACTS] += body->contacts_here();
    largest = std::max(largest, body->largest_overlap_ratio());
  }
  if (Talus::ProxyUpdates *proxies = system->proxy_updates()) {
    const Talus::ExchangeCounters &c = proxies->counters();
    mine[MESSAGES] = proxies->messages_per_exchange();
    mine[BYTES] = proxies->bytes_per_exchange();
    mine[EXCHANGE_TIME] = (c.pack_seconds + c.unpack_seconds) / comm->nprocs;
    mine[WAITING_TIME] = c.wait_seconds / comm->nprocs;
  }
  MPI_Allreduce(mine, vector, SIZE, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(&largest, &vector[OVERLAP], 1, MPI_DOUBLE, MPI_MAX, world);
}
