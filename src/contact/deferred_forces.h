// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Forces that a chunk of the work must not add at once (see WorkPartition): on particles of other
// ranges, and on those that have contacts of the late phase. Each pair with such a particle has a
// place here, where its chunk stores what the contact does in a step. When all chunks are done, the
// rows are added: one for each of these particles, with its pairs in canonical order.
//
//   at a rebuild   collect(), make_room()
//   every step     begin_step(), put() by all chunks, add() by all threads
//
// A particle gets the contacts of its own range first, added directly or here, and then those of
// the following ranges in ascending order: that is the canonical order.

#ifndef TALUS_CONTACT_DEFERRED_FORCES_H
#define TALUS_CONTACT_DEFERRED_FORCES_H

#include "base/aligned_vector.h"
#include "neighbors/pair_list.h"
#include "neighbors/work_partition.h"
#include "particles/particle_records.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Talus {

/// What a contact adds to its first particle, see record.h. The second one gets the opposite force,
/// twisting torque and heat flow, and the same torque per radius. Torques and heat count only in scenes
/// that have them.
struct ContactLoad {
  Vec4 force, torque_per_radius, twisting_torque;
  double heat_flow;
};

class DeferredForces {
 public:
  /// Gives places to the pairs of all chunks; `list_of(chunk)` must stand as it is until the next
  /// call. Nothing is stored afterwards.
  template <class ListOf>
  void collect(const ParticleOrder &order, const WorkPartition &work, int threads, ListOf list_of)
  {
    std::vector<const PairList *> lists(work.num_chunks());
    for (int c = 0; c < work.num_chunks(); c++) lists[c] = list_of(c);
    collect_from(order, work, threads, lists);
  }

  /// For records of that kind. To be called again after release().
  void make_room(const ParticleRecords &particles);
  /// Gives the memory of make_room() back.
  void release();

  /// Forgets what has been stored.
  void begin_step() { step += 1.0; }

  /// Place of the first pair at the frontier of a chunk; the others follow.
  std::size_t first_place(int chunk) const { return first_of_chunk[chunk]; }

  /// Stores what a pair that touches does in this step. `far`: another thread will read it; it may
  /// do so after streams_are_done().
  TALUS_INLINE void put(std::size_t place, bool far, const ContactLoad &contact)
  {
    const auto write = [far](Record &to, Vec4 value) {
      if (far)
        stream(to, value);
      else
        store(to, value);
    };
    Vec4 force = contact.force;
    force[3] = step;
    write(load[stride * place], force);
    if (stride == 2) write(load[stride * place + 1], contact.torque_per_radius);
    if (!twisting_torque.empty()) write(twisting_torque[place], contact.twisting_torque);
    if (!heat_flow.empty()) heat_flow[place] = contact.heat_flow;
  }

  /// Adds the rows of the particles of a thread, when all that is done by all chunks.
  void add(int thread, ParticleRecords &particles) const;

  double memory_usage() const;

 private:
  /// A contact of a particle.
  struct Entry {
    std::uint32_t place;
    bool of_second;    // the particle is the second of the pair
  };
  /// A particle: its entries end here, and begin at the end of the row before.
  struct Row {
    int slot;
    bool has_all;    // contacts of the particle are here: what has been added so far is replaced
    std::uint32_t end;
  };
  struct Rows {
    std::vector<Row> rows;
    std::vector<Entry> entries;
  };
  void collect_from(const ParticleOrder &order, const WorkPartition &work, int threads,
                    const std::vector<const PairList *> &lists);
  void make_rows(const ParticleOrder &order, const WorkPartition &work, SlotRange range,
                 const std::vector<const PairList *> &lists, Rows &to) const;
  template <bool rotation>
  void add_row(const Row &row, const Entry *begin, const Entry *end,
               ParticleRecords &particles) const;
  bool acts(const Entry &e) const { return load[stride * e.place].c[3] == step; }
  void add_twisting_torques(const Row &row, const Entry *begin, const Entry *end,
                            ParticleRecords &particles) const;
  void add_heat(const Row &row, const Entry *begin, const Entry *end,
                ParticleRecords &particles) const;

  std::size_t places = 0, stride = 1;
  std::vector<std::size_t> first_of_chunk;
  std::vector<Rows> of_thread;
  double step = 0.0;
  // by place; the fourth number of a force is the step in which it was stored
  AlignedVector<Record> load, twisting_torque;
  AlignedVector<double> heat_flow;
};

}    // namespace Talus

#endif
