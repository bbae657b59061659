/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   fix ID group shape/gran type N shape args keyword value ... type M ...

   Gives all particles of some types a convex shape, and moves those of the group:

     v += dt ftm2v f/m      x += dt v
     L += dt ftm2v torque   orientation and omega: see body/motion/free_rotation.h

   Particles stay particles of atom style sphere: x is the center of mass, radius that of
   the sphere around the shape, rmass its mass; this fix sets both. The orientation
   (quaternion w x y z from the axes in which the shape was written to those of space)
   travels with the particle, to ghosts, and into restart files, by the hooks of this fix.

   Called by: Verlet through Modify. Particles and contacts are those of ShapedParticles
   (system/shapes), which the system owns.
   Before:    as fix nve/sphere/symplectic.
   Per-atom array: the orientation, zero of spheres.
   Global scalar: kinetic energy of the owned particles with a shape that this fix moves;
   global vector: see doc/fix_shape_gran.md.
   Errors: words of the command; in init() what cannot go with shapes, all by error->all.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(shape/gran,FixShapeGran);
// clang-format on
#else

#ifndef LMP_FIX_SHAPE_GRAN_H
#define LMP_FIX_SHAPE_GRAN_H

#include "fix.h"
#include "shape/contact/shape_table.h"
#include "system/bodies/image_triangles.h"
#include "system/monitor/run_monitor.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

class FixShapeGran : public Fix, public Talus::SystemFix {
 public:
  FixShapeGran(class LAMMPS *, int, char **);
  ~FixShapeGran() override;
  void post_constructor() override;
  int setmask() override;
  void init() override;
  void setup_pre_neighbor() override;
  void pre_neighbor() override;
  void initial_integrate(int) override;
  double compute_scalar() override;
  double compute_vector(int) override;
  int modify_param(int, char **) override;
  int image(int *&, double **&) override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_border(int, int *, double *) override;
  int unpack_border(int, int, double *) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;
  double memory_usage() override;

  // SystemFix
  std::string needs_arrays() override;
  bool integrates() const override { return true; }
  bool places_particles() const override { return true; }
  bool moves_particle(int i) const override { return shapes->moves(i); }
  void exchange_state(Talus::StateExchange &x) override;
  bool exchanges_all() const override { return true; }

 private:
  static constexpr int size_sums = 7;
  std::array<double, size_sums> sums() const;
  int add_to_picture(int narg, char **arg);

  // fix_shape_gran_check.cpp
  void check_scene();
  void check_pairs();
  void check_bodies();
  void check_fixes();
  void check_computes();
  void require_no_other_integrator() const;
  RunMonitor::Check check_of_cores();

  std::shared_ptr<Talus::GranularSystem> system;
  Talus::ShapedParticles *shapes = nullptr;    ///< owned by the system
  int other_integrators = 0;                   ///< bits of groups that other fixes move

  std::vector<std::pair<std::string, int>> also_drawn;    ///< other fixes, and the type whose color
  Talus::ImageTriangles drawn;
};

}    // namespace LAMMPS_NS

#endif
#endif
