// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "pair/pair_gran_penalty.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"

#include <algorithm>
#include <functional>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

constexpr int num_extra = 11;    // svector, see single()

}    // namespace

/* ---------------------------------------------------------------------- */

PairGranPenalty::PairGranPenalty(LAMMPS *lmp) : Pair(lmp), system(GranularSystem::of(lmp))
{
  single_enable = 1;
  no_virial_fdotr_compute = 1;
  centroidstressflag = CENTROID_NOTAVAIL;
  finitecutflag = 1;
  restartinfo = 1;
  respa_enable = 0;
  writedata = 0;
  comm_forward = 1;

  single_extra = num_extra;
  svector = new double[single_extra]();
  nextra = 2;
  pvector = new double[nextra]();

  system->attach(this);
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
  system->init_pair_style();
}

void PairGranPenalty::check_host()
{
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR, "Pair style gran/penalty requires atom attributes radius, rmass, omega and "
                      "torque: use 'atom_style sphere'");
  if (comm->ghost_velocity == 0)
    error->all(FLERR, "Pair style gran/penalty requires ghost atoms to store velocity: "
                      "add 'comm_modify vel yes'");
  if (force->newton_pair)
    error->all(FLERR, "Pair style gran/penalty requires 'newton off': put it before the simulation "
                      "box is defined");
  if (!atom->tag_enable)
    error->all(FLERR, "Pair style gran/penalty requires atom IDs: remove 'atom_modify id no'");
  if (lmp->kokkos)
    error->all(FLERR, "Pair style gran/penalty does not run with the KOKKOS package: "
                      "start LAMMPS without '-k on'");
}

double PairGranPenalty::init_one(int i, int j)
{
  const LawBook &book = system->laws();
  if (setflag[i][j] == 0) {
    if (setflag[i][i] == 0 || setflag[j][j] == 0)
      error->all(FLERR, "Pair style gran/penalty: no pair_coeff for types {} and {}", i, j);
    if (book.spec(i, i).law != book.spec(j, j).law)
      error->all(FLERR,
                 "Pair style gran/penalty: types {} ({}) and {} ({}) have different laws: "
                 "add 'pair_coeff {} {} ...'",
                 i, describe_law(book.law(i, i)), j, describe_law(book.law(j, j)), i, j);
    if (!book.can_mix(i, j))
      error->all(FLERR,
                 "Pair style gran/penalty: types {} and {} have a number and NULL for kt or gt: "
                 "add 'pair_coeff {} {} ...'",
                 i, j, i, j);
  }
  return system->cutoff(i, j);
}

/* ---------------------------------------------------------------------- */

void PairGranPenalty::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  const std::function<void(const ReportedContact &)> to_host = [this](const ReportedContact &c) {
    tally(c);
  };
  system->compute_contacts(vflag_either ? &to_host : nullptr);
  if (!eflag_global) return;
  // for compute pair; what two ranks compute counts half on each
  pvector[0] = system->contacts().count_contacts();
  pvector[1] = system->contacts().count_candidates();
}

/* To the host, with newton off, an index of a ghost means that nothing is tallied for it. */

void PairGranPenalty::tally(const ReportedContact &c)
{
  const int nobody = atom->nlocal;
  ev_tally_xyz(c.for_i ? c.i : nobody, c.for_j ? c.j : nobody, nobody, 0, 0.0, 0.0, c.force[0],
               c.force[1], c.force[2], c.separation[0], c.separation[1], c.separation[2]);
}

int PairGranPenalty::pack_forward_comm(int n, int *send, double *buf, int, int *)
{
  for (int k = 0; k < n; k++) buf[k] = system->mass_override()[send[k]];
  return n;
}

void PairGranPenalty::unpack_forward_comm(int n, int first, double *buf)
{
  std::copy(buf, buf + n, system->mass_override() + first);
}

/* ---------------------------------------------------------------------- */

double PairGranPenalty::memory_usage()
{
  return system->memory_usage();
}

double PairGranPenalty::atom2cut(int i)
{
  return 2.0 * atom->radius[i];
}

double PairGranPenalty::radii2cut(double r1, double r2)
{
  return r1 + r2;
}
