// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "compute/compute_penalty_stats.h"

#include "system/shapes/shaped_particles.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
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
  BOND_ELASTIC,
  BOND_DAMPING,
  BOND_BREAKING,
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
  system->account().add_observer(this);
}

ComputePenaltyStats::~ComputePenaltyStats()
{
  system->account().drop_observer(this);
  delete[] vector;
}

void ComputePenaltyStats::init()
{
  if (!system->pair_style().is_there())
    error->all(FLERR,
               "Compute penalty/stats requires one pair style gran/penalty, or one that is "
               "accelerated by the suffix talus: see 'Talus: styles of this run' in the log");
}

/* The contacts have just been found. */

void ComputePenaltyStats::setup()
{
  if (started) return;
  started = true;
  before = dissipated(system->account().work(), sum_contacts().stored);
  bonds_before = energies_of_bonds();
}

Talus::BondEnergies ComputePenaltyStats::energies_of_bonds() const
{
  const Talus::BondAccount *bonds = Talus::BondAccount::of(force->bond);
  return bonds ? bonds->energies(system->account().counted_of_last_step()) : Talus::BondEnergies{};
}

ComputePenaltyStats::ContactSums ComputePenaltyStats::sum_contacts() const
{
  ContactSums found;
  system->contacts().for_each(Talus::ContactData::ENERGIES, [&](const Talus::ContactReport &one) {
    found.stored += one.share * one.stored;
    found.contacts += one.share;
    if (one.body < 0) return;
    found.deepest_in_body = std::max(found.deepest_in_body, one.overlap / radius_of(one.i));
  });
  return found;
}

/* Of a shape that of the largest sphere inside, to which its warnings refer as well. */

double ComputePenaltyStats::radius_of(int i) const
{
  const Talus::ShapedParticles *shapes = system->shapes();
  const int type = atom->type[i];
  return shapes && shapes->is_shaped(type) ? shapes->table().of(type)->shape().inscribed_radius()
                                           : atom->radius[i];
}

void ComputePenaltyStats::compute_vector()
{
  invoked_vector = update->ntimestep;
  double mine[SIZE] = {};
  const ContactSums found = sum_contacts();
  const Talus::EnergyByCause lost = dissipated(system->account().work(), found.stored) - before;
  mine[ELASTIC] = found.stored.total();
  mine[NORMAL] = lost.normal;
  mine[TANGENTIAL] = lost.tangential;
  mine[RESISTANCE] = lost.resistance;
  const Talus::BondEnergies of_bonds = energies_of_bonds(), since = of_bonds - bonds_before;
  mine[BOND_ELASTIC] = of_bonds.stored;
  mine[BOND_DAMPING] = since.damped;
  mine[BOND_BREAKING] = since.broken;
  mine[CANDIDATES] = system->contacts().count_candidates();
  mine[CONTACTS] = found.contacts;
  double largest = std::max(system->contacts().deepest().overlap_ratio, found.deepest_in_body);
  if (Talus::DirectExchange *proxies = system->exchange().direct()) {
    const Talus::ExchangeCounters &c = proxies->counters();
    mine[MESSAGES] = proxies->messages_per_exchange();
    mine[BYTES] = proxies->bytes_per_exchange();
    mine[EXCHANGE_TIME] = (c.pack_seconds + c.unpack_seconds) / comm->nprocs;
    mine[WAITING_TIME] = c.wait_seconds / comm->nprocs;
  }
  MPI_Allreduce(mine, vector, SIZE, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(&largest, &vector[OVERLAP], 1, MPI_DOUBLE, MPI_MAX, world);
}
