// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#if TALUS_HOST_HAS_GRANULAR

#include "pair/pair_gran_talus.h"

#include "laws/law_list.h"
#include "pair/accelerated_pair_impl.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

struct StockLaw {
  const char *style, *normal, *damping, *tangential;
};

template <class Stock> constexpr StockLaw law_of{};
template <>
constexpr StockLaw law_of<PairGranHooke> = {"gran/hooke", "hooke", "mass_velocity", "dashpot"};
template <>
constexpr StockLaw law_of<PairGranHookeHistory> = {"gran/hooke/history", "hooke", "mass_velocity",
                                                   "multistep"};
template <>
constexpr StockLaw law_of<PairGranHertzHistory> = {"gran/hertz/history", "hertz", "viscoelastic",
                                                   "multistep"};

}    // namespace

template <class Stock>
PairGranTalus<Stock>::PairGranTalus(LAMMPS *lmp) : AcceleratedPair<Stock>(lmp, law_of<Stock>.style)
{
  this->limit_damping =
      0;    // restart files of the stock styles do not hold it, nor do they set it
}

template <class Stock> PairGranTalus<Stock>::~PairGranTalus()
{
  if (!this->copymode) this->leave_system();
}

/* The same for all pairs of types. The stock style has converted units and NULL. */

template <class Stock> void PairGranTalus<Stock>::set_laws()
{
  constexpr StockLaw stock = law_of<Stock>;
  ContactSpec spec;
  spec.law.choose(Stage::NORMAL, find_law(Stage::NORMAL, stock.normal));
  spec.law.choose(Stage::DAMPING, find_law(Stage::DAMPING, stock.damping));
  spec.law.choose(Stage::TANGENTIAL, find_law(Stage::TANGENTIAL, stock.tangential));
  spec.given["kn"] = this->kn;
  spec.given["kt"] = this->kt;
  spec.given["gn"] = this->gamman;
  spec.given["gt"] = this->gammat;
  spec.given["mu"] = this->xmu;
  if (this->limit_damping) spec.given["limit_damping"] = 1.0;

  PairCoeffs &laws = this->system->laws();
  laws.resize(this->atom->ntypes);
  for (int i = 1; i <= this->atom->ntypes; i++)
    for (int j = i; j <= this->atom->ntypes; j++) laws.set(i, j, spec);
}

template <class Stock>
void PairGranTalus<Stock>::report_single(const std::optional<SinglePair> &pair)
{
  double extra[PairOfSystem<Stock>::num_extra];
  this->describe_pair(pair, extra);
  std::copy(extra, extra + this->single_extra, this->svector);
}

template class LAMMPS_NS::PairGranTalus<PairGranHooke>;
template class LAMMPS_NS::PairGranTalus<PairGranHookeHistory>;
template class LAMMPS_NS::PairGranTalus<PairGranHertzHistory>;

#endif
