// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What all pair styles of Talus do in the same way: their contacts are those of GranularSystem,
// which computes them; single pairs are answered from it, and the masses that contacts feel are
// communicated for it. Base is Pair, or the stock style that is accelerated.

#ifndef LMP_PAIR_OF_SYSTEM_H
#define LMP_PAIR_OF_SYSTEM_H

#include "laws/contact_lanes.h"
#include "system/contacts/bonded_pairs.h"
#include "system/host/system_style.h"
#include "system/step/granular_system.h"

#include "pair.h"

#include <memory>
#include <optional>
#include <string>

namespace LAMMPS_NS {

/// Two particles that touch, as single() of a pair style is asked about them: their state, what
/// their laws make of it, and distance and radii (length).
struct SinglePair {
  Talus::ContactLanes<double> contact;
  double distance, radius_i, radius_j;

  /// What Pair::single() returns: the normal force, adhesion included, over the distance.
  double force_over_distance() const
  {
    return dot(contact.force - contact.tangential, contact.normal) / distance;
  }
};

template <class Base> class PairOfSystem : public Base, public Talus::SystemStyle {
 protected:
  explicit PairOfSystem(LAMMPS *lmp) :
      Base(lmp), system(Talus::GranularSystem::of(lmp)), bonded_pairs(lmp, *system)
  {
  }

  /// In init_style(): "", or what of the settings of LAMMPS would make forces wrong.
  std::string unsupported_settings() const;

  /// In the place of compute().
  void compute_contacts(int eflag, int vflag);

  /// For single(): particles at squared distance rsq, history as stored; nothing if they do not
  /// touch.
  std::optional<SinglePair> look_at_pair(int i, int j, int itype, int jtype, double rsq);

  /// Of a pair or of none: friction (vector and length), normal and tangential velocity as the
  /// stock styles gran/* have them, and then overlap over the smaller radius.
  static constexpr int num_extra = 11;
  static void describe_pair(const std::optional<SinglePair> &pair, double *extra);

  /// Masses that contacts feel, for ghosts: pack_forward_comm() and the like.
  int pack_masses(int n, const int *send, double *buf) const;
  void unpack_masses(int n, int first, const double *buf);

  std::shared_ptr<Talus::GranularSystem> system;

 private:
  void tally(const Talus::TalliedContact &contact);

  Talus::BondedPairs bonded_pairs;
};

}    // namespace LAMMPS_NS

#endif
