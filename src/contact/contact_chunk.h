// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// One part of the contact work of a rank: it computes the contacts that belong to it (see
// ParticleOrder::divide()) and adds the forces on its own particles, and on no others. Parts need
// no locks, may run at the same time or one after the other, and give the same bits as one part
// alone. They serve threads (ranges of particles) and the overlap of communication (particles
// without ghost partners first).
//
// A contact between particles of two parts is computed by the part of the second, which hands the
// force on the first one over. In two phases, where parts do not follow each other in the order, it
// is computed by both, from the same numbers in the same order, and each keeps a history of it.

#ifndef TALUS_CONTACT_CONTACT_CHUNK_H
#define TALUS_CONTACT_CONTACT_CHUNK_H

#include "base/aligned_vector.h"
#include "contact/outgoing_forces.h"
#include "history/contact_history.h"
#include "laws/contact_batch.h"
#include "laws/contact_energy.h"
#include "material/law_table.h"
#include "neighbors/pair_list.h"
#include "particles/particle_records.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace Talus {

/// One contact as reported on request: host's indices, force on i, x_i - x_j. A part reports all
/// its contacts, in the order in which it adds them up; `for_i` and `for_j` say on which of the
/// particles it acts, so that every owned particle gets each of its contacts once, and in
/// canonical order.
struct ReportedContact {
  int i, j;
  bool for_i, for_j;
  double force[3], separation[3];
};

/// What all parts of a rank share.
struct ContactScene {
  LawTable laws;
  bool with_friction = false, with_history = false, with_impact = false, with_resistance = false;
  std::vector<int> slot_type;    ///< types in canonical order; empty if laws are uniform

  int row_of(int slot_a, int slot_b) const
  {
    return laws.uniform() ? 0 : laws.row(slot_type[slot_a], slot_type[slot_b]);
  }
};

/// How a step is computed. `advance` is false while a run is set up: histories are then only read.
/// `report`, if given, is called for every contact; `account`, if given, the energies of those that
/// count here; both are not for use by several threads. `meanwhile`, if given, is called now and
/// then, by the first part and so by the first thread: for messages that need someone to look after
/// them. `add_more`, if given, adds other forces to the sums of slots begin ... end-1 when all
/// contacts of these are added: called once by each thread, with its number and range.
struct ContactStep {
  double dt;
  bool advance;
  const std::function<void(const ReportedContact &)> *report = nullptr;
  EnergyAccount *account = nullptr;
  const std::function<void()> *meanwhile = nullptr;
  const std::function<void(int thread, int begin, int end)> *add_more = nullptr;
  bool read = true, read_ghosts = true, deliver = true;    ///< see ContactPipeline::compute()
};

class ContactChunk {
 public:
  /// Makes the state of the slots begin ... end-1 that belong to a part the present one, and clears
  /// their sums; other parts are not touched.
  using Bring = std::function<void(int begin, int end)>;

  ContactChunk();

  /// After pairs.collect(): histories of the new pairs, see ContactHistory::fetch().
  void start_pairs(const ContactScene &scene, const HistoryStore &histories);

  /// Gives the memory of what the last compute() found back: it found nothing, as far as one can
  /// ask.
  void forget_contacts();

  /// Computes all contacts of this part and adds their forces to the sums of its particles. All of
  /// its slots are brought on the way, a while before they are needed, so that they pass through
  /// the cache once; slots of other parts must be there from the beginning.
  void compute(const ContactScene &scene, ParticleRecords &particles, const ContactStep &step,
               const Bring &bring);

  /// visit(pair) for every contact of the last compute() that is counted here.
  template <class Visit> void for_each_contact(Visit visit) const
  {
    for (std::int64_t n = 0; n < touching; n++)
      if (!pairs.shared() || pairs.counts(contacts[n])) visit(contacts[n]);
  }

  int row_of_pair(const ContactScene &scene, std::int64_t pair) const
  {
    return scene.row_of(pairs.first[pair], pairs.second[pair]);
  }

  double memory_usage() const;

  /// After compute(): what is to be added to particles of other parts.
  const OutgoingForces &handed_over() const { return outgoing; }

  PairList pairs;
  ContactHistory history;

 private:
  struct Step : ContactStep {
    const ContactScene &scene;
    ParticleRecords &particles;
    const Bring &bring;
  };
  template <bool friction, bool history_kept, class Target>
  void compute_all(const Step &step, Target target);
  template <bool friction, bool history_kept, class Target>
  void compute_block(const Step &step, Target target, std::int64_t begin, int count);
  void prefetch_distant(const ParticleRecords &particles, std::size_t &next,
                        std::int64_t end) const;
  TALUS_INLINE void prefetch_own(const ParticleRecords &particles);
  int arrange(const ContactScene &scene, const std::uint32_t *contacts, int count);
  void place(std::uint32_t contact, int position, int lane);
  template <bool friction, bool history_kept>
  void gather(const ParticleRecords &particles, int end);
  void gather_resistance(const ParticleRecords &particles, int end);
  void gather_impacts(int end);
  void finish_geometry(int end, bool radii_known);
  void run_kernels(const Step &step);
  void keep_history(int end);
  void keep_impacts(int end);
  void to_histories(const double (*lanes_of)[ContactBatch::width], const double *fourth, int end,
                    Record *records);
  template <bool friction> void transpose_results(int end, bool with_resistance);
  void apply_weights(int end);
  template <bool friction, bool one_law, class Target>
  void add_up(ParticleRecords &particles, Target target, const std::uint32_t *contacts, int count);
  template <class Target>
  void add_couples(ParticleRecords &particles, Target target, const std::uint32_t *contacts,
                   int count);
  void account_block(const Step &step, const std::uint32_t *contacts, int count);
  void report_block(const Step &step, const std::uint32_t *contacts, int count);

  AlignedVector<std::uint32_t> contacts;    ///< touching pairs of the last compute()
  std::int64_t touching = 0;
  OutgoingForces outgoing;
  int block_size = ContactBatch::width;
  ParticleOrder::Range to_prefetch{0, 0};    ///< slots that are brought soon

  // one block of contacts on its way through the kernels
  struct LawRange {
    int law, begin, end;
  };
  ContactBatch batch;
  std::uint32_t pair_of_lane[ContactBatch::width];
  int lane_of_contact[ContactBatch::width];
  AlignedVector<LawRange> ranges;
  Record force_of_lane[ContactBatch::width], moment_of_lane[ContactBatch::width],
      couple_of_lane[ContactBatch::width];
  alignas(64) double second_radius[ContactBatch::width];
};

}    // namespace Talus

#endif
