/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "bond/bond_bpm_talus.h"

#include "BPM/bond_bpm_rotational.h"
#include "BPM/bond_bpm_spring.h"
#include "bonds/rotational_bonds.h"
#include "bonds/spring_bonds.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_bond_history.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace LAMMPS_NS;
using Talus::BondEnds;

template <class Base, class Bonds>
BondBPMTalus<Base, Bonds>::BondBPMTalus(LAMMPS *lmp, Tally of_style) :
    Base(lmp), system(Talus::GranularSystem::of(lmp)), tally(of_style)
{
}

template <class Base, class Bonds> void BondBPMTalus<Base, Bonds>::settings(int narg, char **arg)
{
  Base::settings(narg, arg);
  from_file = false;
}

template <class Base, class Bonds> void BondBPMTalus<Base, Bonds>::read_restart(FILE *fp)
{
  Base::read_restart(fp);
  from_file = true;
}

template <class Base, class Bonds> void BondBPMTalus<Base, Bonds>::warn_of_words()
{
  const std::string words = lacking_words();
  if (from_file && !words.empty() && this->comm->me == 0)
    this->error->warning(FLERR,
                         "Bond style {}: restart files of this LAMMPS have {}: if bond_style had "
                         "such words, repeat it with bond_coeff after read_restart",
                         plain_style(), words);
  from_file = false;
}

template <class Base, class Bonds> void BondBPMTalus<Base, Bonds>::init_style()
{
  Base::init_style();
  // behind read_restart LAMMPS makes that of this style after it has looked for them, and leaves histories of other bonds
  // of a particle where they were when one breaks
  this->histories = this->modify->get_fix_by_style("BOND_HISTORY");
  this->n_histories = static_cast<int>(this->histories.size());
  warn_of_words();
  reason = find_reason();
  listed = nullptr;
  if (reason.empty()) prepare();
}

/* A load over a strength of 0 is infinite, or of no load no number. */

template <class Base, class Bonds>
void BondBPMTalus<Base, Bonds>::check_strengths(Strengths strengths, const char *what) const
{
  if (!this->break_flag) return;
  for (int t = 1; t <= this->atom->nbondtypes; t++)
    for (const auto &[word, of_type] : strengths)
      if (!(of_type[t] > 0.0))
        this->error->all(FLERR,
                         "Bond style {0}: bond_coeff {1}: {2} = {3} is no {4}: give one above 0, "
                         "or 'bond_style {0} break no' for bonds that last",
                         plain_style(), t, word, of_type[t], what);
}

template <class Base, class Bonds> std::string BondBPMTalus<Base, Bonds>::find_reason() const
{
  if (this->lmp->kokkos) return "the KOKKOS package is in use";
  if (this->force->bond != this || this->hybrid_flag) return "bond_style hybrid";
  if (this->force->newton_bond) return "newton is on for bonds: use 'newton on off'";
  return system->pair_style().reason_against();
}

/* In the records the pair style of Talus alone computes pairs, and its contacts may have no torques. */

template <class Base, class Bonds> std::string BondBPMTalus<Base, Bonds>::needs_arrays() const
{
  if (!system->pair_style().is_alone()) return "the pair style is hybrid";
  if (!Bonds::has_torques) return "";
  if (system->shapes()) return "there are particles with a shape";
  return system->law_table().has_friction() ? "" : "contacts have no torques";
}

/* ---------------------------------------------------------------------- */

template <class Base, class Bonds> void BondBPMTalus<Base, Bonds>::compute(int eflag, int vflag)
{
  if (!reason.empty()) return Base::compute(eflag, vflag);
  const bool first = !this->fix_bond_history->stored_flag;
  begin_bonds();
  this->ev_init(eflag, vflag);
  if (first || this->neighbor->ago == 0 || listed != this->neighbor->bondlist ||
      num_listed != this->neighbor->nbondlist)
    take_list(first);
  const Talus::EnergyAccount &account = system->account();
  const bool accounted = account.is_asked();
  if (accounted)
    begin_step(system->step().particles(), this->update->dt, this->update->setupflag != 0,
               account.counted_of_last_step());
  else
    leave_out_step();
  load_bonds(first);
  if (bonds.count() > 0) {
    break_bonds(accounted);
    account_for_broken();
    add_loads(accounted);
    if (this->evflag) tally_bonds();
  }
  end_bonds();
}

/* The loads of a particle are summed before they are added. */

template <class Base, class Bonds> void BondBPMTalus<Base, Bonds>::add_loads(bool accounted)
{
  const int threads = this->comm->nthreads;
  const Talus::ParticleState particles = system->step().particles();
  bonds.add_to(particles, threads);
  if (!accounted) return;
  Talus::ParticleView alone{};
  alone.f = force_of_bonds();
  if (Bonds::has_torques) alone.torque = torque_of_bonds();
  bonds.add_to({this->atom->nlocal, alone, this->atom->type}, threads);
  end_step(particles);
}

/* A bond to a particle of another rank is there as well. */

template <class Base, class Bonds> double BondBPMTalus<Base, Bonds>::share_of(int n) const
{
  const int owned = this->atom->nlocal;
  const BondEnds &bond = bonds.bond(n);
  return 0.5 * ((bond.first < owned) + (bond.second < owned));
}

template <class Base, class Bonds> double BondBPMTalus<Base, Bonds>::stored_energy() const
{
  double sum = 0.0;
  for (int n = 0; n < bonds.count(); n++) sum += share_of(n) * bonds.stored_energy(n);
  return sum;
}

/* What bonds were like at first is stored once, of all that there are; see take_list(). */

template <class Base, class Bonds> void BondBPMTalus<Base, Bonds>::begin_bonds()
{
#if TALUS_HOST_HAS_BOND_STAGES
  this->pre_compute();
#else
  if (this->fix_bond_history->stored_flag) return;
  this->fix_bond_history->stored_flag = true;
  this->store_data();
#endif
}

template <class Base, class Bonds> void BondBPMTalus<Base, Bonds>::end_bonds()
{
#if TALUS_HOST_HAS_BOND_STAGES
  this->post_compute();
#endif
}

/* With new neighbor lists: of two particles the one with the lower ID comes first. At first LAMMPS has taken what bonds
   are like from any image of a particle; as the list has them it is the same on any number of ranks. */

template <class Base, class Bonds> void BondBPMTalus<Base, Bonds>::take_list(bool first)
{
  listed = this->neighbor->bondlist;
  num_listed = this->neighbor->nbondlist;
  const Atom &of = *this->atom;
  const tagint *const tag = of.tag;
  std::vector<BondEnds> found;
  found.reserve(num_listed);
  for (int n = 0; n < num_listed; n++) {
    BondEnds bond{listed[n][0], listed[n][1], std::max(listed[n][2], 0)};
    if (tag[bond.second] < tag[bond.first]) std::swap(bond.first, bond.second);
    if (bond.type > 0 && (first || is_unset(n))) store_new(n, bond.first, bond.second, first);
    found.push_back(bond);
  }
  const std::vector<std::int64_t> ids(tag, tag + of.nlocal + of.nghost);
  bonds.set_bonds(found, of.nlocal, ids.data());
  if (first) warn_of_long_bonds();
  if (this->update->setupflag && this->neighbor->ago == 0) warn_of_new_bonds();
}

/* On more ranks LAMMPS ends where the other end is not there. */

template <class Base, class Bonds> void BondBPMTalus<Base, Bonds>::warn_of_long_bonds() const
{
  double longest = 0.0;
  for (int n = 0; n < bonds.count(); n++) {
    const double *const a = this->atom->x[bonds.bond(n).first], *const b =
                                                                    this->atom
                                                                        ->x[bonds.bond(n).second];
    longest = std::max(longest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
  }
  MPI_Allreduce(MPI_IN_PLACE, &longest, 1, MPI_DOUBLE, MPI_MAX, this->world);
  const double range = this->comm->get_comm_cutoff();
  if (longest > range && this->comm->me == 0)
    this->error->warning(FLERR,
                         "Bond style {}: the longest bond has a length of {}, and ghosts are "
                         "known up to {}: more "
                         "ranks will miss its ends; give 'comm_modify cutoff' more than its length",
                         plain_style(), longest, range);
}

/* Of a bond that came with a particle: LAMMPS leaves its history at zero. */

template <class Base, class Bonds> bool BondBPMTalus<Base, Bonds>::is_unset(int n) const
{
  constexpr double least_length = 1e-10;    // that of LAMMPS
  const double length = this->fix_bond_history->bondstore[n][0];
  return length < least_length || std::isnan(length);
}

/* In the order of the list, by LAMMPS' method: it stores what `store/local` asks for, and takes the bond from both
   particles; neighbor lists follow before the next forces. */

template <class Base, class Bonds> void BondBPMTalus<Base, Bonds>::break_bonds(bool accounted)
{
  bonds.for_each_broken([=](int n) {
    const BondEnds bond = bonds.bond(n);
    if (accounted) add_broken(share_of(n) * bonds.stored_energy(n));
    this->neighbor->bondlist[n][2] = 0;
    system->step().show({bond.first, bond.second});    // `store/local` may ask where they are
    this->process_broken(bond.first, bond.second);
    bonds.drop(n);
  });
}

template <class Base, class Bonds> void BondBPMTalus<Base, Bonds>::tally_bonds()
{
  const double *const *x = this->atom->x;
  for (int n = 0; n < bonds.count(); n++) {
    if (bonds.is_dropped(n)) continue;
    const int i = bonds.bond(n).first, j = bonds.bond(n).second;
    const double *const f = bonds.force_on_first(n);
    double d[3];
    for (int k = 0; k < 3; k++) d[k] = tally.sign_of_pressure * (x[i][k] - x[j][k]);
    this->ev_tally_xyz(i, j, this->atom->nlocal, 0, tally.has_energy ? bonds.energy(n) : 0.0, f[0],
                       f[1], f[2], d[0], d[1], d[2]);
  }
}

template <class Base, class Bonds> double BondBPMTalus<Base, Bonds>::memory_usage()
{
  return Base::memory_usage() + bonds.memory_usage();
}

namespace LAMMPS_NS {
template class BondBPMTalus<BondBPMRotational, Talus::RotationalBonds>;
template class BondBPMTalus<BondBPMSpring, Talus::SpringBonds>;
}    // namespace LAMMPS_NS
