// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Masses that contacts feel where they are not the particle's own: members of a `fix freeze` group
// are infinitely heavy, members of rigid bodies weigh what the body weighs. The laws take force =
// mass acceleration for granted, so where LAMMPS' units do not (real, metal, electron), all
// masses are converted.

#ifndef TALUS_SYSTEM_CONTACTS_EFFECTIVE_MASSES_H
#define TALUS_SYSTEM_CONTACTS_EFFECTIVE_MASSES_H

#include "atom.h"
#include "pointers.h"

#include <cmath>
#include <vector>

namespace LAMMPS_NS {

class Fix;

class EffectiveMasses : protected Pointers {
 public:
  explicit EffectiveMasses(LAMMPS *lmp) : Pointers(lmp) {}

  /// Looks for freeze and rigid fixes. Call in init().
  void find_fixes();

  /// Finds the masses of owned particles. Call after each rebuild of the neighbor lists.
  void update();

  bool needed() const { return freeze_groups || !rigid_fixes.empty() || unit() != 1.0; }
  int frozen_groups() const { return freeze_groups; }
  bool bodies_are_rigid() const { return !rigid_fixes.empty(); }

  /// Per particle, nullptr if no mass is replaced: 0 keeps the particle's own mass. update() fills
  /// the owned part; the caller communicates the rest for ghosts.
  double *override_or_null() { return masses.empty() ? nullptr : masses.data(); }
  const double *override_or_null() const { return masses.empty() ? nullptr : masses.data(); }

  /// Of an owned particle that is a member of a rigid body: that of the body, else its own; as
  /// walls of LAMMPS see it, frozen or not, not converted.
  double of_body(int i) const
  {
    const bool replaced =
        bodies_are_rigid() && !masses.empty() && masses[i] > 0.0 && std::isfinite(masses[i]);
    return replaced ? masses[i] / unit() : atom->rmass[i];
  }
  /// Whether update() has seen this owned particle; of those that come later it is not known which
  /// body they belong to.
  bool knows(int i) const { return !bodies_are_rigid() || i < num_known; }
  /// Of an owned or ghost particle, converted.
  double mass(int i) const;

  /// Force/acceleration for each unit of mass.
  double unit() const;

 private:
  int freeze_groups = 0;    // bits of all groups with a fix freeze
  std::vector<Fix *> rigid_fixes;
  std::vector<double> masses;
  int num_known = 0;
};

}    // namespace LAMMPS_NS

#endif
