// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Weights of contacts that end where others begin: of two edges that cross (their ends are contacts
// as well), of an edge on a round body, of a face on a rim. Forces follow from an energy,
//
//   phi(o) prod_k left(p_k),  p_k = s_k phi(o_k)/phi(o),  phi(o) ~ o^m,
//
// o_k being the overlaps of the contacts at which this one ends, and s_k <= 1 (1 but for meshes
// and rims) how much they have to do with it. left() falls from 1 to 0 at p = 1: so nothing jumps where the
// contact reaches one of its ends, or where an end is as deep (parallel edges). The derivatives by
// the overlaps, over phi', are weights: 1 of a contact that is alone; more than 1 of one that shares;
// and what an end loses, which leaves it down to -1/9 of one, less of several.

#ifndef TALUS_SHAPE_CONVEX_SHARED_ENERGY_H
#define TALUS_SHAPE_CONVEX_SHARED_ENERGY_H

#include "shape/shape_contact.h"

#include <vector>

namespace Talus {

/// Contacts of less weight are none.
constexpr double least_weight = 1.0e-6;

/// To be used again for the next contact, so that no memory is allocated: begin(), add_end() for
/// each of its ends, then finish(), and all the rest only if this says so.
class SharedEnergy {
 public:
  /// `overlap` > 0; elastic forces ~ overlap^force_exponent, so that m is larger by 1.
  void begin(double overlap, double force_exponent);
  /// One of the contacts that have been found, by its number, or of overlap 0: then none.
  void add_end(int contact, double overlap, double share = 1.0);
  /// Returns whether anything is left.
  bool finish();

  /// Of the contact itself, and its energy over phi(o).
  double weight() const { return own; }
  double energy() const { return product; }
  void take_from(std::vector<ShapeContact> &contacts) const
  {
    visit_ends(
        [&](int contact, double /*share*/, double weight) { contacts[contact].weight -= weight; });
  }
  /// visit(contact, share, weight): what this takes from the weight of the contact, as long as the share
  /// does not change.
  template <class Visit> void visit_ends(Visit visit) const
  {
    for (const End &end : ends) visit(end.contact, end.share, end.weight);
  }

 private:
  struct End {
    int contact;
    double share, ratio, left, weight;
  };
  std::vector<End> ends;
  double overlap, exponent, own, product;
  bool is_left;
};

}    // namespace Talus

#endif
