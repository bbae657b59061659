// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// fix large/body: a body that spans sub-domains, in contact with the particles of the group.
//
// A thin style: reads its words (large_body_words.h), and calls Talus::LargeBody (system/bodies), which is the body, at the
// hooks of LAMMPS.
// doc/fix_large_body.md is the user's page.

#ifndef LMP_FIX_LARGE_BODY_H
#define LMP_FIX_LARGE_BODY_H

#include "fix.h"
#include "system/bodies/large_body.h"
#include "system/step/granular_system.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

class FixLargeBody : public Fix, public Talus::SystemFix {
 public:
  FixLargeBody(class LAMMPS *, int, char **);
  ~FixLargeBody() override;

  void post_constructor() override;
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
  void for_each_contact(const VisitContact &visit) const override { body->for_each_contact(visit); }

  void exchange_state(Talus::StateExchange &x) override;
  bool exchanges_all() const override { return true; }
  void state_is_restored() override { body->list_particles(); }

  void write_restart(FILE *) override;
  void restart(char *) override;
  double memory_usage() override;

 private:
  void offer_output();

  std::shared_ptr<Talus::GranularSystem> system;
  Talus::LargeBody *body;         // owned by the system
  std::vector<double> virials;    // by particle
};

}    // namespace LAMMPS_NS

#endif
