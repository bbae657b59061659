// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact points of a list of pairs: a particle with a shape and another particle (ShapedPairs) or
// one large body (BodyPoints). These find contacts and add forces; here is what they share:
// chunks of pairs, computed by any number of threads, histories, laws, and the account of work.
//
//   at a rebuild   save() (if points are current), set_list(), restore_points()
//   every step     compute_points(), with take_points() for what was found; then account_for_work()

#ifndef TALUS_SHAPE_CONTACT_CONTACT_POINTS_H
#define TALUS_SHAPE_CONTACT_CONTACT_POINTS_H

#include "base/in_parallel.h"
#include "base/state_exchange.h"
#include "history/contact_lists.h"
#include "laws/deepest_contact.h"
#include "shape/collisions.h"
#include "shape/contact/point_batch.h"
#include "shape/shape_contact.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace Talus {

class ContactPoints {
 public:
  /// In the place of the second particle: the large body. No particle has this local index.
  static constexpr int large_body = std::numeric_limits<int>::max();
  struct Pair {
    int first, second;       ///< local indices
    std::int64_t name[2];    ///< IDs; of a large body see ContactMemory::name_of()
    double size;             ///< the smaller radius of the largest sphere inside, of particles
  };

  /// Adds the histories of points to the lists of all owned particles: with the signs of the first
  /// of the pair, identified by the name of the partner and feature.
  void save(ContactLists &to) const;

  /// visit(pair, point) for each contact point of the last step.
  template <class Visit> void for_each_point(Visit visit) const
  {
    for (const Chunk &chunk : chunks)
      for (std::size_t n = 0; n < chunk.points.size(); n++)
        visit(list[chunk.of_point[n]], chunk.points[n]);
  }

  /// The deepest contact since set_list(), if it is deeper than DeepestContact::watched; otherwise
  /// that. Of a large body j is the part.
  DeepestContact deepest_since_set() const;

  /// For snapshots, with the particles: a later step goes on from here.
  void exchange_state(StateExchange &x) { x(owned, list, chunks); }
  double memory_usage() const;

 protected:
  struct Chunk {
    int begin, end;    ///< pairs
    std::vector<PointContact> points{}, before{};
    std::vector<int> of_point{}, of_before{};           ///< which pair, ascending
    std::size_t known = 0;                              ///< of `before`: those of earlier pairs
    DeepestContact deepest{DeepestContact::watched};    ///< since set_list()
  };
  static constexpr int most_of_chunk = 128;
  /// Of a thread, for one chunk after the other.
  struct Scratch {
    PointBatch batch;
    ShapeContacts found[most_of_chunk];    ///< by pair of the chunk, or one
    std::vector<CollisionJob> jobs;
    std::vector<Collisions::OfMany> of_job;
  };

  /// New pairs without points. `owned_here`: particles 0 ... owned_here-1 are owned.
  void set_list(std::vector<Pair> pairs, int owned_here, int pairs_of_chunk);

  /// In the lists, the points of a pair are those of this particle with this partner; 0: none.
  struct Stored {
    int particle;
    std::int64_t partner;
  };
  /// Where Stored stored_of(pair) says. The narrow phase will find these points again, or drop them.
  template <class Where> void restore_points(const ContactLists &from, Where stored_of);

  /// For each chunk: find(chunk, scratch), which calls take_points(); the laws; add(number of chunk).
  template <class Find, class Add>
  void compute_points(const PointBatch::Task &task, int threads, Find find, Add add);
  /// Adds the points of pair p to those of the chunk, with the histories of the step before; p may
  /// not fall. `surface`: of the large body, else 0. complete(contact, point) sets the row, what it says of both
  /// bodies, and velocities.
  template <class Complete>
  void take_points(Chunk &chunk, int p, int surface, const ShapeContacts &found,
                   Complete complete) const;
  /// In the order of the points: several of them may belong to one particle.
  void account_for_work(WorkAccount &to) const;
  /// What counts for this rank of what it knows of a pair.
  double share(const Pair &pair) const
  {
    return pair.second == large_body || (pair.first < owned && pair.second < owned) ? 1.0 : 0.5;
  }

  int owned = 0;
  std::vector<Pair> list;
  std::vector<Chunk> chunks;

 private:
  std::vector<std::unique_ptr<Scratch>> scratch;    ///< by thread
};

template <class Where> void ContactPoints::restore_points(const ContactLists &from, Where stored_of)
{
  for (Chunk &chunk : chunks)
    for (int p = chunk.begin; p < chunk.end; p++) {
      const Stored stored = stored_of(list[p]);
      if (stored.partner == 0) continue;
      from.for_each(stored.particle, [&](const ContactLists::Contact &one) {
        if (one.partner != stored.partner || !(one.feature & ContactLists::of_shape)) return;
        chunk.points.push_back(stored_point(one));
        chunk.of_point.push_back(p);
      });
    }
}

template <class Find, class Add>
void ContactPoints::compute_points(const PointBatch::Task &task, int threads, Find find, Add add)
{
  while (static_cast<int>(scratch.size()) < threads) scratch.push_back(std::make_unique<Scratch>());
  in_ranges(static_cast<std::int64_t>(chunks.size()), threads, [&](int t, int begin, int end) {
    for (int c = begin; c < end; c++) {
      Chunk &chunk = chunks[c];
      std::swap(chunk.points, chunk.before);
      std::swap(chunk.of_point, chunk.of_before);
      chunk.points.clear();
      chunk.of_point.clear();
      chunk.known = 0;
      find(chunk, *scratch[t]);
      scratch[t]->batch.compute(task, chunk.points.data(), chunk.points.size());
      add(c);
    }
  });
}

template <class Complete>
void ContactPoints::take_points(Chunk &chunk, int p, int surface, const ShapeContacts &found,
                                Complete complete) const
{
  while (chunk.known < chunk.of_before.size() && chunk.of_before[chunk.known] < p) chunk.known++;
  const std::size_t known = chunk.known, first = chunk.points.size();
  std::size_t end = known;
  while (end < chunk.of_before.size() && chunk.of_before[end] == p) end++;
  const Pair &pair = list[p];
  for (const ShapeContact &one : found.points) {
    PointContact &point = chunk.points.emplace_back();
    point.place = one.position;
    point.normal = one.normal;
    point.overlap = one.overlap;
    point.weight = one.weight;
    point.energy = one.energy;
    point.name = (static_cast<std::uint64_t>(surface) + one.surface) << 32 | one.name;
    point.is_named_by_place = one.is_named_by_place;
    point.begins_search = one.begins_search;
    point.start = found.start;
    point.part = one.part;
    complete(one, point);
    for (std::size_t k = known; !one.is_named_by_place && k < end; k++)
      if (chunk.before[k].name == point.name) point.history = chunk.before[k].history;
    chunk.of_point.push_back(p);
    if (one.overlap > chunk.deepest.overlap_ratio * pair.size)
      chunk.deepest = {one.overlap / pair.size, pair.first,
                       pair.second == large_body ? point.part : pair.second};
  }
  continue_at_places(chunk.points.data() + first, chunk.points.size() - first,
                     chunk.before.data() + known, end - known);
}

}    // namespace Talus

#endif
