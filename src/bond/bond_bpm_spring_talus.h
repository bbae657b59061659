/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   bond_style bpm/spring with `-sf talus`: springs between particles, see bond/bond_bpm_talus.h.

   Other than LAMMPS' own: with `volume/factor yes` ghosts get volumes at rest in every step, so that they are the same on
   any number of ranks right after a bond has broken.
------------------------------------------------------------------------- */

#ifdef BOND_CLASS
// clang-format off
BondStyle(bpm/spring/talus,BondBPMSpringTalus);
// clang-format on
#else

#ifndef LMP_BOND_BPM_SPRING_TALUS_H
#define LMP_BOND_BPM_SPRING_TALUS_H

#include "BPM/bond_bpm_spring.h"
#include "bond/bond_bpm_talus.h"
#include "bonds/spring_bonds.h"

#include <vector>

namespace LAMMPS_NS {

class BondBPMSpringTalus : public BondBPMTalus<BondBPMSpring, Talus::SpringBonds> {
 public:
  explicit BondBPMSpringTalus(class LAMMPS *);
  void init_style() override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  std::string plain_style() const override { return "bpm/spring"; }

 private:
  std::vector<int> added;    // bonds that came with a particle

  void prepare() override;
  std::string lacking_words() const override;
  void store_new(int, int, int, bool) override;
  void load_bonds(bool) override;
  bool has_no_volumes(bool first) const;
  void find_volumes(bool first);
  void add_volumes_at_rest(const std::vector<int> &, double sign);
  void account_for_broken() override;
};

}    // namespace LAMMPS_NS

#endif
#endif
