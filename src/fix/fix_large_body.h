// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// fix large/body: a body that spans sub-domains, in contact with the particles of the group.
//
// A thin style: parses, checks, and hands the host's arrays to Talus::BodyContacts (src/body).
// doc/fix_large_body.md is the user's page.

#ifndef LMP_FIX_LARGE_BODY_H
#define LMP_FIX_LARGE_BODY_H

#include "body/body_contacts.h"
#include "body/large_body_shape.h"
#include "fix.h"
#include "pair/contact_command.h"
#include "pair/effective_masses.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

class FixLargeBody : public Fix {
 public:
  FixLargeBody(class LAMMPS *, int, char **);
  ~FixLargeBody() override;

  int setmask() override;
  void init() override;
  void post_integrate() override;
  void setup_post_neighbor() override;
  void post_neighbor() override;
  void min_post_neighbor() override;
  void setup(int) override;
  void min_setup(int) override;
  void post_force(int) override;
  void min_post_force(int) override;

  /// force(3), torque(3), position(3), quaternion(4), velocity(3), angular velocity(3), contacts.
  double compute_vector(int) override;

  /// For computes: from the next step on energies are accounted for; what the last step found on
  /// this rank.
  void keep_account() { keeps_account = true; }
  const Talus::EnergyAccount &energy_account() const { return account; }
  double contacts_here() const { return load[6]; }
  double largest_overlap_ratio() const { return contacts.largest_overlap_ratio(); }

  /// For the critical time step: stiffness at an overlap of 1 % of the radius, and the effective
  /// mass, are those of a particle of this type, mass and radius against the body. Returns
  /// sqrt(m/k), 0 without stiffness.
  double contact_period(int type, double mass, double radius);

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
  int parse_shape(int narg, char **arg);
  void parse_keywords(int iarg, int narg, char **arg);
  void parse_contact_words(const CommandWords &words, int &iarg);
  double number(int iarg, int narg, char **arg, const char *name);
  Talus::Vector3<double> vector(int iarg, int narg, char **arg, const char *name);
  Talus::Vector3<double> direction(int iarg, int narg, char **arg, const char *name);
  void make_plane(int narg, char **arg);
  void make_rectangle(int narg, char **arg);
  void set_laws();
  Talus::ContactCoefficients coefficients_of(int type);
  Talus::BodyParticleView view() const;
  void reduce_load();
  void find_frozen();
  void clear_frozen();
  int size_packed() const;

  bool two_sided = false;
  bool with_history = false, with_onset = false;
  std::unique_ptr<Talus::LargeBodyShape> shape;
  std::vector<ContactSpec> specs;    // by type
  std::vector<bool> spec_is_set;
  Talus::BodyContacts contacts;
  EffectiveMasses masses;
  int already_frozen = 0;    // groups whose forces a fix freeze has set to zero before this fix

  bool keeps_account = false;
  Talus::EnergyAccount account;

  double load[7] = {};          // of this rank: force, torque, contacts
  double total_load[7] = {};    // of all ranks
  bigint reduced_at = -1;       // step of total_load
};

}    // namespace LAMMPS_NS

#endif
