// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/pair_contacts.h"

#include "atom.h"
#include "force.h"
#include "neigh_list.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "pair.h"

#include <cmath>

using namespace LAMMPS_NS;

namespace Talus {

std::string PairContacts::problem() const
{
  const Pair *pair = force->pair;
  if (!pair) return "there is no pair style";
  if (!atom->radius_flag) return "particles have no radius";
  if (!pair->single_enable || pair->single_extra < 3)
    return std::string("pair style ") + force->pair_style + " does not tell the force of a pair";
  return "";
}

/* The list of the pair style itself, if the host has made one. */

void PairContacts::request(Compute *owner)
{
  int flags = NeighConst::REQ_OCCASIONAL;
  const NeighRequest *of_pair = neighbor->find_request(force->pair);
  if (of_pair && of_pair->get_size()) flags |= NeighConst::REQ_SIZE;
  neighbor->add_request(owner, flags);
}

/* With newton off the list has a pair with a ghost on both sides. */

bool PairContacts::is_for_me(int i, int j) const
{
  if (force->newton_pair || j < atom->nlocal) return true;
  return atom->tag[i] < atom->tag[j];
}

void PairContacts::for_each(const std::function<void(const PairContact &)> &visit) const
{
  neighbor->build_one(list);
  Pair *pair = force->pair;
  double **x = atom->x;
  const double *radius = atom->radius;
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const int neighbor_of_i = list->firstneigh[i][jj], j = neighbor_of_i & NEIGHMASK;
      if (!is_for_me(i, j)) continue;
      PairContact c{i, j, {x[i][0] - x[j][0], x[i][1] - x[j][1], x[i][2] - x[j][2]}, 0.0, {}, {}};
      const double rsq = dot(c.separation, c.separation);
      if (rsq >= pair->cutsq[atom->type[i]][atom->type[j]] || rsq == 0.0) continue;
      double over_distance = 0.0;
      const int bond = neighbor_of_i >> SBBITS & 3;
      pair->single(i, j, atom->type[i], atom->type[j], rsq, force->special_coul[bond],
                   force->special_lj[bond], over_distance);
      c.overlap = radius[i] + radius[j] - std::sqrt(rsq);
      c.normal_force = over_distance * c.separation;
      c.tangential_force = {pair->svector[0], pair->svector[1], pair->svector[2]};
      const Vector3<double> f = c.force();
      if (c.overlap > 0.0 || f.x != 0.0 || f.y != 0.0 || f.z != 0.0) visit(c);
    }
  }
}

}    // namespace Talus
