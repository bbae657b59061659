// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts between the owned particles of a rank and one large body, through the same laws and
// kernels as contacts between particles. Knows nothing of the host.
//
//   at a rebuild   find_candidates()
//   every step     compute(), after find_candidates() if is_stale()

#ifndef TALUS_BODY_CONTACT_BODY_CONTACTS_H
#define TALUS_BODY_CONTACT_BODY_CONTACTS_H

#include "body/contact/body_batch.h"
#include "body/contact/contact_memory.h"
#include "body/contact/sparse_history.h"
#include "body/contact/static_body_batch.h"

#include <memory>
#include <vector>

namespace Talus {

/// How a step is computed.
struct BodyStep {
  double dt = 0.0;
  bool advance = true;    ///< false while a run is set up: histories are then only read
  int threads = 1;
  EnergyAccount *account = nullptr;               ///< receives the energies; takes one thread
  ExactLoad *exact = nullptr;                     ///< receives the load without rounding
  std::vector<TouchedPart> *touched = nullptr;    ///< receives one entry for each contact
};

class BodyContacts {
 public:
  /// Law of each particle type t against the body: row (t, t) of the table; and whether the shape
  /// touches a particle at one point at most.
  void set_laws(const LawTable &table, bool one_contact);

  /// Lists the particles (mask & group) that may touch the body while no particle moves further
  /// than `skin`, and the body not too far. Others have no contact: their history is forgotten.
  /// `threads` are used for shapes that are thread_safe() and touch at one point at most.
  void find_candidates(const LargeBodyShape &shape, const BodyFrame &frame,
                       const BodyParticleView &view, const int *mask, int group, double skin,
                       int threads = 1);

  /// The body has moved so far that particles must be listed anew.
  bool is_stale(const BodyFrame &frame, double skin) const;

  /// The box, in the frame of the body, around all that find_candidates() may ask the shape for
  /// until the next call; low > high without particles.
  static Bounds asked_for(const BodyFrame &frame, const BodyParticleView &view, const int *mask,
                          int group, double skin);

  /// Of the particles listed: the largest overlap/radius and its particle, the largest speed past
  /// the body over the radius and its particle, of equal ones the first listed. Zero without any.
  /// `threads` are used for shapes that are thread_safe().
  struct Worst {
    double overlap = 0.0, speed = 0.0;
    int deepest = 0, fastest = 0;
  };
  Worst worst(const LargeBodyShape &shape, const BodyFrame &frame, const BodyParticleView &view,
              int threads = 1) const;

  /// Adds the contact forces to the particles and returns their reaction. The slots of particles in
  /// the records may change only before find_candidates(), as they do at a rebuild.
  BodyLoad compute(const LargeBodyShape &shape, const BodyFrame &frame,
                   const BodyParticleView &view, const BodyStep &step);

  /// The same for a body at rest and particles in the records, piece by piece: begin_at_rest() says
  /// whether it can be done so, and then keeps the references of its arguments; add_to_slots(), by
  /// up to `step.threads` threads, deals with the particles of the slots begin ... end-1, which
  /// together must be all; load_at_rest() is the reaction of all that have been dealt with.
  bool begin_at_rest(const LargeBodyShape &shape, const BodyFrame &frame,
                     const BodyParticleView &view, const BodyStep &step);
  void add_to_slots(int thread, int begin, int end);
  BodyLoad load_at_rest() const;

  /// For energies: after the integrator has moved velocities, before particles are renumbered.
  /// `frame`: with the velocity that the body has now.
  void account_for_move(const BodyFrame &frame, const BodyParticleView &view, double dt,
                        EnergyAccount &to) const;

  /// Distance from the reference point within which all particles were when they were last listed;
  /// only of bodies that move.
  double reach() const { return listed_reach; }

  /// Largest overlap/radius of the last compute() with an account; 0 without contacts.
  double largest_overlap_ratio() const { return largest_overlap; }

  bool keeps_history() const { return with_history; }
  bool keeps_onset() const { return with_impact; }
  bool keeps_lists() const { return with_history && !single; }
  double memory_usage() const;

  /// By particle (host's index), in scenes whose laws keep history. The owner grows, moves and
  /// saves them with the particles.
  SparseHistory history;    ///< if there is one contact at most
  ContactMemory memory;     ///< if there may be more than one contact

 private:
  struct Search;
  void list_near(const Search &search, int threads);
  void list_with_parts(const Search &search);
  void sort_by_slot(const int *slot_of_atom);
  BodyTask task_of(const BodyFrame &frame, const BodyParticleView &view,
                   const BodyStep &step) const;
  void add_at_rest(int thread, std::size_t begin, std::size_t end);
  std::size_t first_of(int thread, int threads) const;
  void compute_batches(const LargeBodyShape &shape, const BodyTask &task, int threads);
  void compute_range(const LargeBodyShape &shape, const BodyTask &task, BodyBatch &batch,
                     std::size_t begin, std::size_t end);
  void call_parts_ahead(const LargeBodyShape &shape, const BodyParticleView &view,
                        std::size_t candidate, std::size_t end) const;
  void touch_once(const LargeBodyShape &shape, const BodyTask &task, BodyBatch &batch, int law,
                  std::size_t candidate);
  void touch_often(const LargeBodyShape &shape, const BodyTask &task, BodyBatch &batch, int law,
                   std::size_t candidate);
  Worst worst_of(const LargeBodyShape &shape, const BodyFrame &frame, const BodyParticleView &view,
                 std::size_t begin, std::size_t end) const;
  NearParts parts_near(std::size_t candidate, double reach) const;
  void renew_memory(int threads);
  void remember_velocities(const BodyFrame &frame, const BodyParticleView &view,
                           EnergyAccount &account);

  LawTable laws;
  bool with_history = false, with_impact = false, single = true;
  std::vector<int> candidates;    // in the order of slots as soon as it is known, if single
  std::vector<int> slots;         // of candidates, and some more; empty until it is known
  struct Listed {
    Vector3<double> at;    // frame of the body
    double nearest;        // distance of the nearest of its parts, 0 without parts
  };
  std::vector<Listed> listed;              // by candidate
  std::vector<std::size_t> parts_begin;    // by candidate and one more
  std::vector<NearPart> parts;
  struct NewList {
    int first, count, batch;
  };
  std::vector<NewList> new_lists;                     // by candidate
  std::vector<std::unique_ptr<BodyBatch>> batches;    // by thread
  std::vector<std::unique_ptr<StaticBodyBatch>> resting_batches;
  struct AtRest {
    const LargeBodyShape *shape = nullptr;
    const BodyFrame *frame = nullptr;
    BodyParticleView view{};
    BodyStep step;
  };
  AtRest at_rest;    // of the last begin_at_rest()
  BodyFrame listed_frame;
  double largest_overlap = 0.0;    // over radius
  double listed_reach = 0.0;       // largest distance of a particle from the reference point

  struct Motion {
    Vector3<double> velocity, spin, place;    // frame of the body; place: in space
  };
  std::vector<Motion> before;    // of candidates, only with an account
  BodyFrame frame_before;
};

}    // namespace Talus

#endif
