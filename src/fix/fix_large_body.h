// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// fix large/body: a body that spans sub-domains, in contact with the particles of the group.
//
// A thin style: parses, checks, moves the body, and calls Talus::LargeBody (src/system), which has
// its contacts, at the hooks of LAMMPS. Parts: large_body_shapes.h (shapes), large_body_motion.h
// (motions), large_body_surface.h (pictures, loads of triangles), fix_large_body_store.cpp
// (migration and restart).
// doc/fix_large_body.md is the user's page.

#ifndef LMP_FIX_LARGE_BODY_H
#define LMP_FIX_LARGE_BODY_H

#include "fix.h"
#include "fix/large_body_monitor.h"
#include "fix/large_body_motion.h"
#include "fix/large_body_side.h"
#include "fix/large_body_surface.h"
#include "fix/large_body_vertices.h"
#include "laws/contact_words.h"
#include "system/deforming_body.h"
#include "system/granular_system.h"
#include "system/large_body.h"
#include "system/steered_body.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

class FixLargeBody : public Fix,
                     public Talus::SystemFix,
                     public Talus::SteeredBody,
                     public Talus::DeformingBody {
 public:
  FixLargeBody(class LAMMPS *, int, char **);
  ~FixLargeBody() override;

  int setmask() override;
  void init() override;
  void post_integrate() override;
  void pre_exchange() override;
  void setup_post_neighbor() override;
  void post_neighbor() override;
  void min_post_neighbor() override;
  void setup(int) override;
  void min_setup(int) override;
  void post_force(int) override;
  void min_post_force(int) override;
  void end_of_step() override;
  void post_run() override;
  int modify_param(int, char **) override;

  /// Energy stored in and dissipated by the contacts, and that of a free body.
  double compute_scalar() override;
  /// force(3), torque(3), position(3), quaternion(4), velocity(3), angular velocity(3), contacts.
  double compute_vector(int) override;
  /// By triangle of a mesh: pressure, shear stress, shear work per area.
  double compute_array(int, int) override;
  int image(int *&, double **&) override;

  // SystemFix
  std::string needs_arrays() override;
  bool is_touched() const override { return true; }
  void for_each_contact(const VisitContact &visit) const override { body.for_each_contact(visit); }

  void exchange_state(Talus::StateExchange &x) override;
  bool exchanges_all() const override { return true; }
  void state_is_restored() override { body.list_particles(); }

  // SteeredBody
  const Talus::BodyState &present_state() const override { return motion.frame().state; }
  std::string guide(const Talus::BodyState &state, int steps) override;

  // DeformingBody
  std::string guide_vertices(const Places &places, const Places *velocities, int steps) override;
  Talus::VertexImpulses take_impulses() override { return vertices->take(); }

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;
  double memory_usage() override;

 private:
  void parse_keywords(Talus::Words &words);
  void parse_contact_words(Talus::Words &words);
  void parse_type(Talus::Words &words);
  [[noreturn]] static void refuse_two_laws(const Talus::Words &words, int back);
  void offer_output();
  void keep_history();
  void follow_region();

  std::shared_ptr<Talus::GranularSystem> system;
  Talus::LargeBody &body;    // owned by the system
  bool two_sided = false;
  LargeBodyMotion motion;
  std::unique_ptr<LargeBodyVertices> vertices;    // of a mesh whose vertices move
  std::unique_ptr<LargeBodySurface> surface;
  LargeBodySide side;
  LargeBodyMonitor monitor;
  std::vector<double> virials;    // by particle
};

}    // namespace LAMMPS_NS

#endif
