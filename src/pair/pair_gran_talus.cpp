// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#if TALUS_HOST_HAS_GRANULAR

#include "pair/pair_gran_talus.h"

#include "laws/law_list.h"
#include "pair/pair_of_system_impl.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "modify.h"

#include <string>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

struct StockLaw {
  const char *style, *normal, *damping, *tangential;
};

template <class Stock> constexpr StockLaw law_of;
template <>
constexpr StockLaw law_of<PairGranHooke> = {"gran/hooke", "hooke", "mass_velocity", "dashpot"};
template <>
constexpr StockLaw law_of<PairGranHookeHistory> = {"gran/hooke/history", "hooke", "mass_velocity",
                                                   "multistep"};
template <>
constexpr StockLaw law_of<PairGranHertzHistory> = {"gran/hertz/history", "hertz", "viscoelastic",
                                                   "multistep"};

}    // namespace

/* ---------------------------------------------------------------------- */

template <class Stock> PairGranTalus<Stock>::PairGranTalus(LAMMPS *lmp) : PairOfSystem<Stock>(lmp)
{
  this->no_virial_fdotr_compute = 1;    // ghosts have no forces
  attached = this->system->attach(this, {law_of<Stock>.style, true, true});
}

template <class Stock> PairGranTalus<Stock>::~PairGranTalus()
{
  if (this->copymode) return;
  if (this->modify->get_fix_by_id(history_id()) && in_system())
    this->modify->delete_fix(history_id());
  this->system->detach(this);
}

template <class Stock> std::string PairGranTalus<Stock>::plain_style() const
{
  return law_of<Stock>.style;
}

/* That of the stock style, which restart files know. */

template <class Stock> std::string PairGranTalus<Stock>::history_id() const
{
  return "NEIGH_HISTORY_HH" + std::to_string(this->instance_me);
}

/* ---------------------------------------------------------------------- */

template <class Stock> void PairGranTalus<Stock>::init_style()
{
  const Atom *atom = this->atom;
  const bool complete = atom->radius_flag && atom->rmass_flag && atom->omega_flag &&
                        atom->torque_flag && this->comm->ghost_velocity;
  if (!complete) return Stock::init_style();    // which says what is missing
  if (!stock_reason) decide();
  if (!in_system()) return Stock::init_style();
  const std::string later = this->system->unsupported_settings();
  if (!later.empty())
    this->error->all(FLERR,
                     "Pair style {}: {}: it was accelerated in the last run, so use 'suffix off' "
                     "before pair_style, or set this before the first run",
                     plain_style(), later);

  set_laws();
  this->system->init_pair_style();
  if (this->history && !this->modify->get_fix_by_id(history_id()))
    this->modify->add_fix(history_id() + " all TALUS_PAIR_HISTORY");
}

template <class Stock> void PairGranTalus<Stock>::decide()
{
  stock_reason = find_reason_for_stock();
  if (!in_system()) this->system->detach(this);
}

template <class Stock> std::string PairGranTalus<Stock>::find_reason_for_stock()
{
  if (!attached)
    return "one pair style is accelerated, and " + this->system->style_name() + " is it";
  if (this->lmp->kokkos) return "the KOKKOS package is in use";
  if (!this->atom->tag_enable) return "particles have no IDs (atom_modify id no)";
  if (this->force->ftm2v != 1.0)
    return "the unit of force is not that of mass times acceleration in these units";
  for (const std::string &its : {this->system->unsupported_settings(), reason_of_fixes()})
    if (!its.empty()) return its;
  return this->history ? this->system->reason_against_history() : "";
}

/* Histories and canonical keys have to be put aside before a fix moves particles between ranks. */

template <class Stock> std::string PairGranTalus<Stock>::reason_of_fixes() const
{
  for (const auto &fix : this->modify->get_fix_list()) {
    if (fix->pre_exchange_migrate)
      return std::string("fix ") + fix->id + " (" + fix->style +
             "), which migrates atoms, is defined before the pair style";
    if (utils::strmatch(fix->id, "^TALUS_CONTACTS")) break;
  }
  return "";
}

/* The same for all pairs of types. The stock style has converted units and NULL. */

template <class Stock> void PairGranTalus<Stock>::set_laws()
{
  constexpr StockLaw its = law_of<Stock>;
  ContactSpec spec;
  spec.law.choose(Stage::NORMAL, find_law(Stage::NORMAL, its.normal));
  spec.law.choose(Stage::DAMPING, find_law(Stage::DAMPING, its.damping));
  spec.law.choose(Stage::TANGENTIAL, find_law(Stage::TANGENTIAL, its.tangential));
  spec.given["kn"] = this->kn;
  spec.given["kt"] = this->kt;
  spec.given["gn"] = this->gamman;
  spec.given["gt"] = this->gammat;
  spec.given["mu"] = this->xmu;
  if (this->limit_damping) spec.given["limit_damping"] = 1.0;

  LawBook &laws = this->system->laws();
  laws.resize(this->atom->ntypes);
  for (int i = 1; i <= this->atom->ntypes; i++)
    for (int j = i; j <= this->atom->ntypes; j++) laws.set(i, j, spec);
  this->system->laws_have_changed();
}

template <class Stock> double PairGranTalus<Stock>::init_one(int i, int j)
{
  return in_system() ? this->system->cutoff(i, j) : Stock::init_one(i, j);
}

/* ---------------------------------------------------------------------- */

template <class Stock> void PairGranTalus<Stock>::compute(int eflag, int vflag)
{
  if (in_system())
    this->compute_contacts(eflag, vflag);
  else
    Stock::compute(eflag, vflag);
}

template <class Stock>
double PairGranTalus<Stock>::single(int i, int j, int itype, int jtype, double rsq,
                                    double factor_coul, double factor_lj, double &fforce)
{
  if (!in_system()) return Stock::single(i, j, itype, jtype, rsq, factor_coul, factor_lj, fforce);
  double extra[PairOfSystem<Stock>::num_extra];
  fforce = this->force_of_pair(i, j, itype, jtype, rsq, extra);
  std::copy(extra, extra + this->single_extra, this->svector);
  return 0.0;
}

template <class Stock>
int PairGranTalus<Stock>::pack_forward_comm(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  return in_system() ? this->pack_masses(n, list, buf)
                     : Stock::pack_forward_comm(n, list, buf, pbc_flag, pbc);
}

template <class Stock> void PairGranTalus<Stock>::unpack_forward_comm(int n, int first, double *buf)
{
  if (in_system())
    this->unpack_masses(n, first, buf);
  else
    Stock::unpack_forward_comm(n, first, buf);
}

template <class Stock> double PairGranTalus<Stock>::memory_usage()
{
  return in_system() ? this->system->memory_usage() : Stock::memory_usage();
}

template class LAMMPS_NS::PairGranTalus<PairGranHooke>;
template class LAMMPS_NS::PairGranTalus<PairGranHookeHistory>;
template class LAMMPS_NS::PairGranTalus<PairGranHertzHistory>;

#endif
