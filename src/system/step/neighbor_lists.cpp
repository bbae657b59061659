// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/step/neighbor_lists.h"

#include "domain.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace Talus {

DomainBox DomainBox::of(const Domain &domain)
{
  DomainBox box;
  std::copy_n(domain.boxlo, 3, box.low.begin());
  std::copy_n(domain.boxhi, 3, box.high.begin());
  box.tilt = {domain.xy, domain.xz, domain.yz};
  return box;
}

void DomainBox::give_to(Domain &domain) const
{
  std::copy(low.begin(), low.end(), domain.boxlo);
  std::copy(high.begin(), high.end(), domain.boxhi);
  domain.xy = tilt[0];
  domain.xz = tilt[1];
  domain.yz = tilt[2];
  domain.set_global_box();
  domain.set_lamda_box();
  domain.set_local_box();
}

void NeighborLists::are_new()
{
  present = ++last;
  box_then = DomainBox::of(*domain);
}

}    // namespace Talus
