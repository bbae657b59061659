// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "pair/pair_gran_penalty.h"

#include "base/told_numbers.h"
#include "pair/pair_of_system_impl.h"
#include "system/contacts/liquid_of_particles.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neighbor.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace Talus;

/* ---------------------------------------------------------------------- */

PairGranPenalty::PairGranPenalty(LAMMPS *lmp) : PairOfSystem(lmp)
{
  single_enable = 1;
  no_virial_fdotr_compute = 1;
  centroidstressflag = CENTROID_NOTAVAIL;
  finitecutflag = 1;
  restartinfo = 1;
  respa_enable = 0;
  writedata = 0;
  comm_forward = 2;    // at most, see init_style()

  single_extra = num_extra;
  svector = new double[single_extra]();
  nextra = 2;
  pvector = new double[nextra]();

  if (!system->attach(this, {plain_style()}))
    error->all(
        FLERR,
        "Pair style gran/penalty can be used only once, also in pair_style hybrid: give each "
        "pair of types a law of its own with pair_coeff");
}

PairGranPenalty::~PairGranPenalty()
{
  if (copymode) return;
  delete[] svector;
  delete[] pvector;
  system->detach(this);
  if (allocated) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
  }
}

void PairGranPenalty::allocate()
{
  allocated = 1;
  const int n = atom->ntypes + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) setflag[i][j] = 0;
  system->laws().resize(atom->ntypes);
}

/* ---------------------------------------------------------------------- */

void PairGranPenalty::init_style()
{
  check_host();
  system->setup_state().expect_new_laws();
  system->init_pair_style();
  comm_forward = system->masses().needed() + system->laws().shares_liquid();
  const std::string lists = system->neighbors().reason_for_lammps_lists();
  if (!lists.empty() && system->laws().reaches())
    error->all(FLERR,
               "Pair style gran/penalty: heat gas acts beyond the neighbor lists of LAMMPS, which "
               "are used because of {}: remove that, or use 'heat radius'",
               lists);
  if (!lists.empty() && system->range().largest_pulloff_distance() > neighbor->skin)
    error->all(FLERR,
               "Pair style gran/penalty: contacts of jkr or with a liquid bridge last beyond the "
               "neighbor lists of LAMMPS, "
               "which are used because of {}: use a skin of at least {:g} in the neighbor command",
               lists, rounded_up(system->range().largest_pulloff_distance(), 6));
}

void PairGranPenalty::check_host()
{
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR, "Pair style gran/penalty requires atom attributes radius, rmass, omega and "
                      "torque: use 'atom_style sphere'");
  if (comm->ghost_velocity == 0)
    error->all(FLERR, "Pair style gran/penalty requires ghost atoms to store velocity: "
                      "add 'comm_modify vel yes'");
  if (!atom->tag_enable)
    error->all(FLERR, "Pair style gran/penalty requires atom IDs: remove 'atom_modify id no'");
  if (lmp->kokkos)
    error->all(FLERR, "Pair style gran/penalty does not run with the KOKKOS package: "
                      "start LAMMPS without '-k on'");
  if (system->laws().conducts_heat() && !(atom->temperature_flag && atom->heatflow_flag))
    error->all(FLERR, "Pair style gran/penalty: heat is conducted between particles that have a "
                      "temperature: add 'fix ID all property/atom temperature heatflow ghost yes'");
  if (system->laws().shares_liquid() && !particles_have_liquid(*atom))
    error->all(FLERR, "Pair style gran/penalty: bridges with 'share' have the liquid of particles: "
                      "add 'fix ID all property/atom d_liquid ghost yes', and liquid, as by 'set "
                      "group all d_liquid V'");
  const std::string problem = unsupported_settings();
  if (!problem.empty()) error->all(FLERR, "Pair style gran/penalty: {}: remove it", problem);
}

double PairGranPenalty::init_one(int i, int j)
{
  const PairCoeffs &pair_coeffs = system->laws();
  if (setflag[i][j] == 0) {
    if (setflag[i][i] == 0 || setflag[j][j] == 0)
      error->all(FLERR, "Pair style gran/penalty: no pair_coeff for types {} and {}", i, j);
    if (pair_coeffs.spec(i, i).law != pair_coeffs.spec(j, j).law)
      error->all(FLERR,
                 "Pair style gran/penalty: types {} ({}) and {} ({}) have different laws: "
                 "add 'pair_coeff {} {} ...'",
                 i, describe_law(pair_coeffs.law(i, i)), j, describe_law(pair_coeffs.law(j, j)), i,
                 j);
    if (!pair_coeffs.can_mix(i, j))
      error->all(FLERR,
                 "Pair style gran/penalty: types {} and {} have a number and NULL for kt or gt: "
                 "add 'pair_coeff {} {} ...'",
                 i, j, i, j);
  }
  if (const int type = pair_coeffs.type_without_moduli(i, j))
    error->all(FLERR,
               "Pair style gran/penalty: E and nu of types {} and {} are NULL, and type {} has no "
               "material to take them from: set 'pair_coeff {} {}' with a material law, or write "
               "numbers",
               i, j, type, type, type);
  return system->range().cutoff(i, j);
}

/* ---------------------------------------------------------------------- */

void PairGranPenalty::compute(int eflag, int vflag)
{
  compute_contacts(eflag, vflag);
  if (!eflag_global) return;
  // for compute pair; what two ranks compute counts half on each
  pvector[0] = system->contacts().count();
  pvector[1] = system->contacts().count_candidates();
}

double PairGranPenalty::single(int i, int j, int itype, int jtype, double rsq, double, double,
                               double &fforce)
{
  const std::optional<SinglePair> pair = look_at_pair(i, j, itype, jtype, rsq);
  fforce = pair ? pair->force_over_distance() : 0.0;
  describe_pair(pair, svector);
  return 0.0;
}

/* Whatever there is of both, by column. */

int PairGranPenalty::pack_forward_comm(int n, int *send, double *buf, int, int *)
{
  double *next = buf;
  if (system->masses().needed()) next += pack_masses(n, send, next);
  if (!system->laws().shares_liquid()) return static_cast<int>(next - buf);
  const double *liquid = liquid_of_particles(*atom);
  for (int k = 0; k < n; k++) *next++ = liquid[send[k]];
  return static_cast<int>(next - buf);
}

void PairGranPenalty::unpack_forward_comm(int n, int first, double *buf)
{
  const double *next = buf;
  if (system->masses().needed()) {
    unpack_masses(n, first, next);
    next += n;
  }
  if (system->laws().shares_liquid()) std::copy(next, next + n, liquid_of_particles(*atom) + first);
}

/* ---------------------------------------------------------------------- */

double PairGranPenalty::memory_usage()
{
  return system->memory_usage();
}

double PairGranPenalty::atom2cut(int i)
{
  return radii2cut(atom->radius[i], atom->radius[i]);
}

double PairGranPenalty::radii2cut(double r1, double r2)
{
  return r1 + r2 + system->range().largest_pulloff_distance();
}
