// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// pair_style granular with the suffix talus: the stock style with the contacts computed by
// GranularSystem, and the same numbers but for rounding. The stock style reads the models and mixes
// them; see granular_spec.h for how they become laws. doc/suffix.md is the user's page.

#ifndef LMP_PAIR_GRANULAR_TALUS_H
#define LMP_PAIR_GRANULAR_TALUS_H

#include "pair/accelerated_pair.h"
#include "system/contacts/granular_spec.h"

#include "pair_granular.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class PairGranularTalus : public AcceleratedPair<PairGranular> {
 public:
  explicit PairGranularTalus(LAMMPS *);
  ~PairGranularTalus() override;
  void reset_dt() override;

 protected:
  std::string reason_of_models() const override;
  void set_laws() override;
  double init_pair_of_types(int i, int j) override;
  std::string stock_history() const override;
  void report_single(const std::optional<SinglePair> &pair) override;
  void become_stock() override;

 private:
  /// Of collections of sizes; the stock style knows in its init_style() how far contacts last.
#if TALUS_HOST_HAS_ATOM2CUT
  double atom2cut(int) override;
  double radii2cut(double, double) override;
#endif
  static constexpr int stock_extra = 12;    // numbers of single() without heat
  const Talus::Model &model_of(int i, int j) const
  {
    return *models_list[types_indices[i][j]];
  }
  std::vector<const Talus::Model *> all_models() const;
  bool conducts_heat() const;
};

}    // namespace LAMMPS_NS

#endif
