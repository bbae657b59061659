// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The contacts between particles with their forces, one after another, as Pair::single() tells
// them: for outputs. Of all granular pair styles, those of the host included: what it takes is a
// style whose single() tells the tangential force in the first three of its extra values.
//
//   in init() of a compute    problem(), then request()
//   in its init_list()        set_list()
//   in a step with output     for_each()

#ifndef TALUS_SYSTEM_PAIR_CONTACTS_H
#define TALUS_SYSTEM_PAIR_CONTACTS_H

#include "base/vector3.h"

#include "pointers.h"

#include <functional>
#include <string>

namespace LAMMPS_NS {
class Compute;
class NeighList;
}    // namespace LAMMPS_NS

namespace Talus {

struct PairContact {
  int i, j;                      ///< indices of the host; i is owned, j may be a ghost
  Vector3<double> separation;    ///< from the center of j to that of i (length)
  double overlap;                ///< sum of the radii less the distance (length); < 0: drawn apart
  Vector3<double> normal_force, tangential_force;    ///< on i (force)

  Vector3<double> force() const { return normal_force + tangential_force; }
};

class PairContacts : protected LAMMPS_NS::Pointers {
 public:
  explicit PairContacts(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /// "" or why the pair style does not tell its contacts, for people.
  std::string problem() const;
  void request(LAMMPS_NS::Compute *owner);
  void set_list(LAMMPS_NS::NeighList *its) { list = its; }
  bool has_list() const { return list != nullptr; }

  /// Calls visit for each contact once, on one rank. Positions of ghosts must be up to date, as
  /// they are in steps that the host looks at. Collective.
  void for_each(const std::function<void(const PairContact &)> &visit) const;

 private:
  bool is_for_me(int i, int j) const;

  LAMMPS_NS::NeighList *list = nullptr;
};

}    // namespace Talus

#endif
