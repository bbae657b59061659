// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "comm/comm_proxy.h"

#include "exchange/exchange_tags.h"

#include "atom.h"
#include "domain.h"

#include <algorithm>
#include <array>
#include <set>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

constexpr int words = sizeof(ProxyOrigin) / sizeof(int);

/// What one message of a swap sends: of owned particles, and of ghosts what is known by then.
std::vector<ProxyOrigin> sent_origins(int me, int owned, const std::vector<ProxyOrigin> &of_ghosts,
                                      int count, const int *list, bool shifted, const int *pbc)
{
  std::vector<ProxyOrigin> sent(count);
  for (int k = 0; k < count; k++) {
    const int i = list[k];
    sent[k] = i < owned ? ProxyOrigin{me, i, {0, 0, 0}} : of_ghosts[i - owned];
    if (shifted)
      for (int d = 0; d < 3; d++) sent[k].shift[d] += pbc[d];
  }
  return sent;
}

/// Low and high corner of the domain of a rank.
using RankBox = std::array<double, 6>;

/// How far two boxes are from each other along an edge, over all periods; the same for both.
double gap(const RankBox &a, const RankBox &b, int d, double period)
{
  double least = std::max(b[d] - a[3 + d], a[d] - b[3 + d]);
  for (const double shift : {period, -period})
    least = std::min(least, std::max(b[d] + shift - a[3 + d], a[d] - (b[3 + d] + shift)));
  return least;
}

}    // namespace

/* ---- bricks ---------------------------------------------------------------------------------- */

template <> std::vector<ProxyOrigin> CommProxy<CommReach>::trace_origins(MPI_Comm communicator)
{
  std::vector<ProxyOrigin> of_ghosts(atom->nghost);
  for (int swap = 0; swap < nswap; swap++) {
    const std::vector<ProxyOrigin> sent = sent_origins(
        me, atom->nlocal, of_ghosts, sendnum[swap], sendlist[swap], pbc_flag[swap] != 0, pbc[swap]);
    ProxyOrigin *to = of_ghosts.data() + (firstrecv[swap] - atom->nlocal);
    if (sendproc[swap] == me)
      std::copy(sent.begin(), sent.end(), to);
    else
      MPI_Sendrecv(sent.data(), words * sendnum[swap], MPI_INT, sendproc[swap], TAG_ORIGIN, to,
                   words * recvnum[swap], MPI_INT, recvproc[swap], TAG_ORIGIN, communicator,
                   MPI_STATUS_IGNORE);
  }
  return of_ghosts;
}

/* All ranks within the reach of the swaps. The reach is the same for all ranks, so this is
   symmetric. */

template <> std::vector<int> CommProxy<CommReach>::possible_neighbors()
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

/* ---- tiles ----------------------------------------------------------------------------------- */

/* In each swap with several ranks, with itself last. */

template <> std::vector<ProxyOrigin> CommProxy<CommTiled>::trace_origins(MPI_Comm communicator)
{
  std::vector<ProxyOrigin> of_ghosts(atom->nghost);
  const auto received = [&](int first) { return of_ghosts.data() + (first - atom->nlocal); };
  for (int swap = 0; swap < nswap; swap++) {
    const int own = sendself[swap], receives = nrecvproc[swap] - own, sends = nsendproc[swap] - own;
    std::vector<MPI_Request> requests(receives);
    for (int n = 0; n < receives; n++)
      MPI_Irecv(received(firstrecv[swap][n]), words * recvnum[swap][n], MPI_INT, recvproc[swap][n],
                TAG_ORIGIN, communicator, &requests[n]);
    for (int n = 0; n < sends + own; n++) {
      const std::vector<ProxyOrigin> sent =
          sent_origins(me, atom->nlocal, of_ghosts, sendnum[swap][n], sendlist[swap][n],
                       pbc_flag[swap][n] != 0, pbc[swap][n]);
      if (n == sends)
        std::copy(sent.begin(), sent.end(), received(firstrecv[swap][receives]));
      else
        MPI_Send(sent.data(), words * sendnum[swap][n], MPI_INT, sendproc[swap][n], TAG_ORIGIN,
                 communicator);
    }
    MPI_Waitall(receives, requests.data(), MPI_STATUSES_IGNORE);
  }
  return of_ghosts;
}

/* All ranks whose domains are within the cutoff of this one's, along each edge: no ghost comes from
   further away. */

template <> std::vector<int> CommProxy<CommTiled>::possible_neighbors()
{
  const bool tilted = domain->triclinic != 0;
  const double *const low = tilted ? domain->sublo_lamda : domain->sublo,
                      *const high = tilted ? domain->subhi_lamda : domain->subhi,
                      *const period = tilted ? domain->prd_lamda : domain->prd;
  const RankBox mine{low[0], low[1], low[2], high[0], high[1], high[2]};
  std::vector<RankBox> boxes(nprocs);
  MPI_Allgather(mine.data(), 6, MPI_DOUBLE, boxes.data(), 6, MPI_DOUBLE, world);
  std::vector<int> ranks;
  for (int r = 0; r < nprocs; r++) {
    const RankBox &first = boxes[std::min(me, r)], &second = boxes[std::max(me, r)];
    bool near = r != me;
    for (int d = 0; d < domain->dimension; d++)
      near = near && gap(first, second, d, domain->periodicity[d] ? period[d] : 0.0) <= cutghost[d];
    if (near) ranks.push_back(r);
  }
  return ranks;
}

/* ---------------------------------------------------------------------------------------------- */

Comm *LAMMPS_NS::make_comm_proxy(LAMMPS *lmp, Comm *old)
{
  if (old->style == Comm::TILED) return new CommProxyTiled(lmp, old);
  return new CommProxyBrick(lmp, old);
}
