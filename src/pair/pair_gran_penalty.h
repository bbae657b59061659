// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// pair_style gran/penalty: penalty contact with friction between spheres.
//
// A thin style: it parses and checks, hands the host's arrays to Talus::ContactPipeline
// (src/contact), and answers the host's questions about single pairs. doc/pair_gran_penalty.md is
// the user's page.

#ifndef LMP_PAIR_GRAN_PENALTY_H
#define LMP_PAIR_GRAN_PENALTY_H

#include "comm/proxy_reader.h"
#include "contact/contact_pipeline.h"
#include "fix/fix_contact_store.h"
#include "lammps_compat.h"
#include "material/law_book.h"
#include "pair.h"
#include "laws/contact_words.h"
#include "system/contact_monitor.h"
#include "system/effective_masses.h"
#include "system/largest_radii.h"
#include "system/neighbor_source.h"
#include "system/record_forces.h"
#include "system/time_step_monitor.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

class PairGranPenalty : public Pair, public FixContactStore::Client, public Talus::ProxyReader {
 public:
  PairGranPenalty(class LAMMPS *);
  ~PairGranPenalty() override;

  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void compute(int, int) override;
  double single(int, int, int, int, double, double, double, double &) override;

  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;

  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  double memory_usage() override;
  double atom2cut(int) TALUS_OVERRIDE_ATOM2CUT;
  double radii2cut(double, double) TALUS_OVERRIDE_ATOM2CUT;

  /// For large bodies: the material of a type, as set by `pair_coeff type type`, or nullptr.
  const Talus::ContactSpec *own_spec(int type) const;
  Talus::FrictionMix mix_rule() const { return book.mix; }

  /// For computes: from the next step on energies are accounted for; what the last step found.
  void keep_account() { keeps_account = true; }
  const Talus::EnergyAccount &energy_account() const { return account; }
  const Talus::ContactPipeline &contacts() const { return pipeline; }
  const Talus::LawBook &laws() const { return book; }

  /// Steps that nobody looks at are made without the host's arrays, in the records of the contacts.
  /// The run style says before compute() whether the particles may stay there after it; the
  /// integrator then moves them there, and large bodies add their forces there.
  void keep_state(bool yes) { keeps_state = yes; }
  /// Who adds forces in such steps, in the order in which they act.
  void add_in_records(std::vector<Talus::RecordForces *> forces) { others = std::move(forces); }
  /// Contacts between particles exert torques.
  bool turns_particles() const { return pipeline.keeps_spins(); }
  bool holds_state() const { return pipeline.holds_state(); }
  /// Moves the owned particles of a group, until the end of the next compute(). Only if
  /// holds_state().
  void advance(const Talus::RecordStep &step, int groupbit);
  /// How far they went in the last step.
  Talus::RecordTravel travel() const { return pipeline.travel(); }
  /// Proxies are in the records already, until the end of the next compute(). Only if
  /// holds_state().
  void take_proxies_as_they_are() { proxies_are_there = true; }
  /// Owned particles whose states are exchanged, before compute().
  void set_sent_particles(const std::vector<int> &atoms) { sent = atoms; }
  Talus::ParticleRecords &records() { return pipeline.records(); }
  const int *slot_of_atom() const { return pipeline.particle_order().slot_of_atom.data(); }
  /// Ends holds_state(), if it does: the host's arrays are up to date again, on request with the
  /// forces that will move the particles in the next step.
  void return_state(bool with_forces);
  /// The same for some particles and for reading only.
  void show_state(const std::vector<int> &atoms) const;
  /// "", or why records do not do for this scene.
  std::string hazard_of_records() const;

  // FixContactStore::Client
  void look_at_pairs() override;
  void keep_history(Talus::KeptContacts &kept, bool particles_may_leave) override;
  void file_history(Talus::PartnerLists &partners) override;
  void adopt_first_copies(Talus::PartnerLists &partners,
                          const FixContactStore::GhostValues &ghosts) override;
  void renumber_pairs() override;
  void release_records() override;
  void release_pairs() override { pipeline.release(); }
  bool pairs_are_needed() const override { return account.waits_for_move(); }
  void velocities_have_moved() override;

  // ProxyReader
  bool reads_proxy_spins() const override;
  double share_without_proxies() const override;

 private:
  void allocate();
  void check_host();
  void create_store();
  void prepare_laws();
  void warn_small_periods();

  std::int32_t read_number(FILE *fp);
  Talus::TangentialHistory<double> history_of(int i, int j,
                                              Talus::ContactImpact<double> &impact) const;
  void finish_exchange();
  std::size_t others_that_join();
  Talus::ParticleView view() const;
  void tally(const Talus::ReportedContact &contact);
  void count_contacts();

  Talus::LawBook book;
  bool laws_current = false;
  std::string announced;    // last description of the laws in the log

  Talus::ContactPipeline pipeline;

  bool keeps_state = false, proxies_are_there = false;
  std::vector<int> sent;
  std::vector<Talus::RecordForces *> others;

  bool keeps_account = false;
  Talus::EnergyAccount account;

  NeighborSource neighbors;
  EffectiveMasses masses;
  LargestRadii radii;
  ContactMonitor monitor;
  TimeStepMonitor time_step;

  FixContactStore *store = nullptr;
  std::string store_id, placeholder_id;
};

}    // namespace LAMMPS_NS

#endif
