// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How BodyContacts lists the particles that may touch the body before the next list.

#include "body/contact/body_contacts.h"

#include "base/in_parallel.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace Talus {
namespace {

// A body may go half a skin before its list is made anew; particles may each go half a skin in one
// direction before the rebuild that the list is made after, and half a skin in the other.
constexpr double free_way = 0.5;

}    // namespace

/// Of find_candidates().
struct BodyContacts::Search {
  const LargeBodyShape &shape;
  const BodyFrame &frame;
  const BodyParticleView &view;
  const int *mask;
  int group;
  double margin;

  bool wants(int i) const { return mask[i] & group; }
  Vector3<double> place(int i) const { return frame.point_to_body(view.position(i)); }
  double reach(int i) const { return view.radius_of(i) + margin; }
  /// From the reference point; asked for only if the body moves.
  double farthest(const Vector3<double> &x, double reach) const
  {
    return frame.moves ? length(x - frame.origin) + reach : 0.0;
  }
};

void BodyContacts::find_candidates(const LargeBodyShape &shape, const BodyFrame &frame,
                                   const BodyParticleView &view, const int *mask, int group,
                                   double skin, int threads)
{
  candidates.clear();
  slots.clear();
  listed.clear();
  parts.clear();
  parts_begin.assign(1, 0);
  listed_frame = frame;
  listed_reach = 0.0;
  const double margin = frame.moves ? (1.0 + free_way) * skin : skin;
  const Search search{shape, frame, view, mask, group, margin};
  if (single)
    list_near(search, shape.thread_safe() ? threads : 1);
  else
    list_with_parts(search);
}

/* By several threads, each for a range of the particles. */

void BodyContacts::list_near(const Search &search, int threads)
{
  struct Found {
    std::vector<int> near;
    double farthest = 0.0;
  };
  std::vector<Found> found(threads);
  in_ranges(search.view.owned, threads, [&](int t, int begin, int end) {
    Found its;
    for (int i = begin; i < end; i++) {
      if (!search.wants(i)) continue;
      const Vector3<double> x = search.place(i);
      const double reach = search.reach(i);
      its.farthest = std::max(its.farthest, search.farthest(x, reach));
      if (search.shape.distance_bound(x) < reach) its.near.push_back(i);
    }
    found[t] = std::move(its);
  });
  for (const Found &its : found) {
    candidates.insert(candidates.end(), its.near.begin(), its.near.end());
    listed_reach = std::max(listed_reach, its.farthest);
  }
  if (with_history) history.follow(candidates);
}

void BodyContacts::list_with_parts(const Search &search)
{
  for (int i = 0; i < search.view.owned; i++) {
    bool near = false;
    if (search.wants(i)) {
      const Vector3<double> x = search.place(i);
      const double reach = search.reach(i);
      listed_reach = std::max(listed_reach, search.farthest(x, reach));
      near = search.shape.is_near(x, reach, parts);
      if (near) {
        const bool has_parts = parts.size() > parts_begin.back();
        listed.push_back({x, has_parts ? parts[parts_begin.back()].distance : 0.0});
        parts_begin.push_back(parts.size());
        candidates.push_back(i);
      }
    }
    if (!near && with_history) memory.forget(i);
  }
}

/* So that a step goes through the records from their beginning to their end. */

void BodyContacts::sort_by_slot(const int *slot_of_atom)
{
  const auto before = [slot_of_atom](int a, int b) { return slot_of_atom[a] < slot_of_atom[b]; };
  if (!std::is_sorted(candidates.begin(), candidates.end(), before)) {
    std::sort(candidates.begin(), candidates.end(), before);
    if (with_history) history.follow(candidates);
  }
  if (candidates.empty()) return;
  for (const int i : candidates) slots.push_back(slot_of_atom[i]);
  slots.resize(slots.size() + SlottedCandidates::spare, slots.back());
}

bool BodyContacts::is_stale(const BodyFrame &frame, double skin) const
{
  return frame.moves && largest_displacement(listed_frame, frame, listed_reach) > free_way * skin;
}

Bounds BodyContacts::asked_for(const BodyFrame &frame, const BodyParticleView &view,
                               const int *mask, int group, double skin)
{
  constexpr double far = std::numeric_limits<double>::infinity();
  Bounds box{{far, far, far}, {-far, -far, -far}};
  double largest = 0.0;
  for (int i = 0; i < view.owned; i++) {
    if (!(mask[i] & group)) continue;
    const Vector3<double> x = frame.point_to_body(view.position(i));
    box = joined(box, {x, x});
    largest = std::max(largest, view.radius_of(i));
  }
  // listed with the margin below; they go half a skin, the body what it may until it is stale
  const double reach = largest + (frame.moves ? 3.0 : 2.0) * skin;
  const Vector3<double> around{reach, reach, reach};
  return {box.low - around, box.high + around};
}

}    // namespace Talus
