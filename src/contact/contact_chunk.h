// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// One chunk of the contact work of a rank: it computes the contacts that belong to it (see
// WorkPartition) and adds the forces on the particles of its range. Those on particles of other
// ranges, or of particles that wait for contacts of the late phase, it defers (DeferredForces).
// Chunks of one phase need no locks, may run at the same time or one after the other, and give the
// same bits as one chunk alone.

#ifndef TALUS_CONTACT_CONTACT_CHUNK_H
#define TALUS_CONTACT_CONTACT_CHUNK_H

#include "base/aligned_vector.h"
#include "base/state_exchange.h"
#include "contact/deferred_forces.h"
#include "contact/liquid_bridges.h"
#include "contact/virial_sums.h"
#include "history/contact_history.h"
#include "laws/contact_batch.h"
#include "laws/contact_energy.h"
#include "laws/deepest_contact.h"
#include "material/law_table.h"
#include "neighbors/pair_list.h"
#include "particles/particle_records.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace Talus {

/// One contact for Pair::ev_tally_xyz(): local indices, force on i, x_i - x_j. Each particle of a
/// contact is tallied once, and the contacts of an owned particle in canonical order. Both
/// particles are tallied at once, unless one of them waits for contacts of the late phase: `for_i`
/// and `for_j` say which.
struct TalliedContact {
  int i, j;
  bool for_i, for_j;
  double force[3], separation[3];
};

/// What all chunks of a rank share.
struct ContactScene {
  LawTable laws;
  bool with_friction = false, with_history = false;
  int history_records = 0;         ///< of each contact, see HistoryRows
  bool with_twisting = false;      ///< twisting torques arise
  bool with_resistance = false;    ///< of rolling or twisting
  bool with_heat = false;          ///< is conducted
  bool second_order = false;       ///< changes of velocities are read
  LiquidBridges liquid;            ///< of bridges that have it from particles
  std::vector<int> slot_type;      ///< types in canonical order; empty if laws are uniform

  int row_of(int slot_a, int slot_b) const
  {
    return laws.uniform() ? 0 : laws.row(slot_type[slot_a], slot_type[slot_b]);
  }
};

/// How a step is computed. `advance` is false while a run is set up: histories are then only read.
/// `tally`, if given, is called for every contact, by one thread; `virial`, if given, has that of all contacts added;
/// `account`, if given, receives their work. `progress`, if given, is called now and then by the first thread, for the
/// progress of MPI messages. `add_other_forces`, if given, adds other forces to the sums of slots
/// begin ... end-1 after those of their contacts: called once by each thread, with its number and
/// range.
struct ContactStep {
  double dt;
  bool advance;
  const std::function<void(const TalliedContact &)> *tally = nullptr;
  VirialSums *virial = nullptr;
  WorkAccount *account = nullptr;
  const std::function<void()> *progress = nullptr;
  const std::function<void(int thread, int begin, int end)> *add_other_forces = nullptr;
  bool read = true, read_ghosts = true, deliver = true;    ///< see ContactPipeline::compute()
  bool add_to_arrays =
      false;    ///< forces, though they stay in the records: others add theirs there
  const double *temperature = nullptr;    ///< by local index, in scenes that conduct heat
  /// By local index, where bridges have it from particles: read of all, in the end changed of owned ones.
  double *liquid = nullptr;
  double lag = 0.0;    ///< time by which velocities are behind positions; for second order
  /// Of the changes of velocities, if they are kept. Laws of second order want 1. For the work
  /// alone a few steps may be looked at with the weight of all, the others with 0: a correction that
  /// is of first order in the step stays so to second order.
  float weight_of_changes = 0.0F;
};

class ContactChunk {
 public:
  /// Loads the present state of the slots begin ... end-1, and clears their sums.
  using Load = std::function<void(int begin, int end)>;

  ContactChunk();

  /// After pairs.collect(): histories of the new pairs, see ContactHistory::fetch().
  void start_pairs(const ContactScene &scene, const HistoryStore &histories);
  /// See ContactPipeline::change_order(); `law`: of two slots.
  void change_order(int order, const std::function<const ContactLaw &(int, int)> &law);

  /// For snapshots: which pairs touched in the last compute().
  void exchange_contacts(StateExchange &x);

  /// Releases the contacts of the last compute(); queries then find none.
  void forget_contacts();
  /// Laws have changed.
  void forget_limits() { limits_are_known = false; }

  /// Where the forces of the pairs at the frontier go, and in the late phase the chunk of the same
  /// range in the early one; nothing for a chunk that has all pairs of a rank.
  struct Frontier {
    DeferredForces *forces = nullptr;
    std::size_t first_place = 0;
    const ContactChunk *early = nullptr;
  };

  /// Computes all contacts of this chunk and adds their forces, or defers them. In the first phase
  /// all slots of its range are loaded on the way, a while before they are needed, so that they
  /// pass through the cache once; slots of other ranges must be there from the beginning. In the
  /// late phase all must be there.
  void compute(const ContactScene &scene, ParticleRecords &particles, const ContactStep &step,
               const Load &load, const Frontier &frontier);

  /// visit(pair) for every contact of the last compute().
  template <class Visit> void for_each_contact(Visit visit) const
  {
    for (std::int64_t n = 0; n < touching; n++) visit(contacts[n]);
  }

  int row_of_pair(const ContactScene &scene, std::int64_t pair) const
  {
    return scene.row_of(pairs.first[pair], pairs.second[pair]);
  }

  /// The deepest contact since start_pairs(), if it is deeper than DeepestContact::watched; otherwise that.
  const DeepestContact &deepest_since_start() const { return deepest; }

  /// What the last compute() has found of the work of contacts; those of first particles that other
  /// chunks may deal with at the same time are not in the lists of step.account yet.
  const EnergyByCause &work() const { return chunk_work; }
  const VirialSums &virial() const { return chunk_virial; }
  /// Of bridges that broke in it.
  const std::vector<LiquidFlow> &liquid_flows() const { return flows; }
  void add_work_left(const WorkAccount &to) const;

  double memory_usage() const;

  PairList pairs;
  ContactHistory history;

 private:
  struct Step : ContactStep {
    const ContactScene &scene;
    ParticleRecords &particles;
    const Load &load;
    const Frontier &frontier;
  };
  void clear_changes();
  template <bool friction, bool history_kept> void compute_all(const Step &step);
  unsigned lasting(const Step &step, std::int64_t pair, unsigned ended);
  bool bridge_holds(const Step &step, std::int64_t pair);
  bool has_limits(const ContactScene &scene) const;
  void make_room_for_limits(const Step &step);
  void find_limits(const Step &step, std::int64_t begin, std::int64_t end);
  void find_bridge_volumes(const Step &step, int end);
  template <bool friction, bool history_kept>
  void compute_block(const Step &step, std::int64_t begin, int count);
  void prefetch_distant(const ParticleRecords &particles, std::size_t &next,
                        std::int64_t end) const;
  TALUS_INLINE void prefetch_own(const ParticleRecords &particles);
  int arrange(const ContactScene &scene, const std::uint32_t *contacts, int count);
  void give_lane(std::uint32_t contact, int position, int lane);
  template <bool friction, bool history_kept, bool changes> void gather(const Step &step, int end);
  void gather_for_twisting(const Step &step, int end, bool resistance);
  void gather_further_histories(const ContactScene &scene, int end);
  void gather_temperatures(const double *temperature, int end);
  void finish_geometry(const ParticleRecords &particles, int end, bool radii_known);
  void notice_deeper(const ParticleRecords &particles, int end);
  void run_kernels(const Step &step);
  void keep_history(const ContactScene &scene, int end);
  template <bool friction> void transpose_results(int end, const ContactScene &scene);
  void apply_weights(int end);
  template <bool friction, bool one_law, bool weights>
  void add_up(ParticleRecords &particles, const std::uint32_t *contacts, int count);
  template <bool friction> void add_up(const Step &step, const std::uint32_t *contacts, int count);
  void add_twisting_torques(ParticleRecords &particles, const std::uint32_t *contacts, int count);
  void add_heat(ParticleRecords &particles, const std::uint32_t *contacts, int count);
  void defer(const Step &step, const std::uint32_t *contacts, int count);
  void account_block(const Step &step, const std::uint32_t *contacts, int count);
  void account_by_particle(const Step &step, const std::uint32_t *contacts, int count);
  void add_virial(const std::uint32_t *contacts, int count);
  void tally_block(const Step &step, const std::uint32_t *contacts, int count);
  void tally_early_before(int second, int first, const Step &step);

  AlignedVector<std::uint32_t> contacts;    ///< touching pairs of the last compute()
  AlignedVector<double> limits;             ///< see BeyondTouch
  bool limits_are_known = false;
  std::int64_t touching = 0;
  DeepestContact deepest;
  struct LaterTally {
    int second, first;
    TalliedContact contact;
  };
  std::vector<LaterTally> later_tallies;    ///< of ends that have late contacts as well
  std::size_t tallied = 0;                  ///< of those of the early chunk
  std::vector<LiquidFlow> flows;
  EnergyByCause chunk_work;
  VirialSums chunk_virial;
  struct WorkLeft {
    int atom;
    EnergyByCause work;
  };
  std::vector<WorkLeft> work_left;
  int block_size = ContactBatch::width;
  SlotRange to_prefetch;    ///< slots that are loaded soon

  // one block of contacts on its way through the kernels
  struct LawRange {
    int law, begin, used, end;    ///< lanes behind used-1 are copies
  };
  ContactBatch batch;
  bool changes_are_clear = false;    ///< those of velocities, in all lanes
  std::uint32_t pair_of_lane[ContactBatch::width];
  int lane_of_contact[ContactBatch::width];
  AlignedVector<LawRange> ranges;
  Record force_of_lane[ContactBatch::width], torque_per_radius_of_lane[ContactBatch::width],
      twisting_of_lane[ContactBatch::width];
  alignas(64) double first_radius[ContactBatch::width], second_radius[ContactBatch::width];
};

}    // namespace Talus

#endif
