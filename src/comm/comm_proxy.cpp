// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "comm/comm_proxy.h"

#include "exchange/exchange_tags.h"
#include "system/system_shapes.h"

#include "atom.h"
#include "atom_vec.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "pair.h"

#include <algorithm>
#include <set>
#include <stdexcept>

using namespace LAMMPS_NS;
using namespace Talus;

CommProxy::CommProxy(LAMMPS *lmp, Comm *old) :
    CommBrick(lmp, old), system(GranularSystem::of(lmp)), transfer(world), atom_vec_packer(lmp),
    sphere_packer(lmp)
{
  system->exchange().is_made(this, this);
}

CommProxy::~CommProxy()
{
  system->exchange().is_deleted(this);
}

/* ---------------------------------------------------------------------- */

void CommProxy::init()
{
  transfer.abandon();    // left by an error; particles may have changed since
  CommBrick::init();
  look_for_unsupported();
  own_packing = sphere_packer.applies(ghost_velocity);
  atom_vec_packer.set(size_forward, ghost_velocity);
}

/* Not in the command alone: comm_modify and fix deform may come later. */

void CommProxy::look_for_unsupported()
{
  const std::string problem = system->exchange().unsupported(true);
  fell_back = !problem.empty();
  if (fell_back && system->exchange().choice() == ExchangeSwitch::Choice::YES)
    error->all(FLERR, "comm_proxy: {} or 'comm_proxy no'", problem);
}

void CommProxy::setup()
{
  finish();
  CommBrick::setup();
}

void CommProxy::set_proc_grid(int outflag)
{
  transfer.abandon();
  have_plan = false;
  CommBrick::set_proc_grid(outflag);
}

void CommProxy::exchange()
{
  transfer.abandon();    // the particles are about to be renumbered
  have_plan = false;
  CommBrick::exchange();
}

void CommProxy::borders()
{
  transfer.abandon();
  have_plan = false;
  CommBrick::borders();
  if (fell_back) return;
  derive_plan();
  have_plan = true;
  if (checks) check_owners();
}

/* ---------------------------------------------------------------------- */

void CommProxy::forward_comm(int dummy)
{
  finish();
  if (!have_plan) return CommBrick::forward_comm(dummy);
  begin(nullptr);
  finish();
}

void CommProxy::begin(ProxyPacker *packer)
{
  if (!have_plan) error->all(FLERR, "comm_proxy: no plan yet for an exchange (internal error)");
  finish();
  transfer.begin(choose_packer(packer));
  if (checks) poison_proxies();
}

void CommProxy::finish()
{
  if (!transfer.pending()) return;
  transfer.finish();
  if (checks) check_states();
}

ProxyPacker &CommProxy::choose_packer(ProxyPacker *given)
{
  ProxyPacker *packer = given;
  if (!packer && own_packing) packer = &sphere_packer;
  if (!packer) packer = &atom_vec_packer;
  if (!plan_has_orientations || !system->shapes()) return *packer;
  with_orientations.set(*packer, system->shapes()->orientations());
  return with_orientations;
}

/* Of the states in the arrays of LAMMPS. */

int CommProxy::stride() const
{
  const int of_state = own_packing ? sphere_packer.stride() : atom_vec_packer.stride();
  return of_state + (plan_has_orientations ? PackerWithRows::columns : 0);
}

/* ---------------------------------------------------------------------- */

/* A fix shape/gran that comes later ends the run with an error; the messages before must fit. */

void CommProxy::derive_plan()
{
  plan_has_orientations = system->shapes() != nullptr;
  try {
    transfer.make_plan(atom->nlocal, trace_origins(), possible_neighbors(), largest_stride());
  } catch (const std::length_error &problem) {
    error->one(FLERR, "comm_proxy: {}", problem.what());
  } catch (const std::invalid_argument &problem) {
    error->one(FLERR, "comm_proxy: {} (internal error)", problem.what());
  }
}

/* Of what this object and the run style send with one plan: the states of particles, and their
   identity in a check. */

int CommProxy::largest_stride() const
{
  constexpr int identity = 2;
  const int largest = std::max({sphere_packer.stride(), atom_vec_packer.stride(), identity});
  return largest + (plan_has_orientations ? PackerWithRows::columns : 0);
}

/* Runs once through LAMMPS' swaps, with the identity of particles instead of their state: what
   a rank passes on is known to belong to someone else. */

std::vector<ProxyOrigin> CommProxy::trace_origins()
{
  std::vector<ProxyOrigin> all(atom->nlocal + atom->nghost), buffer;
  for (int i = 0; i < atom->nlocal; i++) all[i] = {me, i, {0, 0, 0}};

  constexpr int words = sizeof(ProxyOrigin) / sizeof(int);
  for (int swap = 0; swap < nswap; swap++) {
    buffer.resize(sendnum[swap]);
    for (int k = 0; k < sendnum[swap]; k++) {
      buffer[k] = all[sendlist[swap][k]];
      if (pbc_flag[swap])
        for (int d = 0; d < 3; d++) buffer[k].shift[d] += pbc[swap][d];
    }
    ProxyOrigin *to = all.data() + firstrecv[swap];
    if (sendproc[swap] == me)
      std::copy(buffer.begin(), buffer.end(), to);
    else
      MPI_Sendrecv(buffer.data(), words * sendnum[swap], MPI_INT, sendproc[swap], TAG_ORIGIN, to,
                   words * recvnum[swap], MPI_INT, recvproc[swap], TAG_ORIGIN,
                   transfer.communicator(), MPI_STATUS_IGNORE);
  }
  all.erase(all.begin(), all.begin() + atom->nlocal);
  return all;
}

/* All ranks within the reach of the swaps. The reach is the same for all ranks, so this is
   symmetric. */

std::vector<int> CommProxy::possible_neighbors() const
{
  std::vector<int> along[3];
  for (int d = 0; d < 3; d++) {
    std::set<int> places;
    for (int step = -maxneed[d]; step <= maxneed[d]; step++) {
      const int n = procgrid[d], place = myloc[d] + step;
      if (domain->periodicity[d])
        places.insert((place % n + n) % n);
      else if (place >= 0 && place < n)
        places.insert(place);
    }
    along[d].assign(places.begin(), places.end());
  }
  std::set<int> ranks;
  for (const int i : along[0])
    for (const int j : along[1])
      for (const int k : along[2]) ranks.insert(grid2proc[i][j][k]);
  ranks.erase(me);
  return {ranks.begin(), ranks.end()};
}

/* ---------------------------------------------------------------------- */

double CommProxy::messages_per_exchange() const
{
  double count = 0.0;
  for (const ExchangeNeighbor &n : plan().neighbors()) count += n.send_count() > 0;
  return count;
}

double CommProxy::bytes_per_exchange() const
{
  return transfer.bytes_per_exchange(stride());
}

std::string CommProxy::describe_message() const
{
  const auto bytes = sizeof(double) * stride();
  const char *more = plan_has_orientations ? ", orientation" : "";
  if (own_packing) return fmt::format("{} bytes per particle: x, v, omega{}", bytes, more);
  return fmt::format("{} bytes per particle, packed by LAMMPS (atom style {}){}", bytes,
                     atom->atom_style, more);
}

double CommProxy::memory_usage()
{
  return CommBrick::memory_usage() + 2.0 * bytes_per_exchange();
}

/* ---------------------------------------------------------------------- */

void CommProxy::reverse_comm()
{
  finish();
  CommBrick::reverse_comm();
}

void CommProxy::forward_comm(Pair *pair, int size)
{
  finish();
  CommBrick::forward_comm(pair, size);
}

void CommProxy::reverse_comm(Pair *pair, int size)
{
  finish();
  CommBrick::reverse_comm(pair, size);
}

void CommProxy::forward_comm(Bond *bond, int size)
{
  finish();
  CommBrick::forward_comm(bond, size);
}

void CommProxy::reverse_comm(Bond *bond, int size)
{
  finish();
  CommBrick::reverse_comm(bond, size);
}

void CommProxy::forward_comm(Fix *fix, int size)
{
  finish();
  CommBrick::forward_comm(fix, size);
}

void CommProxy::reverse_comm(Fix *fix, int size)
{
  finish();
  CommBrick::reverse_comm(fix, size);
}

void CommProxy::reverse_comm_variable(Fix *fix)
{
  finish();
  CommBrick::reverse_comm_variable(fix);
}

void CommProxy::forward_comm(Compute *compute, int size)
{
  finish();
  CommBrick::forward_comm(compute, size);
}

void CommProxy::reverse_comm(Compute *compute, int size)
{
  finish();
  CommBrick::reverse_comm(compute, size);
}

void CommProxy::forward_comm(Dump *dump, int size)
{
  finish();
  CommBrick::forward_comm(dump, size);
}

void CommProxy::reverse_comm(Dump *dump, int size)
{
  finish();
  CommBrick::reverse_comm(dump, size);
}

void CommProxy::forward_comm_array(int columns, double **array)
{
  finish();
  CommBrick::forward_comm_array(columns, array);
}
