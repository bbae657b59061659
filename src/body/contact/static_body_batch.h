// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The contacts that nearly all steps have: with a body at rest that touches a particle at one point
// at most, of particles that live in the records, and nobody asks for energies, virials or exact
// loads. Same bits for the particles as BodyBatch, eight contacts at a time instead of one.

#ifndef TALUS_BODY_CONTACT_STATIC_BODY_BATCH_H
#define TALUS_BODY_CONTACT_STATIC_BODY_BATCH_H

#include "body/contact/body_batch.h"
#include "body/contact/record_lanes.h"
#include "body/contact/sparse_history.h"

#include <cstdint>
#include <vector>

namespace Talus {

/// The candidates of a body in the order of their slots, which is how the records lie in memory.
struct SlottedCandidates {
  const std::vector<int> &atoms;    ///< host's indices
  const std::vector<int> &slots;    ///< at least `spare` more than atoms, any that exist
  static constexpr int spare = 128;
};

class StaticBodyBatch {
 public:
  StaticBodyBatch();

  /// Whether these are such contacts, of a shape with one_contact().
  static bool serves(const BodyTask &task);

  /// Computes the contacts of candidates begin ... end-1. Adds the forces to the records, and keeps
  /// histories if the laws have them. Several threads may do so at the same time, each with a batch
  /// and candidates of its own; nothing else of other candidates is read.
  void compute(const LargeBodyShape &shape, const BodyTask &task,
               const SlottedCandidates &candidates, SparseHistory &history, std::size_t begin,
               std::size_t end);

  BodyLoad load;    ///< of the last compute()

 private:
  unsigned bits_of_law(std::size_t first, int low, int high) const;
  void look_at(std::size_t first, int low, int high);
  void call(std::size_t first, unsigned bits) const;
  void take(std::size_t first, unsigned bits);
  void flush();
  void gather();
  void gather_spins(int lane, const int *slot);
  EightRecords torques(int lane) const;
  void gather_histories(int lane);
  void gather_resistance();
  void gather_coefficients();
  void add_forces();
  void keep_histories();
  void add_load();
  void sum_up();

  // of the range that is being computed
  const LargeBodyShape *shape = nullptr;
  const BodyTask *task = nullptr;
  const SlottedCandidates *candidates = nullptr;
  SparseHistory *history = nullptr;
  ContactLaw law;
  int law_index = 0;

  ContactBatch batch;
  int filled = 0, end = 0;    // lanes in use, and the same up to a multiple of eight
  std::uint32_t candidate_of_lane[ContactBatch::width] = {};
  alignas(64) double place[3][ContactBatch::width] = {}, radius[ContactBatch::width];
  Vector3<Vec8> load_of_lanes[2];    // force and torque on the body
  double touching = 0.0;
  EightSpheres spheres{};
  EightContacts contacts{};
};

}    // namespace Talus

#endif
