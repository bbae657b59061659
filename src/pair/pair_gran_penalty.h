// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// pair_style gran/penalty: penalty contact with friction between spheres. A thin style: it parses
// and checks, asks GranularSystem for the forces, and answers LAMMPS' questions about single
// pairs. doc/pair_gran_penalty.md is the user's page.

#ifndef LMP_PAIR_GRAN_PENALTY_H
#define LMP_PAIR_GRAN_PENALTY_H

#include "pair/pair_of_system.h"
#include "system/host/lammps_compat.h"

#include <cstdint>

namespace LAMMPS_NS {

class PairGranPenalty : public PairOfSystem<Pair> {
 public:
  PairGranPenalty(class LAMMPS *);
  ~PairGranPenalty() override;

  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void compute(int, int) override;
  double single(int, int, int, int, double, double, double, double &) override;

  void write_restart(FILE *) override;
  void read_restart(FILE *) override;

  /// Of the masses that contacts feel, and of the liquid that bridges have.
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  double memory_usage() override;
  double atom2cut(int) TALUS_OVERRIDE_ATOM2CUT;
  double radii2cut(double, double) TALUS_OVERRIDE_ATOM2CUT;

  std::string plain_style() const override { return "gran/penalty"; }
  std::string reason_for_stock() const override { return ""; }

 private:
  void allocate();
  void check_host();
};

}    // namespace LAMMPS_NS

#endif
