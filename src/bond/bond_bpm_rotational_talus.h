/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   bond_style bpm/rotational with `-sf talus`: beams between spheres, see bond/bond_bpm_talus.h.

   Other than LAMMPS' own: angles below 1e-8 are known, see bonds/rotational_bond.h; of `frame average` shear is not left
   out where the product of both lengths and the sine of the angle is below 1e-10.
   Warns also of new bonds between spheres that have turned.
------------------------------------------------------------------------- */

#ifdef BOND_CLASS
// clang-format off
BondStyle(bpm/rotational/talus,BondBPMRotationalTalus);
// clang-format on
#else

#ifndef LMP_BOND_BPM_ROTATIONAL_TALUS_H
#define LMP_BOND_BPM_ROTATIONAL_TALUS_H

#include "BPM/bond_bpm_rotational.h"
#include "bond/bond_bpm_talus.h"
#include "bonds/rotational_bonds.h"

namespace LAMMPS_NS {

class BondBPMRotationalTalus : public BondBPMTalus<BondBPMRotational, Talus::RotationalBonds> {
 public:
  explicit BondBPMRotationalTalus(class LAMMPS *);
  std::string plain_style() const override { return "bpm/rotational"; }

 private:
  bigint turned = 0;    // new bonds in this set-up between spheres that have

  void prepare() override;
  Talus::BondModel model() const;
  std::string lacking_words() const override;
  void store_new(int, int, int, bool) override;
  bool is_turned(int) const;
  void warn_of_new_bonds() override;
  void load_bonds(bool) override;
};

}    // namespace LAMMPS_NS

#endif
#endif
