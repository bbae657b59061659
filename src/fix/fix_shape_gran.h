/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   fix ID group shape/gran type N shape args keyword value ... type M ...

   Gives all particles of some types a convex shape, and moves those of the group:

     v += dt ftm2v f/m      x += dt v
     L += dt ftm2v torque   orientation and omega: see body/motion/free_rotation.h

   Particles stay particles of atom style sphere: x is the center of mass, radius that of
   the sphere around the shape, rmass its mass; this fix sets both. The orientation
   (quaternion w x y z from the axes in which the shape was written to those of space)
   belongs to this fix: it travels with the particle, to ghosts, and into restart files.

   Called by: Verlet through Modify; GranularSystem, which hands over the pairs with a shape
   and asks for their forces.
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

#include "exchange/sparse_exchange.h"
#include "fix.h"
#include "fix/image_triangles.h"
#include "history/contact_lists.h"
#include "shaped/shape_table.h"
#include "shaped/shaped_pairs.h"
#include "shaped/wall_points.h"
#include "system/granular_system.h"
#include "system/run_monitor.h"
#include "system/system_shapes.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

class FixShapeGran : public Fix, public Talus::SystemShapes {
 public:
  FixShapeGran(class LAMMPS *, int, char **);
  ~FixShapeGran() override;
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
  bool moves_particle(int i) const override;
  void exchange_state(Talus::StateExchange &x) override;
  bool exchanges_all() const override { return true; }

  // SystemShapes
  bool is_shaped(int type) const override { return table.of(type) != nullptr; }
  double radius_of(int type) const override { return table.bounding_radius(type); }
  double inner_radius_of(int type) const override
  {
    return table.of(type)->shape().inscribed_radius();
  }
  double volume_of(int type) const override { return table.of(type)->shape().volume(); }
  const Talus::ParticleShape *shape_of(int type) const override { return table.of(type); }
  void keep_histories() override;
  double *const *orientations() const override { return quat; }
  void set_pairs(std::vector<std::array<int, 2>> pairs) override;
  void compute_contacts(const Talus::ContactStep &step) override;
  Talus::BodyLoad touch_body(Talus::LargeBody &body, const Talus::BodyStep &step) override;
  bool keeps_change_of(int i) const override { return moves_particle(i); }
  void for_each_contact_of_pairs(const VisitContact &visit) const override;
  void for_each_triangle(const VisitTriangle &visit) const override;
  Talus::DeepestContact deepest_contact() const override;
  Talus::DeepestContact deepest_since_rebuild() const override { return pairs.deepest_since_set(); }
  Talus::DeepestInBody deepest_in(const Talus::LargeBody &body) const override;
  double count_contacts() const override { return pairs.count_contacts(); }
  double count_candidates() const override { return pairs.count_candidates(); }

 private:
  int take_from(int i, const double *buf);
  // fix_shape_gran.cpp
  void set_sizes(int first, int last);
  void orient_new(int first, int last);
  Talus::ShapedView view() const;
  void set_maxexchange();
  using Load = Talus::ParticleState::Load;
  void keep_change(Talus::ChangeRecord &change, int i, const Load &load) const;
  void move(const Talus::ParticleState &particles, int i);
  void send_orientations();
  void list_particles(const Talus::LargeBody &body, Talus::WallPoints &points);
  static std::int64_t name_of(const Talus::LargeBody &body);
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
  void require_set_up() const;
  RunMonitor::Check check_of_cores();

  std::shared_ptr<Talus::GranularSystem> system;
  Talus::ShapeTable table;
  Talus::ShapedPairs pairs;
  struct Wall {
    std::unique_ptr<Talus::BodySurfaces> surfaces;
    std::unique_ptr<Talus::WallPoints> points;
  };
  Wall &wall_of(Talus::LargeBody &body);
  std::map<const Talus::LargeBody *, Wall> walls;
  double **quat = nullptr;    ///< w x y z of owned particles and ghosts; 0: not known yet
  bool orientations_were_set = false;    ///< by a command: ghosts do not know it
  bool is_set_up = false;                ///< setup_pre_neighbor() has been called
  int other_integrators = 0;             ///< bits of groups that other fixes move

  Talus::ContactLists histories;        ///< of contact points, while there are none
  bool histories_are_current = true;    ///< they hold all histories of contacts of owned particles
  Talus::SparseExchange exchange;

  std::vector<std::pair<std::string, int>> also_drawn;    ///< other fixes, and the type whose color
  Talus::ImageTriangles drawn;
};

}    // namespace LAMMPS_NS

#endif
#endif
