// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What all pair styles of Talus do in the same way: their contacts are those of GranularSystem,
// which computes them; single pairs are answered from it, and the masses that contacts feel are
// communicated for it. Base is Pair, or the stock style that is accelerated.

#ifndef LMP_PAIR_OF_SYSTEM_H
#define LMP_PAIR_OF_SYSTEM_H

#include "pair.h"
#include "system/granular_system.h"
#include "system/system_pair.h"

#include <memory>

namespace LAMMPS_NS {

template <class Base> class PairOfSystem : public Base, public Talus::SystemPair {
 protected:
  explicit PairOfSystem(LAMMPS *lmp) : Base(lmp), system(Talus::GranularSystem::of(lmp)) {}

  /// In the place of compute().
  void compute_contacts(int eflag, int vflag);

  /// In the place of single(): forces of a pair at squared distance rsq that touches or not,
  /// history as stored. Returns what the host wants of single(): force over distance. `extra`:
  /// friction (vector and length), normal and tangential velocity as the stock styles have them,
  /// and then overlap over the smaller radius.
  static constexpr int num_extra = 11;
  double force_of_pair(int i, int j, int itype, int jtype, double rsq, double *extra);

  /// Masses that contacts feel, for ghosts: pack_forward_comm() and the like.
  int pack_masses(int n, const int *send, double *buf) const;
  void unpack_masses(int n, int first, const double *buf);

  std::shared_ptr<Talus::GranularSystem> system;

 private:
  void tally(const Talus::ReportedContact &contact);
};

}    // namespace LAMMPS_NS

#endif
