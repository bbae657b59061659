// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "comm/comm_reach.h"

#include "exchange/exchange_plan.h"
#include "exchange/exchange_tags.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "atom_vec.h"
#include "domain.h"
#include "error.h"
#include "neighbor.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

/// A place on a side of the grid of domains, and by how many periods it is beyond the box.
struct Place {
  int index, periods;
};

Place wrapped(int place, int places)
{
  const int index = (place % places + places) % places;
  return {index, (place - index) / places};
}

}    // namespace

void CommReach::setup()
{
  CommBrick::setup();
  by_reach =
      is_few_domains() && GranularSystem::of(lmp)->exchange().needs_beyond_contacts().empty();
  if (!by_reach) return;
  const int around = domains().size();
  if (2 * around > maxswap) grow_swap(2 * around);
}

/* Each has a swap in every exchange, whether it has proxies or not. */

bool CommReach::is_few_domains() const
{
  constexpr int most = 3;
  return std::max({maxneed[0], maxneed[1], maxneed[2]}) <= most;
}

/* As far as LAMMPS' stages reach. What is beyond the end of the box belongs to the last domain. */

DomainGrid CommReach::domains() const
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double *const splits[3] = {xsplit, ysplit, zsplit};
  DomainGrid grid;
  for (int d = 0; d < 3; d++)
    for (int step = -maxneed[d]; step <= maxneed[d]; step++) {
      const auto [index, periods] = wrapped(myloc[d] + step, procgrid[d]);
      const bool repeats = domain->periodicity[d] != 0;
      const double shift = periods * domain->prd[d];
      const auto face = [&](int n) {
        return domain->boxlo[d] + domain->prd[d] * splits[d][n] + shift;
      };
      const bool first = index == 0 && !repeats, last = index + 1 == procgrid[d] && !repeats;
      grid.along[d].push_back({first ? -infinity : face(index), last ? infinity : face(index + 1),
                               periods == 0 || repeats});
    }
  return grid;
}

ProxyReach CommReach::reach()
{
  const auto system = GranularSystem::of(lmp);
  const double unit = system->range().radii().largest(),
               skin = neighbor->skin + system->range().largest_pulloff_distance();
  ProxyReach::ClassRadii classes = ProxyReach::classes_of(atom->nlocal, atom->radius, unit);
  MPI_Allreduce(MPI_IN_PLACE, classes.data(), ProxyReach::num_classes, MPI_DOUBLE, MPI_MAX, world);
  return {domains(), classes, unit, skin};
}

void CommReach::borders()
{
  if (!by_reach) return CommBrick::borders();
  if (mode == Comm::MULTI) neighbor->build_collection(0);
  nswap = 0;
  try {
    choose_proxies();
  } catch (const std::length_error &problem) {
    error->one(FLERR, "comm_proxy: {}", problem.what());
  }
  make_buffers_fit();
  if (map_style != Atom::MAP_NONE) atom->map_set();
}

void CommReach::choose_proxies()
{
  const ProxyReach choice = reach();
  add_swaps(choice.in_shells(atom->nlocal, atom->nlocal ? atom->x[0] : nullptr, atom->radius));
  if (choice.has_larger_partners())
    add_swaps(choice.beyond_shells(atom->nlocal, atom->nlocal + atom->nghost ? atom->x[0] : nullptr,
                                   atom->radius, received()));
}

/* In the order of domains, which all ranks share: messages between two of them arrive in the order in
   which they were sent. */

void CommReach::add_swaps(const ProxyReach::Lists &lists)
{
  const int first = nswap, own = static_cast<int>(lists.size()) / 2;
  for (int domain = 0; domain < static_cast<int>(lists.size()); domain++)
    if (domain != own) add_swap(domain, lists[domain]);
  std::vector<MPI_Request> requests;
  send(first, requests);
  for (int swap = first; swap < nswap; swap++) receive(swap);
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

/* What goes to a domain comes from the opposite one in the same swap. Beyond the end of a box there
   is no rank. */

void CommReach::add_swap(int domain, const std::vector<int> &list)
{
  const int swap = nswap++;
  int to[3], from[3];
  bool to_is_there = true, from_is_there = true;
  pbc_flag[swap] = 0;
  std::fill_n(pbc[swap], 6, 0);
  for (int d = 0; d < 3; d++) {
    const int edges = 2 * maxneed[d] + 1, step = domain % edges - maxneed[d];
    domain /= edges;
    const Place target = wrapped(myloc[d] + step, procgrid[d]),
                source = wrapped(myloc[d] - step, procgrid[d]);
    const bool repeats = this->domain->periodicity[d] != 0;
    to[d] = target.index;
    from[d] = source.index;
    to_is_there = to_is_there && (target.periods == 0 || repeats);
    from_is_there = from_is_there && (source.periods == 0 || repeats);
    pbc[swap][d] = -target.periods;
    if (target.periods != 0) pbc_flag[swap] = 1;
  }
  sendproc[swap] = to_is_there ? grid2proc[to[0]][to[1]][to[2]] : MPI_PROC_NULL;
  recvproc[swap] = from_is_there ? grid2proc[from[0]][from[1]][from[2]] : MPI_PROC_NULL;
  sendnum[swap] = static_cast<int>(list.size());
  if (sendnum[swap] > maxsendlist[swap]) grow_list(swap, sendnum[swap]);
  std::copy(list.begin(), list.end(), sendlist[swap]);
}

/* What stays here as well. */

void CommReach::send(int first, std::vector<MPI_Request> &requests)
{
  messages.resize(nswap);
  for (int swap = first; swap < nswap; swap++) {
    std::vector<double> &message = messages[swap];
    const int length = message_length(size_border, sendnum[swap]);
    message.resize(length);
    if (ghost_velocity)
      atom->avec->pack_border_vel(sendnum[swap], sendlist[swap], message.data(), pbc_flag[swap],
                                  pbc[swap]);
    else
      atom->avec->pack_border(sendnum[swap], sendlist[swap], message.data(), pbc_flag[swap],
                              pbc[swap]);
    if (sendproc[swap] == me || sendproc[swap] == MPI_PROC_NULL) continue;
    MPI_Isend(message.data(), length, MPI_DOUBLE, sendproc[swap], TAG_BORDER, world,
              &requests.emplace_back());
  }
}

/* Behind the particles and proxies that are there. */

void CommReach::receive(int swap)
{
  std::vector<double> &message = sendproc[swap] == me ? messages[swap] : arrived;
  if (sendproc[swap] != me) {
    MPI_Status status;
    MPI_Probe(recvproc[swap], TAG_BORDER, world, &status);
    int length = 0;
    MPI_Get_count(&status, MPI_DOUBLE, &length);
    arrived.resize(length);
    MPI_Recv(arrived.data(), length, MPI_DOUBLE, recvproc[swap], TAG_BORDER, world,
             MPI_STATUS_IGNORE);
  }
  const int count = static_cast<int>(message.size()) / size_border,
            at = atom->nlocal + atom->nghost;
  if (ghost_velocity)
    atom->avec->unpack_border_vel(count, at, message.data());
  else
    atom->avec->unpack_border(count, at, message.data());
  firstrecv[swap] = at;
  recvnum[swap] = count;
  size_forward_recv[swap] = count * size_forward;
  size_reverse_send[swap] = count * size_reverse;
  size_reverse_recv[swap] = sendnum[swap] * size_reverse;
  atom->nghost += count;
  if (neighbor->style == Neighbor::MULTI) neighbor->build_collection(at);
}

/* For all exchanges of LAMMPS, of styles too. */

void CommReach::make_buffers_fit()
{
  smax = rmax = 0;
  for (int swap = 0; swap < nswap; swap++) {
    smax = std::max(smax, sendnum[swap]);
    rmax = std::max(rmax, recvnum[swap]);
  }
  const int to_send = std::max(maxforward * smax, maxreverse * rmax),
            to_receive = std::max(maxforward * rmax, maxreverse * smax);
  if (to_send > maxsend) grow_send(to_send, 0);
  if (to_receive > maxrecv) grow_recv(to_receive);
}

/* A swap brings what the opposite domain has sent. */

std::vector<ProxyReach::Proxies> CommReach::received() const
{
  std::vector<ProxyReach::Proxies> found;
  const int around = nswap + 1;    // with the own domain, which has no swap
  for (int swap = 0; swap < nswap; swap++) {
    const int domain = swap < around / 2 ? swap : swap + 1;
    found.push_back({around - 1 - domain, firstrecv[swap], firstrecv[swap] + recvnum[swap]});
  }
  return found;
}
