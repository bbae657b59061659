// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// fix large/body: a body that spans sub-domains, in contact with the particles of the group.
//
// A thin style: parses, checks, and hands the host's arrays to Talus::BodyContacts (src/body).
// Parts: large_body_shapes.h (shapes), large_body_motion.h (motions), large_body_surface.h
// (pictures, loads of triangles), fix_large_body_store.cpp (migration and restart).
// doc/fix_large_body.md is the user's page.

#ifndef LMP_FIX_LARGE_BODY_H
#define LMP_FIX_LARGE_BODY_H

#include "body/contact/body_contacts.h"
#include "body/shape/large_body_shape.h"
#include "fix.h"
#include "fix/large_body_monitor.h"
#include "fix/large_body_motion.h"
#include "fix/large_body_surface.h"
#include "laws/contact_words.h"
#include "system/effective_masses.h"
#include "system/granular_system.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

class FixLargeBody : public Fix, public Talus::SystemBody {
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

  /// For computes: from the next step on energies are accounted for; what the last step found on
  /// this rank.
  void keep_account() override { keeps_account = true; }
  const Talus::EnergyAccount &energy_account() const override { return account; }
  double contacts_here() const override { return mine.contacts; }
  double largest_overlap_ratio() const override { return contacts.largest_overlap_ratio(); }

  // SystemBody
  int group_bits() const override { return groupbit; }
  std::string name() const override { return std::string("fix large/body ") + id; }
  std::string needs_host_arrays() override;
  bool join_step() override;
  void add_to_slots(int thread, int begin, int end) override
  {
    contacts.add_to_slots(thread, begin, end);
  }

  /// For the critical time step: stiffness at an overlap of 1 % of the radius, and the effective
  /// mass, are those of a particle of this type, mass and radius against the body. Returns
  /// sqrt(m/k), 0 without stiffness.
  double contact_period(int type, double mass, double radius) override;

  /// Law and coefficients of contacts of particles of this type with the body.
  Talus::ContactLaw law_of(int type) const override { return specs[type].law; }
  Talus::ContactCoefficients coefficients_of(int type) override;

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
  void offer_output();
  void keep_history();
  void set_laws();
  Talus::BodyParticleView view() const;
  void list_particles();
  Talus::BodyFindings find_worst();
  void find_region();
  void find_frozen();
  void clear_frozen();
  Talus::BodyStep step_of(bool advance);
  void compute_contacts(const Talus::BodyParticleView &to, bool advance);
  void add_contacts(bool advance);
  void tally_virial();
  void collect_digits();
  void begin_reduction();
  void finish_reduction();
  void reduce_load();
  void reduce_exactly();

  std::shared_ptr<Talus::GranularSystem> system;
  bool two_sided = false;
  bool with_history = false, with_impact = false;
  std::unique_ptr<Talus::LargeBodyShape> shape;
  LargeBodyMotion motion;
  std::unique_ptr<LargeBodySurface> surface;
  LargeBodyMonitor monitor;
  std::vector<Talus::ContactSpec> specs;    // by type
  std::vector<bool> spec_is_set;
  Talus::BodyContacts contacts;
  EffectiveMasses masses;
  int already_frozen = 0;    // groups whose forces a fix freeze has set to zero before this fix

  bool keeps_account = false, has_forces = false;
  bool joined = false;    // forces of this step have been added by the pair style
  Talus::EnergyAccount account;
  std::vector<double> virials;    // by particle

  Talus::BodyLoad mine, total;    // of this rank, and of all
  bool reduced = false;           // forces and torques of total are those of the last step
  bool total_is_known = false;    // all of it is
  Talus::ExactLoad exact;
  static constexpr int size_digits = 6 * Talus::ExactSum::size;
  std::int64_t digits_here[size_digits] = {}, digits_of_all[size_digits] = {};
  MPI_Request reduction = MPI_REQUEST_NULL;
};

}    // namespace LAMMPS_NS

#endif
