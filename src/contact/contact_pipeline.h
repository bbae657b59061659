// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The contact forces between the spheres of one rank: narrow phase, kernels, sums in canonical
// order. Knows nothing of the host: the pair style hands arrays over and adds the result.
//
//   at a rebuild   file_history() (if the old pairs are still current), then
//                  pairs.order_particles(), pairs.add_pair()..., pairs.finish(), fetch_history()
//   every step     compute(), add_forces()

#ifndef TALUS_CONTACT_CONTACT_PIPELINE_H
#define TALUS_CONTACT_CONTACT_PIPELINE_H

#include "contact/candidate_list.h"
#include "contact/contact_batch.h"
#include "contact/contact_energy.h"
#include "contact/contact_history.h"
#include "contact/law_table.h"
#include "contact/narrow_phase.h"
#include "contact/particle_records.h"

#include <cstdint>
#include <vector>

namespace Talus {

/// One contact as reported on request: host's indices, force on i, x_i - x_j.
struct ReportedContact {
  int i, j;
  double force[3], separation[3];
};

class ContactPipeline {
 public:
  ContactPipeline();

  /// Laws of the scene, from the next rebuild on. `type` arrays count from 1.
  void set_laws(const LawTable &table);

  /// After pairs.finish(): types of all particles (host's numbering, owned and ghosts; not needed
  /// if the laws are uniform) and the history of the new pairs; for filed_tag see
  /// ContactHistory::fetch().
  void start_pairs(const int *type, const PartnerLists &partners,
                   const std::vector<std::int64_t> &filed_tag);

  /// Files the current history by particle. Empties the lists in a scene without history.
  void file_history(PartnerLists &partners) const;
  /// See ContactHistory::adopt_first_copies(). Call after file_history().
  void
  adopt_first_copies(PartnerLists &partners,
                     const std::function<const double *(int, std::int64_t)> &ghost_values) const;

  /// Computes all contacts. `advance` is false while a run is set up: histories are then only read.
  /// `report`, if given, receives every contact; `account`, if given, their energies.
  void compute(const ParticleView &host, double dt, bool advance,
               std::vector<ReportedContact> *report, EnergyAccount *account = nullptr);

  /// For energies: after the integrator has moved velocities, before particles are renumbered.
  void account_for_move(const double *v, const double *omega, double dt, EnergyAccount &to) const;

  /// Adds the sums of the last compute() to the host's arrays.
  void add_forces(double *f, double *torque) const { particles.add_to(pairs, f, torque); }

  /// History and onset of the pair (i, j) in the host's numbering as i sees it; zero if the pair is
  /// unknown.
  TangentialHistory<double> history_of(int i, int j) const;
  ContactOnset<double> onset_of(int i, int j) const;

  /// Touching and candidate pairs of the last compute(); pairs that another rank computes as well
  /// count half, so that the sums over all ranks are the numbers of pairs.
  double count_contacts() const;
  double count_candidates() const;

  /// Largest overlap over the smaller radius among the contacts of the last compute(); 0 without
  /// contacts.
  double largest_overlap_ratio() const;
  /// Smallest sqrt(m_eff/k) with the tangent stiffness k among the same contacts; 0 without
  /// contacts.
  double smallest_contact_period() const;
  /// Largest relative speed of the centres of candidate pairs.
  double largest_relative_speed() const;

  const LawTable &law_table() const { return laws; }
  bool keeps_history() const { return with_history; }
  bool keeps_spins() const { return with_friction; }
  double memory_usage() const;

  CandidateList pairs;

 private:
  double share_of_pair(std::int64_t pair) const;
  double overlap_of(std::int64_t pair) const;
  int row_of_pair(std::int64_t pair) const;
  template <bool friction, bool history> void compute_all(double dt, bool advance);
  int arrange(const std::uint32_t *contacts, int count);
  void place(std::uint32_t contact, int position, int lane);
  template <bool friction, bool history> void gather(int end);
  void gather_resistance(int end);
  void gather_onsets(int end);
  void finish_geometry(int end, bool radii_known);
  void finish_circles(int end);
  void run_kernels(double dt, bool advance);
  void keep_history(int end);
  void keep_onsets(int end);
  template <bool friction> void transpose_results(int end);
  void apply_weights(int end);
  template <bool friction> void add_up(const std::uint32_t *contacts, int count);
  void add_couples(const std::uint32_t *contacts, int count);
  std::int64_t pair_of(int i, int j) const;
  void account_block(int count, double dt);
  void report_block(const std::uint32_t *contacts, int count);

  LawTable laws;
  bool with_friction = false, with_history = false, with_onset = false, with_resistance = false;
  int block_size = ContactBatch::width;

  ParticleRecords particles;
  ContactHistory history;
  std::vector<int> slot_type;    ///< types in canonical order; empty if laws are uniform
  std::vector<std::uint32_t> contact_list;
  std::int64_t touching_pairs = 0;
  std::vector<ReportedContact> *report = nullptr;
  EnergyAccount *account = nullptr;

  // one block of contacts on its way through the kernels
  struct LawRange {
    int law, begin, end;
  };
  ContactBatch batch;
  std::uint32_t pair_of_lane[ContactBatch::width];
  int lane_of_contact[ContactBatch::width];
  std::vector<LawRange> ranges;
  Record force_of_lane[ContactBatch::width], moment_of_lane[ContactBatch::width],
      couple_of_lane[ContactBatch::width];
  alignas(64) double second_radius[ContactBatch::width];
};

}    // namespace Talus

#endif
