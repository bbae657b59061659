// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The contact forces between the spheres of one rank: narrow phase, kernels, sums in canonical
// order. Knows nothing of LAMMPS: the pair style hands arrays over and adds the result.
//
//   at a rebuild   keep_history() (if the old pairs are still current), release(),
//                  set_pairs(), start_pairs()
//   every step     motion().advance(), if particles live in the records; compute(), or
//                  compute_early(), compute_late() around the arrival of the ghosts' state
//   questions      ContactSurvey
//
// The work is divided into chunks (see WorkPartition) for the threads and for the two phases; how
// many there are changes no bit of the result.

#ifndef TALUS_CONTACT_CONTACT_PIPELINE_H
#define TALUS_CONTACT_CONTACT_PIPELINE_H

#include "base/in_parallel.h"
#include "base/state_exchange.h"
#include "contact/contact_chunk.h"
#include "contact/particle_motion.h"
#include "neighbors/neighbor_view.h"
#include "neighbors/work_partition.h"
#include "particles/particle_order.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace Talus {

class ContactPipeline {
 public:
  ContactPipeline() = default;
  ContactPipeline(const ContactPipeline &) = delete;    // chunks refer to the order
  ContactPipeline &operator=(const ContactPipeline &) = delete;

  /// Laws of the scene, from the next rebuild on. `type` arrays count from 1.
  void set_laws(const LawTable &table);

  /// From the next rebuild on: threads to use, at least 1, and whether compute_early() and
  /// compute_late() will be called instead of compute().
  void set_work(int threads, bool two_phases);

  /// What a rebuild needs besides the neighbors, in LAMMPS' numbering of owned particles and
  /// ghosts: order and names of particles, one tag for each of them, and their types (not needed if
  /// the laws are uniform).
  struct Particles {
    int owned;
    const std::vector<std::uint64_t> &key;
    const std::vector<std::int64_t> &tag;
    const int *type;
  };
  void set_pairs(const Particles &particles, const NeighborView &neighbors);
  /// What set_pairs() makes.
  struct Lists;
  /// For snapshots: a copy of what it has made last, one for all who ask before it is called again. And in its
  /// place, with the same owned particles and ghosts at the same places as then.
  std::shared_ptr<const Lists> lists();
  void set_lists(const std::shared_ptr<const Lists> &given, const int *type);
  /// After set_pairs(), when the neighbors are no longer needed.
  void start_pairs(HistoryStore &histories);
  /// After it, where the histories are those of laws for the other order of the integrator: by those
  /// of order 1 of two types. See change_of_order.h.
  using LawOfTypes = std::function<const ContactLaw &(int, int)>;
  void change_order(int order, const LawOfTypes &law);

  /// Release memory above the threshold, since a rebuild needs as much for a while.
  /// release_records(): the sums in the records, which the next compute() allocates again; the
  /// state must be in the arrays of LAMMPS. release(): pairs and histories as well, which are then
  /// unknown until set_pairs().
  void release_records();
  void release();
  /// Histories are those of `from` again, which were put aside with particles in these slots, and stay there.
  void take_back_histories(HistoryStore &from);
  /// For snapshots: the contacts of the last compute() with the states that it found, for ContactSurvey.
  /// When they are restored take_back_histories() comes before.
  void exchange_contacts(StateExchange &x);
  /// Blocks of memory above this size are released (bytes).
  void set_release_threshold(double bytes) { release_threshold = bytes; }

  /// Moves the current histories to `to`, or clears it if no law has a history. Unless they `stay`,
  /// there are no pairs then until set_pairs().
  void keep_history(HistoryStore &to, HistoryStore::Scope scope, bool stay);

  /// From the next advance() or compute() on, see ParticleRecords::set_gravity(); and by local
  /// index who has no weight, asked by all threads after set_pairs(), empty: all have.
  void set_gravity(const double *acceleration) { particles.set_gravity(acceleration); }
  void set_weightless(const std::function<bool(int)> &is_weightless);
  /// By local index, after set_pairs(): the masses of particles, where contacts feel those of
  /// rigid bodies; nullptr: masses are the particles' own.
  void set_own_masses(const double *of_atom);

  /// Computes all contacts and adds their forces to the arrays of LAMMPS.
  ///
  /// With `deliver` false the forces stay in the records, and the state of the owned particles with
  /// them: until a compute() that delivers, the arrays of LAMMPS need not be up to date. Code that
  /// adds other forces does so in records(). With `read` false, owned particles are taken as they
  /// are in the records, and their state is written to the arrays of LAMMPS in a compute() that
  /// delivers: allowed if the last compute() did not deliver, and usual after motion().advance(); and with
  /// `read_ghosts` false as well, ghosts too, if their state has been brought there.
  void compute(const ParticleView &arrays, const ContactStep &step);
  /// The same in two phases, if set_work() said so: first the pairs of owned particles, when ghosts
  /// are neither read nor written; then those with a ghost.
  void compute_early(const ParticleView &arrays, const ContactStep &step);
  void compute_late(const ParticleView &arrays, const ContactStep &step);

  /// Of the particles while they live in the records.
  ParticleMotion &motion() { return moving; }
  const ParticleMotion &motion() const { return moving; }
  ParticleRecords &records() { return particles; }
  const ParticleOrder &particle_order() const { return order; }

  /// Pairs are known: not after release() or keep_history().
  bool has_pairs() const { return pairs_known; }
  /// That it has pairs of.
  int num_particles() const { return pairs_known ? order.size() : 0; }
  bool in_two_phases() const { return !chunks.empty() && work.in_two_phases(); }
  const LawTable &law_table() const { return scene.laws; }
  bool keeps_history() const { return scene.with_history; }
  bool keeps_omega() const { return scene.with_friction; }
  bool conducts_heat() const { return scene.with_heat; }
  /// Bridges have their liquid from particles: steps need ContactStep::liquid.
  bool shares_liquid() const { return scene.liquid.any(); }
  double memory_usage() const;

 private:
  friend class ContactSurvey;
  friend class ParticleMotion;
  void find_types(const int *type);
  void make_chunks();
  void make_room();
  void start_step(const ContactStep &step);
  void end_step(const ParticleView &arrays, const ContactStep &step);
  void add_liquid_flows(double *liquid) const;
  void find_shared();
  void run_phase(const ParticleView &arrays, const ContactStep &step, int phase);
  template <class Visit> void for_each_chunk_of(int thread, int phase, Visit visit);
  void load_shared(const ParticleView &arrays, const ContactStep &step, int thread);
  void load_ghosts(const ParticleView &arrays, const ContactStep &step, int thread);
  void load(const ParticleView &arrays, const ContactStep &step, int range, int begin, int end);
  void copy_states(const std::vector<int> &slots, int first_copy, int thread);
  void mark(const std::vector<int> &slots, std::vector<unsigned char> &marks) const;
  /// task(begin, end) for as many ranges of 0 ... n-1 as there are threads, at the same time.
  template <class Task> void in_ranges(std::int64_t n, Task task) const
  {
    Talus::in_ranges(n, threads, [&](int, int begin, int end) { task(begin, end); });
  }
  /// task(chunk) for all chunks, at the same time.
  template <class Task> void for_chunks(Task task) const
  {
    in_parallel(work.num_chunks(), threads, task);
  }
  /// Those of a list in ascending order that are in the range of a thread.
  SlotChoice of_thread(const std::vector<int> &slots, int thread) const;

  ContactScene scene;
  std::shared_ptr<const Lists> kept_lists;
  double release_threshold = Talus::release_threshold;
  bool pairs_known = false;
  double dt = 0.0, lag = 0.0;    // of the last compute(), see ContactStep
  int threads = 1;
  int next_threads = 1;
  bool next_in_phases = false;

  ParticleOrder order;
  WorkPartition work;
  std::vector<ContactChunk> chunks;
  struct alignas(64) Claim {
    std::atomic<bool> taken{false};
  };
  std::vector<Claim> claims;    ///< by range: a thread does it in this phase
  DeferredForces deferred;

  ParticleRecords particles;
  std::vector<int> ghost_slots;                    ///< in ascending order, as all lists of slots
  std::vector<int> shared_owned, shared_ghosts;    ///< slots that other ranges than theirs read
  std::vector<unsigned char> is_loaded_before;     ///< by slot: not on the way; empty if none is

  ParticleMotion moving{*this};
};

struct ContactPipeline::Lists {
  int threads;
  ParticleOrder order;
  WorkPartition work;
  std::vector<PairList> pairs;    ///< by chunk
  std::vector<int> ghost_slots, shared_owned, shared_ghosts;
  std::vector<unsigned char> is_loaded_before;
  DeferredForces deferred;

  double memory_usage() const;
};

}    // namespace Talus

#endif
