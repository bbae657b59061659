/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "bond/bond_bpm_rotational_talus.h"

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
#include <utility>
#include <vector>

using namespace LAMMPS_NS;
using Talus::BondEnds;

namespace {

/* The places of the words in bond_coeff of damping for bending and twisting differ between hosts, and so do the members
   that hold them; before frames there was one way to compute bonds, and no energy. Since then LAMMPS tallies a bond under
   tension as pressure, as no other bond. */

#if TALUS_HOST_HAS_BOND_FRAMES
constexpr double sign_of_history = -1.0;    // from the lower ID to the higher one
constexpr double sign_of_pressure = -1.0;
constexpr bool has_energy = true;
constexpr int frame_of_particle = 1, damping_by_rates = 1;    // of frame_style, damping_style
#else
constexpr double sign_of_history = 1.0;
constexpr double sign_of_pressure = 1.0;
constexpr bool has_energy = false;
#endif

}    // namespace

BondBPMRotationalTalus::BondBPMRotationalTalus(LAMMPS *lmp) :
    BondBPMRotational(lmp), system(Talus::GranularSystem::of(lmp))
{
}

void BondBPMRotationalTalus::settings(int narg, char **arg)
{
  BondBPMRotational::settings(narg, arg);
  from_file = false;
}

void BondBPMRotationalTalus::read_restart(FILE *fp)
{
  BondBPMRotational::read_restart(fp);
  from_file = !TALUS_HOST_HAS_BOND_FRAMES;
}

void BondBPMRotationalTalus::warn_of_words()
{
  if (from_file && comm->me == 0)
    error->warning(FLERR,
                   "Bond style bpm/rotational: restart files of this LAMMPS have neither "
                   "'normalize' nor 'break': if bond_style had them, repeat it with bond_coeff "
                   "after read_restart");
  from_file = false;
}

void BondBPMRotationalTalus::init_style()
{
  BondBPMRotational::init_style();
  // behind read_restart LAMMPS makes that of this style after it has looked for them, and leaves histories of other bonds
  // of a particle where they were when one breaks
  histories = modify->get_fix_by_style("BOND_HISTORY");
  n_histories = static_cast<int>(histories.size());
  warn_of_words();
  reason = find_reason();
  listed = nullptr;
  if (!reason.empty()) return;
  if (break_flag) check_strengths();
  bonds.set_model(model());
}

/* A load over a strength of 0 is infinite, or of no load no number. */

void BondBPMRotationalTalus::check_strengths() const
{
  const std::pair<const char *, const double *> strengths[] = {
      {"Fcr", Fcr}, {"Fcs", Fcs}, {"Tct", Tct}, {"Tcb", Tcb}};
  for (int t = 1; t <= atom->nbondtypes; t++)
    for (const auto &[word, of_type] : strengths)
      if (!(of_type[t] > 0.0))
        error->all(
            FLERR,
            "Bond style bpm/rotational: bond_coeff {}: {} = {} is no strength: give one above "
            "0, or 'bond_style bpm/rotational break no' for bonds that last",
            t, word, of_type[t]);
}

std::string BondBPMRotationalTalus::find_reason() const
{
  if (lmp->kokkos) return "the KOKKOS package is in use";
  if (force->bond != this || hybrid_flag) return "bond_style hybrid";
  if (force->newton_bond) return "newton is on for bonds: use 'newton on off'";
  return system->pair_style().reason_against();
}

Talus::BondModel BondBPMRotationalTalus::model() const
{
  Talus::BondModel of_all;
  of_all.per_length = normalize_flag != 0;
  of_all.breaks = break_flag != 0;
  of_all.smooth = smooth_flag != 0 && of_all.breaks;
#if TALUS_HOST_HAS_BOND_FRAMES
  if (frame_style != frame_of_particle) of_all.frame = Talus::BondFrame::AVERAGE;
  if (damping_style == damping_by_rates) of_all.damping = Talus::BondDamping::RATE;
  const double *const normal = gr, *const shear = gs, *const twist = gt, *const bend = gb;
#else
  const double *const normal = gnorm, *const shear = gslide, *const twist = gtwist,
                      *const bend = groll;
#endif
  of_all.coeffs.resize(atom->nbondtypes + 1);
  for (int t = 1; t <= atom->nbondtypes; t++)
    of_all.coeffs[t] = {{Kr[t], Ks[t], Kt[t], Kb[t]},
                        {Fcr[t], Fcs[t], Tct[t], Tcb[t]},
                        {normal[t], shear[t], twist[t], bend[t]}};
  return of_all;
}

/* ---------------------------------------------------------------------- */

void BondBPMRotationalTalus::compute(int eflag, int vflag)
{
  if (!reason.empty()) return BondBPMRotational::compute(eflag, vflag);
  const bool first = !fix_bond_history->stored_flag;
  begin_bonds();
  ev_init(eflag, vflag);
  if (first || neighbor->ago == 0 || listed != neighbor->bondlist ||
      num_listed != neighbor->nbondlist)
    take_list(first);
  const Talus::EnergyAccount &account = system->account();
  const bool accounted = account.is_asked();
  if (accounted)
    begin_step(*atom, update->dt, update->setupflag != 0, account.counted_of_last_step());
  else
    leave_out_step();
  if (bonds.count() > 0) {
    bonds.compute({atom->x[0], atom->v[0], atom->omega[0], atom->quat[0],
                   fix_bond_history->bondstore[0], fix_bond_history->get_ndata(), sign_of_history},
                  update->dt, comm->nthreads);
    break_bonds(accounted);
    add_loads(accounted);
    if (evflag) tally_bonds();
  }
  end_bonds();
}

/* The same bits in both ways: the loads of a particle are summed before they are added. */

void BondBPMRotationalTalus::add_loads(bool accounted)
{
  if (!accounted) return bonds.add_to(atom->f[0], atom->torque[0], comm->nthreads);
  bonds.add_to(force_of_bonds(), torque_of_bonds(), comm->nthreads);
  end_step(*atom);
}

/* A bond to a particle of another rank is there as well. */

double BondBPMRotationalTalus::share_of(int n) const
{
  const Talus::BondEnds &bond = bonds.bond(n);
  return 0.5 * ((bond.first < atom->nlocal) + (bond.second < atom->nlocal));
}

double BondBPMRotationalTalus::stored_energy() const
{
  double sum = 0.0;
  for (int n = 0; n < bonds.count(); n++) sum += share_of(n) * bonds.stored_energy(n);
  return sum;
}

/* What bonds were like at first is stored once, of all that there are; see take_list(). */

void BondBPMRotationalTalus::begin_bonds()
{
#if TALUS_HOST_HAS_BOND_FRAMES
  pre_compute();
#else
  if (fix_bond_history->stored_flag) return;
  fix_bond_history->stored_flag = true;
  store_data();
#endif
}

void BondBPMRotationalTalus::end_bonds()
{
#if TALUS_HOST_HAS_BOND_FRAMES
  post_compute();
#endif
}

/* With new neighbor lists: of two particles the one with the lower ID comes first. At first LAMMPS has taken what bonds
   are like from any image of a particle; as the list has them it is the same on any number of ranks. */

void BondBPMRotationalTalus::take_list(bool first)
{
  listed = neighbor->bondlist;
  num_listed = neighbor->nbondlist;
  const tagint *const tag = atom->tag;
  bigint turned = 0;
  std::vector<BondEnds> found;
  found.reserve(num_listed);
  for (int n = 0; n < num_listed; n++) {
    BondEnds bond{listed[n][0], listed[n][1], std::max(listed[n][2], 0)};
    if (tag[bond.second] < tag[bond.first]) std::swap(bond.first, bond.second);
    if (bond.type > 0 && (first || is_unset(n))) {
      store_bond(n, bond.first, bond.second);
      turned += is_turned(bond.first) || is_turned(bond.second);
    }
    found.push_back(bond);
  }
  const std::vector<std::int64_t> ids(tag, tag + atom->nlocal + atom->nghost);
  bonds.set_bonds(found, atom->nlocal, ids.data());
  if (first) warn_of_long_bonds();
  if (update->setupflag && neighbor->ago == 0) warn_of_turned_bonds(turned);
}

/* Since its quaternion was 1 0 0 0, by more than a millionth: LAMMPS takes the direction of a new bond as if it had
   not. */

bool BondBPMRotationalTalus::is_turned(int i) const
{
  const double *const q = atom->quat[i];
  return q[1] * q[1] + q[2] * q[2] + q[3] * q[3] > 1e-12;
}

void BondBPMRotationalTalus::warn_of_turned_bonds(bigint turned) const
{
  MPI_Allreduce(MPI_IN_PLACE, &turned, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (turned > 0 && comm->me == 0)
    error->warning(
        FLERR, "Bond style bpm/rotational: new bonds of spheres that have turned begin strained: "
               "give 'set group all quat 0 0 1 0' before the first bonds are made");
}

/* On more ranks LAMMPS ends where the other end is not there. */

void BondBPMRotationalTalus::warn_of_long_bonds() const
{
  double longest = 0.0;
  for (int n = 0; n < bonds.count(); n++) {
    const double *const a = atom->x[bonds.bond(n).first], *const b = atom->x[bonds.bond(n).second];
    longest = std::max(longest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
  }
  MPI_Allreduce(MPI_IN_PLACE, &longest, 1, MPI_DOUBLE, MPI_MAX, world);
  const double range = comm->get_comm_cutoff();
  if (longest > range && comm->me == 0)
    error->warning(FLERR,
                   "Bond style bpm/rotational: the longest bond has a length of {}, and ghosts are "
                   "known up to {}: more "
                   "ranks will miss its ends; give 'comm_modify cutoff' more than its length",
                   longest, range);
}

/* Of a bond that came with a particle: LAMMPS leaves its history at zero. */

bool BondBPMRotationalTalus::is_unset(int n) const
{
  constexpr double least_length = 1e-10;    // that of LAMMPS
  const double length = fix_bond_history->bondstore[n][0];
  return length < least_length || std::isnan(length);
}

/* In the order of the list, by LAMMPS' method: it stores what `store/local` asks for, and takes the bond from both
   particles; neighbor lists follow before the next forces. */

void BondBPMRotationalTalus::break_bonds(bool accounted)
{
  bonds.for_each_broken([=](int n) {
    const BondEnds bond = bonds.bond(n);
    if (accounted) add_broken(share_of(n) * bonds.stored_energy(n));
    neighbor->bondlist[n][2] = 0;
    process_broken(bond.first, bond.second);
    bonds.drop(n);
  });
}

void BondBPMRotationalTalus::tally_bonds()
{
  const double *const *x = atom->x;
  for (int n = 0; n < bonds.count(); n++) {
    if (bonds.is_dropped(n)) continue;
    const int i = bonds.bond(n).first, j = bonds.bond(n).second;
    const double *const f = bonds.force_on_first(n);
    double d[3];
    for (int k = 0; k < 3; k++) d[k] = sign_of_pressure * (x[i][k] - x[j][k]);
    ev_tally_xyz(i, j, atom->nlocal, 0, has_energy ? bonds.energy(n) : 0.0, f[0], f[1], f[2], d[0],
                 d[1], d[2]);
  }
}

double BondBPMRotationalTalus::memory_usage()
{
  return BondBPMRotational::memory_usage() + bonds.memory_usage();
}
