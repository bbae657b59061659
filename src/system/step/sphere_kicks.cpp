/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "system/step/sphere_kicks.h"

#include "particles/kick_and_drift.h"

#include "base/in_parallel.h"

#include "atom.h"
#include "comm.h"
#include "group.h"
#include "lammps.h"

using namespace LAMMPS_NS;

void LAMMPS_NS::kick_spheres(LAMMPS *lmp, int igroup, const Talus::RecordStep &step, int frozenbits,
                             bool drifts, Talus::ChangeRecord *changes)
{
  const Atom *const atom = lmp->atom;
  const int n = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;
  if (n == 0) return;

  // the arrays of LAMMPS are contiguous
  double *const x = atom->x[0];
  double *const v = atom->v[0];
  double *const omega = atom->omega[0];
  const double *const f = atom->f[0];
  const double *const torque = atom->torque[0];
  const double *const radius = atom->radius;
  const double *const rmass = atom->rmass;
  const int *const mask = atom->mask, groupbit = lmp->group->bitmask[igroup];
  const double dt = step.dt, kick = step.kick, inverse_c = 1.0 / step.inertia;
  const double extrapolation = step.extrapolation;
  const double gravity_kick[3] = {step.gravity_kick[0], step.gravity_kick[1], step.gravity_kick[2]};

  Talus::in_ranges(n, lmp->comm->nthreads, [=](int, int begin, int end) {
    for (int i = begin; i < end; i++) {
      if (!(mask[i] & groupbit)) continue;
      Talus::ChangeRecord *const change = changes ? changes + i : nullptr;
      const double per_mass = kick * (1.0 / rmass[i]), inverse_radius = 1.0 / radius[i];
      const double per_inertia = Talus::kick_per_inertia(per_mass, inverse_radius, inverse_c);
      const double falls = (mask[i] & frozenbits) ? 0.0 : 1.0;
      for (int d = 0; d < 3; d++) {
        const bigint k = 3 * static_cast<bigint>(i) + d;
        const double v_old = v[k], omega_old = omega[k];
        const double v_new = Talus::kicked(v_old, per_mass, f[k], falls * gravity_kick[d]);
        const double omega_new = Talus::kicked_omega(omega_old, per_inertia, torque[k]);
        v[k] = v_new;
        omega[k] = omega_new;
        if (change) {
          change->c[d] = static_cast<float>(extrapolation * (v_new - v_old));
          change->c[4 + d] =
              static_cast<float>(radius[i] * (extrapolation * (omega_new - omega_old)));
        }
        if (drifts) x[k] = Talus::drifted(x[k], dt, v_new);
      }
    }
  });
}
