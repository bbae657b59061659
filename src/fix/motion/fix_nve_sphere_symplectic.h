/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   fix ID group nve/sphere/symplectic keyword value ...

   Semi-implicit (symplectic) Euler for spheres, one pass over memory per step:

     v     += k ftm2v (f/m + g)           m = rmass
     x     += dt v
     omega += k ftm2v torque/(c m r^2)    c = 2/5, with `disc` 1/2
     q, mu  = rotated by dt |omega| about omega, with `orientation yes`

   All quantities are in the units of the `units` command, g as in fix gravity in
   force/mass, dt = update->dt.
   k = dt with `start plain`. With `start half` v and omega belong to a time that is behind
   that of x by lag(): k = lag + dt/2, then lag = dt/2, lag = 0 before the first step.
   With `order 2`, which is `start half`, contacts see lag k^-1 times the change of v and
   omega as well, which GranularSystem keeps.
   g is the constant acceleration of `gravity`, zero for particles of a `fix freeze`.

   Called by: Verlet::run() at the start of a step through Modify::initial_integrate().
   Before:    f and torque of owned particles belong to the present x and v (setup() or
              the previous step made them).
   After:     x, v, omega of owned members of the group are those of the new step;
              nothing is left for final_integrate(). Other particles are not touched.
   A particle's new state depends on its own old state only, not on its index, the
   decomposition or how the run is divided into `run` commands.

   Global scalar, with gravity: potential energy -sum m g.x (force distance units, unwrapped x).
   Restart: the start word and `lag`.
   Errors: all by error->all on every rank. Constructor: words of the command, atom style.
   init(): run_style respa, minimize, members of zero radius, and with gravity another fix
   that would apply gravity twice or cannot hold a particle against it; with `order 2` others
   that integrate, and contacts that are not of second order.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(nve/sphere/symplectic,FixNVESphereSymplectic);
// clang-format on
#else

#ifndef LMP_FIX_NVE_SPHERE_SYMPLECTIC_H
#define LMP_FIX_NVE_SPHERE_SYMPLECTIC_H

#include "fix.h"
#include "fix/motion/second_order_check.h"
#include "fix/motion/start_time.h"
#include "system/loads/constant_gravity.h"
#include "system/step/granular_system.h"

#include <functional>
#include <memory>
#include <string>

namespace LAMMPS_NS {

class FixNVESphereSymplectic : public Fix, public Talus::SystemFix {
 public:
  FixNVESphereSymplectic(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void initial_integrate(int) override;
  double compute_scalar() override;

  // SystemFix
  std::string needs_arrays() override;
  bool integrates() const override { return true; }
  int order() const override { return integration_order; }
  double lag() const override { return start.lag(); }
  double next_kick_in_steps() const override;
  const double *gravity_besides_forces() const override { return gravity.acceleration(); }
  Talus::Kicks kicks() const override;
  bool keeps_changes() const override { return true; }

  void write_restart(FILE *) override;
  void restart(char *) override;

 private:
  std::shared_ptr<Talus::GranularSystem> system;
  StartTime start;
  bool rotates = false;    // quaternion or dipole follows omega
  double inertia = 0.4;    // c of I = c m r^2
  int integration_order = 1;
  SecondOrderCheck second_order;
  ConstantGravity gravity;
  int frozenbits = 0;    // groups of fix freeze, with gravity only

  void parse_keyword(Talus::Words &);

  void check_fix(Fix *);
  bigint count_members(const std::function<bool(int)> &);

  Talus::RecordStep step_of(double, double) const;
  void rotate(double dt);
  void rotate(int i, double dt);
};

}    // namespace LAMMPS_NS

#endif
#endif
