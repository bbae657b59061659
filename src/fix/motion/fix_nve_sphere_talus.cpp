/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "fix/motion/fix_nve_sphere_talus.h"

#include "fix/motion/plain_style.h"
#include "system/step/sphere_kicks.h"

#include "force.h"
#include "group.h"
#include "update.h"

using namespace LAMMPS_NS;

FixNVESphereTalus::FixNVESphereTalus(LAMMPS *lmp, int narg, char **arg) :
    FixNVESphere(lmp, narg, arg), system(Talus::GranularSystem::of(lmp))
{
}

void FixNVESphereTalus::post_constructor()
{
  restore_style(this, "nve/sphere");
}

void FixNVESphereTalus::init()
{
  FixNVESphere::init();
  reason = find_reason();
}

std::string FixNVESphereTalus::find_reason() const
{
  if (extra) return "it turns dipoles";
  if (utils::strmatch(update->integrate_style, "^respa")) return "run_style respa has levels";
  if (!system->pair_style().is_there()) return system->pair_style().reason_against();
  return "";
}

std::string FixNVESphereTalus::needs_arrays()
{
  if (!reason.empty()) return reason;
  return group->dynamic[igroup] ? "its group is dynamic" : "";
}

/* ---------------------------------------------------------------------- */

Talus::RecordStep FixNVESphereTalus::half_step() const
{
  Talus::RecordStep step{update->dt, 0.5 * update->dt * force->ftm2v, {0.0, 0.0, 0.0}, inertia};
  step.two_kicks = true;
  step.extrapolation = 0.5;    // the second of them
  return step;
}

void FixNVESphereTalus::initial_integrate(int vflag)
{
  if (!reason.empty()) return FixNVESphere::initial_integrate(vflag);
  system->step().advance(this, half_step());
}

/* Put off while particles stay in the records. */

void FixNVESphereTalus::final_integrate()
{
  if (!reason.empty()) return FixNVESphere::final_integrate();
  system->step().complete_step_of(*this);
}

void FixNVESphereTalus::complete_step()
{
  kick_spheres(lmp, igroup, half_step(), 0, false);
}
