// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Largest distance at which particles are in contact, by their types: from the largest radii and
// the pull-off distances of the laws. And whether the box is large enough for it.

#ifndef TALUS_SYSTEM_CONTACTS_CONTACT_RANGE_H
#define TALUS_SYSTEM_CONTACTS_CONTACT_RANGE_H

#include "material/pair_coeffs.h"
#include "system/host/largest_radii.h"

#include "pointers.h"

#include <string>

namespace Talus {

class ShapedParticles;

class ContactRange : protected LAMMPS_NS::Pointers {
 public:
  ContactRange(LAMMPS_NS::LAMMPS *lmp, const PairCoeffs &pair_coeffs) :
      Pointers(lmp), largest_radii(lmp), laws(pair_coeffs)
  {
  }

  /// Before a run, collective; the rest holds for what there was then. See LargestRadii::find().
  void find(int frozen_groups, const ShapedParticles *shapes)
  {
    largest_radii.find(frozen_groups, shapes);
    farthest_of_laws = -1;
  }
  const LAMMPS_NS::LargestRadii &radii() const { return largest_radii; }
  /// Largest distance of particles of types i and j in contact (length).
  double cutoff(int i, int j) const;
  /// How far contacts of all types last beyond zero overlap (length).
  double largest_pulloff_distance() const;

  /// Ends in an error of the pair style of that name if a particle is too large for the box.
  void require_sizes(const std::string &style) const;
  /// "", or that two particles may touch on both sides of a period: histories are known by the IDs
  /// of both, which two images of one share.
  std::string small_period() const;

 private:
  double reach(int i, int j) const;

  LAMMPS_NS::LargestRadii largest_radii;
  const PairCoeffs &laws;
  mutable int farthest_of_laws = -1;    // revision for which `farthest` is known
  mutable double farthest = 0.0;
};

}    // namespace Talus

#endif
