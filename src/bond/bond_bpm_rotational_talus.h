/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   bond_style bpm/rotational with `-sf talus`: beams between spheres, words, histories and results
   of the style of LAMMPS, to rounding. Bonds are computed eight at a time, on all threads, and
   summed in an order that ranks do not change, see bonds/rotational_bonds.h. Those that break are
   taken out of the lists by LAMMPS' own method, in the order of the list.

   Called by: the run style through Bond::compute(), after the pair style.
   Falls back to the methods of LAMMPS without a pair style of Talus, in bond_style hybrid and with
   newton on for bonds: reason_for_stock().
   Other than LAMMPS' own: angles below 1e-8 are known, see bonds/rotational_bond.h; of `frame average` shear is not left
   out where the product of both lengths and the sine of the angle is below 1e-10.
   Errors: those of bond_style bpm/rotational; a strength that is not above 0, without 'break no'. Warns of a bond that is
  longer than ghosts reach, of new ones between spheres that have turned, and of words that restart files of LAMMPS
  4 Feb 2025 lack.
------------------------------------------------------------------------- */

#ifdef BOND_CLASS
// clang-format off
BondStyle(bpm/rotational/talus,BondBPMRotationalTalus);
// clang-format on
#else

#ifndef LMP_BOND_BPM_ROTATIONAL_TALUS_H
#define LMP_BOND_BPM_ROTATIONAL_TALUS_H

#include "BPM/bond_bpm_rotational.h"
#include "bonds/rotational_bonds.h"
#include "system/contacts/bond_account.h"
#include "system/host/system_style.h"
#include "system/step/granular_system.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

class BondBPMRotationalTalus : public BondBPMRotational,
                               public Talus::SystemStyle,
                               public Talus::BondAccount {
 public:
  explicit BondBPMRotationalTalus(class LAMMPS *);
  void settings(int, char **) override;
  void read_restart(FILE *) override;
  void init_style() override;
  void compute(int, int) override;
  double memory_usage() override;

  // SystemStyle
  std::string plain_style() const override { return "bpm/rotational"; }
  std::string reason_for_stock() const override { return reason; }

 private:
  std::shared_ptr<Talus::GranularSystem> system;
  std::string reason = "no run yet";    // for the methods of LAMMPS
  Talus::RotationalBonds bonds;
  int **listed = nullptr;    // the list that they are from
  int num_listed = -1;
  bool from_file = false;    // as a restart file tells it

  std::string find_reason() const;
  Talus::BondModel model() const;
  void warn_of_words();
  void check_strengths() const;
  void warn_of_long_bonds() const;
  bool is_turned(int) const;
  void warn_of_turned_bonds(LAMMPS_NS::bigint) const;
  void begin_bonds();
  void take_list(bool first);
  bool is_unset(int) const;
  void break_bonds(bool);
  void add_loads(bool);
  void tally_bonds();
  double share_of(int) const;
  double stored_energy() const override;
  void end_bonds();
};

}    // namespace LAMMPS_NS

#endif
#endif
