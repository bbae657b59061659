/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "fix/motion/fix_nve_bpm_sphere_talus.h"

#include "body/motion/turn_spheres.h"
#include "fix/motion/plain_style.h"
#include "system/step/sphere_kicks.h"

#include "atom.h"
#include "comm.h"
#include "force.h"
#include "update.h"

using namespace LAMMPS_NS;

FixNVEBPMSphereTalus::FixNVEBPMSphereTalus(LAMMPS *lmp, int narg, char **arg) :
    FixNVEBPMSphere(lmp, narg, arg), system(Talus::GranularSystem::of(lmp))
{
}

void FixNVEBPMSphereTalus::post_constructor()
{
  restore_style(this, "nve/bpm/sphere");
}

void FixNVEBPMSphereTalus::init()
{
  FixNVEBPMSphere::init();
  reason = find_reason();
}

std::string FixNVEBPMSphereTalus::find_reason() const
{
#if TALUS_HOST_HAS_BOND_FRAMES
  if (extra) return "it turns dipoles";
#endif
  if (utils::strmatch(update->integrate_style, "^respa")) return "run_style respa has levels";
  return system->pair_style().reason_against();
}

std::string FixNVEBPMSphereTalus::needs_arrays()
{
  return reason.empty() ? "orientations are in the arrays" : reason;
}

/* ---------------------------------------------------------------------- */

Talus::RecordStep FixNVEBPMSphereTalus::half_step() const
{
  Talus::RecordStep step{update->dt, 0.5 * update->dt * force->ftm2v, {0.0, 0.0, 0.0}, inertia};
  step.two_kicks = true;
  step.extrapolation = 0.5;    // the second of them
  return step;
}

void FixNVEBPMSphereTalus::initial_integrate(int vflag)
{
  if (!reason.empty()) return FixNVEBPMSphere::initial_integrate(vflag);
  system->step().advance(this, half_step());
  turn();
}

void FixNVEBPMSphereTalus::turn()
{
  const int n = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;
  if (n == 0) return;
  Talus::turn_spheres({n, atom->mask, groupbit, atom->omega[0], atom->quat[0]}, update->dt,
                      comm->nthreads);
}

void FixNVEBPMSphereTalus::final_integrate()
{
  if (!reason.empty()) return FixNVEBPMSphere::final_integrate();
  system->step().complete_step_of(*this);
}

void FixNVEBPMSphereTalus::complete_step()
{
  kick_spheres(lmp, igroup, half_step(), 0, false);
}
