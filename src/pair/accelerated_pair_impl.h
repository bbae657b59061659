// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Members of AcceleratedPair: included by the sources of the styles.

#ifndef LMP_ACCELERATED_PAIR_IMPL_H
#define LMP_ACCELERATED_PAIR_IMPL_H

#include "pair/accelerated_pair.h"
#include "pair/pair_of_system_impl.h"
#include "system/host/fix_list.h"
#include "system/host/private_members.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "fix_dummy.h"
#include "force.h"
#include "modify.h"

namespace LAMMPS_NS {

/* The stock style keeps a place for the fix with its histories, whose ID restart files know. */

inline std::string id_without_dummy(std::string id)
{
  const std::string word = "_DUMMY";
  const std::size_t place = id.find(word);
  return place == std::string::npos ? id : id.erase(place, word.size());
}

template <class Stock>
AcceleratedPair<Stock>::AcceleratedPair(LAMMPS *lmp, const char *plain_style) :
    PairOfSystem<Stock>(lmp), plain(plain_style), history_id(id_without_dummy(this->fix_dummy->id))
{
  this->no_virial_fdotr_compute = 1;    // ghosts have no forces
  attached = this->system->attach(this, {plain, true, true});
}

template <class Stock> void AcceleratedPair<Stock>::leave_system()
{
  keep_stock_history("");
  this->system->detach(this);
}

/* ---------------------------------------------------------------------- */

template <class Stock> void AcceleratedPair<Stock>::init_style()
{
  const Atom *atom = this->atom;
  const bool complete = atom->radius_flag && atom->rmass_flag && atom->omega_flag &&
                        atom->torque_flag && this->comm->ghost_velocity;
  if (!complete) return Stock::init_style();    // which says what is missing
  if (!stock_reason) decide();
  if (!in_system()) return Stock::init_style();
  const std::string later = reason_that_came_later();
  if (!later.empty())
    this->error->all(FLERR,
                     "Pair style {}: {}: it was accelerated in the last run, so use 'suffix off' "
                     "before pair_style, or set this before the first run",
                     plain, later);

  this->system->setup_state().expect_new_laws();
  set_laws();
  this->system->init_pair_style();
  keep_stock_history(stock_history());
}

/* In restart files; again if models have changed. The number in the ID counts the pair styles of a process: a file has
   that of the process which wrote it. */

template <class Stock> void AcceleratedPair<Stock>::keep_stock_history(const std::string &values)
{
  if (values == kept_values) return;
  const std::string in_file = Talus::untaken_restart_data(
      *this->modify, history_id.substr(0, history_id.find_last_not_of("0123456789") + 1));
  if (kept_values.empty() && !in_file.empty() && !this->modify->get_fix_by_id(in_file))
    history_id = in_file;
  if (!kept_values.empty()) this->modify->delete_fix(history_id);
  if (!values.empty()) this->modify->add_fix(history_id + " all TALUS_PAIR_HISTORY" + values);
  kept_values = values;
}

template <class Stock> void AcceleratedPair<Stock>::decide()
{
  stock_reason = find_reason_for_stock();
  if (in_system()) return;
  this->system->detach(this);
  become_stock();
}

template <class Stock> std::string AcceleratedPair<Stock>::find_reason_for_stock() const
{
  if (!attached)
    return "one pair style is accelerated, and " + this->system->pair_style().name() + " is it";
  if (this->lmp->kokkos) return "the KOKKOS package is in use";
  if (!this->atom->tag_enable) return "particles have no IDs (atom_modify id no)";
  if (this->force->ftm2v != 1.0)
    return "the unit of force is not that of mass times acceleration in these units";
  for (const std::string &reason : {reason_that_came_later(), reason_of_fixes()})
    if (!reason.empty()) return reason;
  return stock_history().empty() ? "" : this->system->reason_against_history();
}

/* What a script may change between two runs. */

template <class Stock> std::string AcceleratedPair<Stock>::reason_that_came_later() const
{
  const std::string reason = reason_of_models();
  return reason.empty() ? this->unsupported_settings() : reason;
}

/* Histories and canonical keys have to be put aside before a fix moves particles between ranks. */

template <class Stock> std::string AcceleratedPair<Stock>::reason_of_fixes() const
{
  for (const auto &fix : Talus::fix_list(*this->modify)) {
    if (fix->pre_exchange_migrate)
      return std::string("fix ") + fix->id + " (" + fix->style +
             "), which migrates atoms, is defined before the pair style";
    if (utils::strmatch(fix->id, "^TALUS_CONTACTS")) break;
  }
  return "";
}

template <class Stock> double AcceleratedPair<Stock>::init_one(int i, int j)
{
  return in_system() ? init_pair_of_types(i, j) : Stock::init_one(i, j);
}

/* ---------------------------------------------------------------------- */

template <class Stock> void AcceleratedPair<Stock>::compute(int eflag, int vflag)
{
  if (in_system())
    this->compute_contacts(eflag, vflag);
  else
    Stock::compute(eflag, vflag);
}

template <class Stock>
double AcceleratedPair<Stock>::single(int i, int j, int itype, int jtype, double rsq,
                                      double factor_coul, double factor_lj, double &fforce)
{
  if (!in_system()) return Stock::single(i, j, itype, jtype, rsq, factor_coul, factor_lj, fforce);
  const std::optional<SinglePair> pair = this->look_at_pair(i, j, itype, jtype, rsq);
  fforce = pair ? pair->force_over_distance() : 0.0;
  report_single(pair);
  return 0.0;
}

template <class Stock>
int AcceleratedPair<Stock>::pack_forward_comm(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  return in_system() ? this->pack_masses(n, list, buf)
                     : Stock::pack_forward_comm(n, list, buf, pbc_flag, pbc);
}

template <class Stock>
void AcceleratedPair<Stock>::unpack_forward_comm(int n, int first, double *buf)
{
  if (in_system())
    this->unpack_masses(n, first, buf);
  else
    Stock::unpack_forward_comm(n, first, buf);
}

template <class Stock> double AcceleratedPair<Stock>::memory_usage()
{
  return in_system() ? this->system->memory_usage() : Stock::memory_usage();
}

}    // namespace LAMMPS_NS

#endif
