// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts between the owned particles of a rank and one large body, through the same laws and
// kernels as contacts between particles. Knows nothing of LAMMPS.
//
//   at a rebuild   find_candidates()
//   every step     compute(), after find_candidates() if is_stale()

#ifndef TALUS_BODY_CONTACT_BODY_CONTACTS_H
#define TALUS_BODY_CONTACT_BODY_CONTACTS_H

#include "body/contact/body_batch.h"
#include "body/contact/body_candidates.h"
#include "body/contact/body_history.h"
#include "body/contact/body_step.h"

#include <functional>
#include <memory>
#include <vector>

namespace Talus {

/// Largest values of what a run warns about, over the particles of this rank that are near the
/// body; of equal values that of the particle listed first; zero without any.
struct BodyFindings {
  struct Worst {
    double value = 0.0;
    int particle = 0;    ///< local index
    int part = 0;        ///< of the body
  };
  Worst
      overlap;    ///< over radius (of shapes, that of the largest sphere inside), since particles were listed
  Worst speed;    ///< past the body, over radius
  Worst
      passed;    ///< 1: the center went through a part since particles were listed; 2: from a side
                 ///< that does not act
  Worst idle;    ///< 1: reaches a part from the side that does not act

  void join(const BodyFindings &other);
  void join(const DeepestInBody &deepest);
};

class BodyContacts {
 public:
  /// Law of each particle type t against the body: row (t, t) of the table.
  void set_laws(const LawTable &table);
  /// After find_candidates(), where the histories are those of laws for the other order of the
  /// integrator: by those of order 1 of a type, see change_of_order.h.
  void change_order(int order, const int *type, const std::function<const ContactLaw &(int)> &law);
  const LawTable &law_table() const { return *laws; }

  /// Lists the particles (mask & group) that may touch the body while no particle moves further
  /// than `skin`, and the body not too far; of a surface that moves by itself both together. Others
  /// have no contact: their history is forgotten, unless contacts are known by their parts, which end only
  /// where the shape says so.
  void find_candidates(const LargeBodyShape &shape, const BodyFrame &frame,
                       const ParticleState &view, const int *mask, int group, double skin,
                       int threads = 1);

  std::size_t num_candidates() const { return candidates.size(); }

  /// The box, in the frame of the body, around all that the shape may be asked for from find_candidates()
  /// with these arguments to the next; empty without particles.
  Eigen::AlignedBox3d bounds_of_search(const BodyFrame &frame, const ParticleState &view,
                                       const int *mask, int group, double skin) const;

  /// The body has moved so far that particles must be listed again.
  bool is_stale(const BodyFrame &frame, double skin) const
  {
    return candidates.are_stale(frame, skin);
  }

  /// `threads` are used for shapes that are thread_safe(). To be called also before particles are
  /// listed again, so that nothing in between is missed.
  BodyFindings find_worst(const LargeBodyShape &shape, const BodyFrame &frame,
                          const ParticleState &view, int threads = 1) const;

  /// Adds the contact forces to the particles and returns their reaction. The slots of particles in
  /// the records may change only before find_candidates(), as they do at a rebuild.
  BodyLoad compute(const LargeBodyShape &shape, const BodyFrame &frame, const ParticleState &view,
                   const BodyStep &step);

  /// The same for a static wall and particles in the records, piece by piece: begin_static() says
  /// whether it can be done so, and then keeps the references of its arguments; add_to_slots(), by
  /// up to `step.threads` threads, deals with the particles of the slots begin ... end-1, which
  /// together must be all; static_load() is the reaction of all that have been dealt with.
  bool begin_static(const LargeBodyShape &shape, const BodyFrame &frame, const ParticleState &view,
                    const BodyStep &step);
  void add_to_slots(int thread, int begin, int end);
  BodyLoad static_load() const;
  /// Of the same, for step.account.
  EnergyByCause static_work() const;

  /// Distance from the reference point within which all particles were when they were last listed;
  /// only of bodies that move.
  double reach() const { return candidates.reach(); }

  bool keeps_history() const { return with_history; }
  /// Local indices are others: what was noticed since particles were listed has none.
  void forget_deepest();
  double memory_usage() const;

  /// By particle (local index), in scenes whose laws keep history. The owner says what it keeps, and where.
  BodyHistory history;

 private:
  BodyTask task_of(const LargeBodyShape &shape, const BodyFrame &frame, const ParticleState &view,
                   const BodyStep &step);
  void follow_candidates();
  void index_candidates(const ParticleState &view);
  void start_batches(int threads, bool exact);
  std::size_t first_of(int thread, int threads) const;
  BodyFindings findings_in(const LargeBodyShape &shape, const BodyFrame &frame,
                           const ParticleState &view, std::size_t begin, std::size_t end) const;
  double largest_pulloff_distance(const ParticleState &view, const int *mask, int group) const;

  std::shared_ptr<const LawTable> laws = std::make_shared<const LawTable>();
  bool with_history = false;
  int history_records = 0;    // of the laws
  BodyCandidates candidates;
  std::vector<int> index;                 // places of candidates, and some more; empty: not known
  const int *order_of_index = nullptr;    // that of the particles when they were found

  std::vector<std::unique_ptr<BodyBatch>> batches;    // by thread

  struct StaticStep {
    const LargeBodyShape *shape = nullptr;
    const BodyFrame *frame = nullptr;
    ParticleState view{};
    BodyStep step;
  };
  StaticStep in_pieces;    // of the last begin_static()
};

}    // namespace Talus

#endif
