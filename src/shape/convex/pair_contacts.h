// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The two ways from a pair of cores to contact points. Positions and normals are in the frame of a;
// contacts are appended in ascending order of their names.

#ifndef TALUS_SHAPE_CONVEX_PAIR_CONTACTS_H
#define TALUS_SHAPE_CONVEX_PAIR_CONTACTS_H

#include "shape/convex/core_pair.h"
#include "shape/convex/shared_energy.h"
#include "shape/shape_contact.h"

namespace Talus {

struct Rounding {
  double of_a, of_b;    ///< radii
  double sum() const { return of_a + of_b; }
};

/// Of rounded cores that are apart, in whatever direction (`gap.width` > 0): vertices of each with
/// the nearest points of the other, and pairs of edges. Forces ~ overlap^force_exponent.
void add_feature_contacts(const CorePair &pair, Rounding radius, const Gap &gap,
                          double force_exponent, std::vector<ShapeContact> &contacts);

/// Of cores that overlap by `least`: one point, or corners of the polygon that the faces along its
/// direction have in common. Those that are nearer to a vertex than `merging` are named by it.
/// Forces ~ overlap^force_exponent.
void add_face_contacts(const CorePair &pair, Rounding radius, const LeastDepth &least,
                       double merging, double force_exponent, std::vector<ShapeContact> &contacts);

/// One point of the rounded bodies by Minkowski Portal Refinement (libccd), in the frame of a;
/// returns false where they do not overlap.
bool find_mpr_contact(const CorePair &pair, Rounding radius, ShapeContact &contact);

/// Puts contacts in ascending order of their names.
void sort_by_name(std::vector<ShapeContact> &contacts);

}    // namespace Talus

#endif
