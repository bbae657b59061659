// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/contact_list.h"

#include "system/step/granular_system.h"

#include "atom.h"
#include "force.h"
#include "neigh_list.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "pair.h"

#include <cmath>

using namespace LAMMPS_NS;

namespace Talus {

ContactList::ContactList(LAMMPS *lmp) : Pointers(lmp), system(GranularSystem::of(lmp)) {}

std::string ContactList::problem() const
{
  const Pair *pair = force->pair;
  if (!pair) return "there is no pair style";
  if (!atom->radius_flag) return "particles have no radius";
  if (!pair->single_enable || pair->single_extra < 3)
    return std::string("pair style ") + force->pair_style + " does not tell the force of a pair";
  return "";
}

/* The list of the pair style itself, if LAMMPS has made one. */

void ContactList::request(Compute *owner)
{
  if (system->pair_style().is_alone()) return;
  int flags = NeighConst::REQ_OCCASIONAL;
  const NeighRequest *of_pair = neighbor->find_request(force->pair);
  if (of_pair && of_pair->get_size()) flags |= NeighConst::REQ_SIZE;
  neighbor->add_request(owner, flags);
}

bool ContactList::is_known() const
{
  return system->pair_style().is_alone() ? system->contacts().are_known() : list != nullptr;
}

void ContactList::for_each(const VisitContact &visit) const
{
  const bool is_talus_pair = system->pair_style().is_alone();
  if (!is_talus_pair) for_each_pair_of_lammps(visit);
  system->contacts().for_each(ContactData::ALL, [&](const ContactReport &one) {
    if (one.body >= 0 || (is_talus_pair && system->contacts().is_of_this_rank(one))) visit(one);
  });
}

/* With newton off the list has a pair with a ghost on both sides. */

bool ContactList::is_for_me(int i, int j) const
{
  if (force->newton_pair || j < atom->nlocal) return true;
  return atom->tag[i] < atom->tag[j];
}

void ContactList::for_each_pair_of_lammps(const VisitContact &visit) const
{
  neighbor->build_one(list);
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    for (int jj = 0; jj < list->numneigh[i]; jj++) visit_pair(i, list->firstneigh[i][jj], visit);
  }
}

void ContactList::visit_pair(int i, int neighbor_of_i, const VisitContact &visit) const
{
  const int j = neighbor_of_i & NEIGHMASK, bond = neighbor_of_i >> SBBITS & 3;
  if (!is_for_me(i, j)) return;
  Pair *pair = force->pair;
  const double *a = atom->x[i], *b = atom->x[j];
  const Vector3<double> separation{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  const double rsq = dot(separation, separation);
  if (rsq >= pair->cutsq[atom->type[i]][atom->type[j]] || rsq == 0.0) return;
  double over_distance = 0.0;
  pair->single(i, j, atom->type[i], atom->type[j], rsq, force->special_coul[bond],
               force->special_lj[bond], over_distance);
  ContactReport c;
  c.i = i;
  c.j = j;
  c.center[0] = {a[0], a[1], a[2]};
  c.center[1] = {b[0], b[1], b[2]};
  c.normal = (1.0 / std::sqrt(rsq)) * separation;
  c.overlap = atom->radius[i] + atom->radius[j] - std::sqrt(rsq);
  c.force = over_distance * separation +
            Vector3<double>{pair->svector[0], pair->svector[1], pair->svector[2]};
  c.set_arms_of_spheres(atom->radius[i], atom->radius[j]);
  if (c.overlap > 0.0 || c.force.x != 0.0 || c.force.y != 0.0 || c.force.z != 0.0) visit(c);
}

}    // namespace Talus
