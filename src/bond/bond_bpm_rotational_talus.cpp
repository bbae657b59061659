/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "bond/bond_bpm_rotational_talus.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_bond_history.h"
#include "update.h"

using namespace LAMMPS_NS;

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
    BondBPMTalus(lmp, {sign_of_pressure, has_energy})
{
}

std::string BondBPMRotationalTalus::lacking_words() const
{
  return TALUS_HOST_HAS_BOND_FRAMES ? "" : "neither 'normalize' nor 'break'";
}

void BondBPMRotationalTalus::prepare()
{
  check_strengths({{"Fcr", Fcr}, {"Fcs", Fcs}, {"Tct", Tct}, {"Tcb", Tcb}}, "strength");
  bonds.set_model(model());
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

void BondBPMRotationalTalus::load_bonds(bool)
{
  if (bonds.count() == 0) return;
  const Talus::ParticleState now = system->step().particles();
  bonds.compute({now.positions(), now.velocities(), now.angular_velocities(), atom->quat[0],
                 fix_bond_history->bondstore[0], fix_bond_history->get_ndata(), sign_of_history},
                update->dt, comm->nthreads);
}

void BondBPMRotationalTalus::store_new(int n, int i, int j, bool)
{
  store_bond(n, i, j);
  if (update->setupflag) turned += is_turned(i) || is_turned(j);
}

/* Since its quaternion was 1 0 0 0, by more than a millionth: LAMMPS takes the direction of a new bond as if it had
   not. */

bool BondBPMRotationalTalus::is_turned(int i) const
{
  const double *const q = atom->quat[i];
  return q[1] * q[1] + q[2] * q[2] + q[3] * q[3] > 1e-12;
}

void BondBPMRotationalTalus::warn_of_new_bonds()
{
  MPI_Allreduce(MPI_IN_PLACE, &turned, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (turned > 0 && comm->me == 0)
    error->warning(
        FLERR, "Bond style bpm/rotational: new bonds of spheres that have turned begin strained: "
               "give 'set group all quat 0 0 1 0' before the first bonds are made");
  turned = 0;
}
