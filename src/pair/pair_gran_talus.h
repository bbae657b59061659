// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// pair_style gran/hooke, gran/hooke/history and gran/hertz/history with the suffix talus: the stock
// styles with the contacts computed by GranularSystem, and the same numbers but for rounding.
// Commands, restart files and output are those of the stock style. Where that is not possible the
// methods of the stock style are used, see reason_for_stock(). doc/suffix.md is the user's page.
//
//   gran/hooke           law hooke, damping mass_velocity, tangential dashpot
//   gran/hooke/history   law hooke, damping mass_velocity, tangential multistep (rule stock)
//   gran/hertz/history   law hertz, damping viscoelastic, tangential multistep (rule stock)

#ifndef LMP_PAIR_GRAN_TALUS_H
#define LMP_PAIR_GRAN_TALUS_H

#include "pair/pair_of_system.h"

#include "pair_gran_hertz_history.h"
#include "pair_gran_hooke.h"
#include "pair_gran_hooke_history.h"

#include <optional>
#include <string>

namespace LAMMPS_NS {

template <class Stock> class PairGranTalus : public PairOfSystem<Stock> {
 public:
  explicit PairGranTalus(LAMMPS *);
  ~PairGranTalus() override;

  /// Decides at the first call, for good, whether the style is accelerated.
  void init_style() override;
  double init_one(int, int) override;
  void compute(int, int) override;
  double single(int, int, int, int, double, double, double, double &) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  double memory_usage() override;

  std::string plain_style() const override;
  std::string reason_for_stock() const override { return stock_reason.value_or("no run yet"); }

 private:
  void decide();
  std::string find_reason_for_stock();
  std::string reason_of_fixes() const;
  void set_laws();
  std::string history_id() const;
  bool in_system() const { return stock_reason && stock_reason->empty(); }

  bool attached;
  std::optional<std::string> stock_reason;    // from the first init_style() on
};

using PairGranHookeTalus = PairGranTalus<PairGranHooke>;
using PairGranHookeHistoryTalus = PairGranTalus<PairGranHookeHistory>;
using PairGranHertzHistoryTalus = PairGranTalus<PairGranHertzHistory>;

}    // namespace LAMMPS_NS

#endif
