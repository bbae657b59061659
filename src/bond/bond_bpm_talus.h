/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   Bond styles of package BPM with `-sf talus`: what they have in common. Base is the style of LAMMPS,
   whose words, histories and results these are, to rounding; Bonds computes its bonds eight at a time,
   on all threads, and sums them in an order that ranks do not change, see bonds/bond_sums.h. Those that
   break are taken out of the lists by LAMMPS' own method, in the order of the list.

   Called by: the run style through Bond::compute(), after the pair style.
   Falls back to the methods of LAMMPS without a pair style of Talus, in bond_style hybrid and with
   newton on for bonds: reason_for_stock().
   Errors: those of LAMMPS; a strength that is not above 0, without 'break no'. Warns of a bond that is
   longer than ghosts reach, and of words that restart files of LAMMPS 4 Feb 2025 lack.
------------------------------------------------------------------------- */

#ifndef LMP_BOND_BPM_TALUS_H
#define LMP_BOND_BPM_TALUS_H

#include "system/contacts/bond_account.h"
#include "system/host/system_style.h"
#include "system/step/granular_system.h"

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>

namespace LAMMPS_NS {

template <class Base, class Bonds>
class BondBPMTalus : public Base, public Talus::SystemStyle, public Talus::BondAccount {
 public:
  void settings(int, char **) override;
  void read_restart(FILE *) override;
  void init_style() override;
  void compute(int, int) override;
  double memory_usage() override;

  // SystemStyle
  std::string reason_for_stock() const override { return reason; }
  std::string needs_arrays() const override;

 protected:
  // how LAMMPS tallies bonds of this style
  struct Tally {
    double sign_of_pressure;
    bool has_energy;
  };
  BondBPMTalus(class LAMMPS *, Tally);
  ~BondBPMTalus() override = default;

  Bonds bonds;

  // before a run, if it is accelerated: checks coefficients, and gives `bonds` its model
  virtual void prepare() = 0;
  // the words of bond_style that restart files of this LAMMPS lack, or ""
  virtual std::string lacking_words() const = 0;
  // bond n, new in the list, between these places: keeps what it is like now; `first`: as all others
  virtual void store_new(int n, int i, int j, bool first) = 0;
  // in set-up, when new bonds have been stored; collective
  virtual void warn_of_new_bonds() {}
  // collective; `first`: all bonds are new
  virtual void load_bonds(bool first) = 0;
  // when those that break have been dropped
  virtual void account_for_broken() {}

  using Strengths = std::initializer_list<std::pair<const char *, const double *>>;
  void check_strengths(Strengths, const char *what) const;

  std::shared_ptr<Talus::GranularSystem> system;

 private:
  std::string reason = "no run yet";    // for the methods of LAMMPS
  const Tally tally;
  int **listed = nullptr;    // the list that bonds are from
  int num_listed = -1;
  bool from_file = false;    // as a restart file tells it

  std::string find_reason() const;
  void warn_of_words();
  void warn_of_long_bonds() const;
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
