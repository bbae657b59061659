// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// pair_style gran/hooke, gran/hooke/history and gran/hertz/history with the suffix talus: the stock
// styles with the contacts computed by GranularSystem, and the same numbers but for rounding.
// doc/suffix.md is the user's page.
//
//   gran/hooke           law hooke, damping mass_velocity, tangential dashpot
//   gran/hooke/history   law hooke, damping mass_velocity, tangential multistep (rule stock)
//   gran/hertz/history   law hertz, damping viscoelastic, tangential multistep (rule stock)

#ifndef LMP_PAIR_GRAN_TALUS_H
#define LMP_PAIR_GRAN_TALUS_H

#include "pair/accelerated_pair.h"

#include "pair_gran_hertz_history.h"
#include "pair_gran_hooke.h"
#include "pair_gran_hooke_history.h"

#include <string>

namespace LAMMPS_NS {

template <class Stock> class PairGranTalus : public AcceleratedPair<Stock> {
 public:
  explicit PairGranTalus(LAMMPS *);
  ~PairGranTalus() override;

 protected:
  std::string reason_of_models() const override { return ""; }
  void set_laws() override;
  double init_pair_of_types(int i, int j) override { return this->system->range().cutoff(i, j); }
  std::string stock_history() const override { return this->history ? " 0 1 2" : ""; }
  void report_single(const std::optional<SinglePair> &pair) override;
};

using PairGranHookeTalus = PairGranTalus<PairGranHooke>;
using PairGranHookeHistoryTalus = PairGranTalus<PairGranHookeHistory>;
using PairGranHertzHistoryTalus = PairGranTalus<PairGranHertzHistory>;

}    // namespace LAMMPS_NS

#endif
