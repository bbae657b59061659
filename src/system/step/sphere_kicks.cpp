/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "system/step/sphere_kicks.h"

#include "base/in_parallel.h"

#include "atom.h"
#include "comm.h"
#include "group.h"
#include "lammps.h"

using namespace LAMMPS_NS;
using Talus::change_by_kick;
using Talus::record_of;
using Talus::Vec4;
using Talus::write_row;

void LAMMPS_NS::kick_spheres(LAMMPS *lmp, int igroup, Talus::RecordStep step, int frozenbits,
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
  step.two_kicks = false;
  const Talus::KickAndDrift kick(step);
  const double extrapolation = step.extrapolation;

  Talus::in_ranges(n, lmp->comm->nthreads, [=](int, int begin, int end) {
    for (int i = begin; i < end; i++) {
      if (!(mask[i] & groupbit)) continue;
      const bigint k = 3 * static_cast<bigint>(i);
      const Vec4 v_old = record_of(v + k, 1.0 / rmass[i]),
                 w_old = record_of(omega + k, 1.0 / radius[i]);
      const Vec4 v_new = kick.velocity(v_old, record_of(f + k, 0.0), !(mask[i] & frozenbits));
      const Vec4 w_new = kick.omega(w_old, v_old, record_of(torque + k, 0.0));
      write_row(v_new, v + k);
      write_row(w_new, omega + k);
      if (changes)
        store(changes[i], change_by_kick(extrapolation, radius[i], v_old, v_new, w_old, w_new));
      if (drifts) write_row(kick.position(record_of(x + k, 0.0), v_new), x + k);
    }
  });
}
