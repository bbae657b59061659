/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   fix ID group rigid/small/symplectic bodies keyword value ...

   Semi-implicit (symplectic) Euler for clumps, rigid sets of spheres:

     v += k ftm2v (F/M + g)      M, F = mass of the clump, force on it
     x += dt v                   of the center of mass
     L += k ftm2v T              angular momentum and torque about it, axes of space
     q turns freely by dt        see free_rotation.h

   k as in fix nve/sphere/symplectic, see StartTime. Spheres get their places and velocities from
   the clump. Free rotation keeps L to rounding and its energy without drift; a clump of one sphere
   moves as that sphere. With `order 2`, which is `start half`, spheres have the velocities that the
   clump gives them half way through the step, so that a contact finds from their changes those at
   the time of the positions, centripetal accelerations included.

   What clumps are, where they come from and how ranks share them: see FixRigidSmallTalus and fix
   rigid/small of LAMMPS, whose words for bodies, `mol`, `infile` and `reinit` are the same.

   Called by: Verlet::run() at the start of a step through Modify::initial_integrate().
   Restart: that of clumps, the start word, the lag and `way_back`.
   Errors: all by error->all on every rank. Constructor: words of the command. init(): run_style
   respa, minimize, particles that are no spheres, another fix that moves spheres of clumps, freezes
   them, or lets them fall a second time; with `order 2` see second_order_check.h.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(rigid/small/symplectic,FixRigidSmallSymplectic);
// clang-format on
#else

#ifndef LMP_FIX_RIGID_SMALL_SYMPLECTIC_H
#define LMP_FIX_RIGID_SMALL_SYMPLECTIC_H

#include "fix/clump/fix_rigid_small_talus.h"
#include "fix/motion/second_order_check.h"
#include "fix/motion/start_time.h"
#include "system/loads/constant_gravity.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixRigidSmallSymplectic : public FixRigidSmallTalus {
 public:
  FixRigidSmallSymplectic(class LAMMPS *, int, char **);
  void post_constructor() override {}
  int setmask() override;
  void init() override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  // SystemFix
  double next_kick_in_steps() const override;
  Talus::Kicks kicks() const override;
  int order() const override { return integration_order; }
  double lag() const override { return start.lag(); }
  bool keeps_changes() const override { return true; }
  void complete_step() override;
  void exchange_state(Talus::StateExchange &x) override;

 protected:
  std::string find_reason() override;
  bool given_masses_stay() const override { return true; }
  Talus::SphereMotion<double> sphere_motion_of(const Talus::ClumpState<double> &) const override;

 private:
  // the words of the stock style, and what the others say
  struct Settings {
    std::vector<char *> stock;
    StartTime start;
    int order = 1;
    ConstantGravity gravity;
    Settings(LAMMPS *, int, char **);
  };
  FixRigidSmallSymplectic(LAMMPS *, Settings);

  StartTime start;
  int integration_order;
  // spheres have the velocities of a moment that is so long before the end of the step: with order 2
  // those half way through it
  double way_back = 0.0;
  SecondOrderCheck second_order;
  ConstantGravity gravity;

  void check_fix(const Fix *) const;
  bigint count_common(const Fix *) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
