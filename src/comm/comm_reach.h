// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// comm_style brick with proxies by reach: where only contacts look at proxies, a particle is one
// where something can touch it (neighbors/proxy_reach.h), not in a slab whose width the largest
// particles dictate; and each comes from its owner, in one message to each domain around, not in
// stages. As LAMMPS' swaps, so that all its exchanges work as they are: one for each domain, and
// once more one for each if sizes differ.

#ifndef LMP_COMM_REACH_H
#define LMP_COMM_REACH_H

#include "neighbors/proxy_reach.h"

#include "comm_brick.h"

#include <mpi.h>

#include <vector>

namespace LAMMPS_NS {

class CommReach : public CommBrick {
 public:
  CommReach(class LAMMPS *lmp, class Comm *old) : CommBrick(lmp, old) {}

  /// Decides who chooses proxies, we or LAMMPS, until the next setup().
  void setup() override;
  void borders() override;

 private:
  bool is_few_domains() const;
  Talus::DomainGrid domains() const;
  Talus::ProxyReach reach();
  void choose_proxies();
  void add_swaps(const Talus::ProxyReach::Lists &lists);
  void add_swap(int domain, const std::vector<int> &list);
  void send(int first, std::vector<MPI_Request> &requests);
  void receive(int swap);
  void make_buffers_fit();
  std::vector<Talus::ProxyReach::Proxies> received() const;

  bool by_reach = false;
  std::vector<std::vector<double>> messages;    // by swap
  std::vector<double> arrived;
};

}    // namespace LAMMPS_NS

#endif
