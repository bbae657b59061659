// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The owned particles of a rank that may touch a large body before they are listed again, and of
// shapes with parts which of these are near each of them.

#ifndef TALUS_BODY_CONTACT_BODY_CANDIDATES_H
#define TALUS_BODY_CONTACT_BODY_CANDIDATES_H

#include "base/linear_algebra.h"
#include "body/motion/body_state.h"
#include "body/shape/large_body_shape.h"
#include "particles/particle_state.h"

#include <cstdint>
#include <vector>

namespace Talus {

class BodyCandidates {
 public:
  /// Lists the particles (mask & group) that may touch the body while no particle moves further
  /// than `skin`, and the body not too far; contacts that have begun last until there is a gap of
  /// `beyond`. And those of `to_keep`, ascending local indices. `threads` are used for shapes that are
  /// thread_safe() and touch at one point at most.
  void list(const LargeBodyShape &shape, const BodyFrame &frame, const ParticleState &view,
            const int *mask, int group, double skin, double beyond, const std::vector<int> &to_keep,
            int threads);

  /// The body has moved so far that particles must be listed again.
  bool are_stale(const BodyFrame &frame, double skin) const;

  /// The box, in the frame of the body, around all that list() may ask the shape for until the next
  /// call; empty without particles.
  static Eigen::AlignedBox3d bounds_of_search(const BodyFrame &frame, const ParticleState &view,
                                              const int *mask, int group, double skin,
                                              double beyond);

  /// Distance from the reference point within which all particles that may touch the body, and all of its
  /// surface that may be touched, were when they were last listed; only of bodies that move.
  double reach() const { return listed_reach; }

  std::size_t size() const { return particles.size(); }
  /// Local indices.
  const std::vector<int> &atoms() const { return particles; }
  int atom(std::size_t c) const { return particles[c]; }
  /// How many contacts each may have at the same time; only of shapes with several.
  const std::vector<std::uint8_t> &room() const { return most_contacts; }

  /// Where candidate c was when it was listed, in the frame of the body; of shapes with several
  /// contacts.
  const Vector3<double> &listed_at(std::size_t c) const { return listed[c].at; }

  /// Sorts candidates by slot, so that a step goes through the records from their beginning to
  /// their end; returns whether this changed anything. Only without parts.
  bool sort_by_slot(const int *slot_of_atom);

  /// The parts that candidate c can have reached since it was listed, if it is at `x` (frame of the
  /// body) now; nearest first. `may_touch`: false if there are parts, and none is near enough.
  NearParts parts_near(const BodyFrame &frame, std::size_t c, const Vector3<double> &x,
                       double radius, bool &may_touch) const;

  bool have_parts() const { return !parts.empty(); }
  /// Prefetches the list of parts of a candidate, and the parts that it probably touches.
  void prefetch_list(std::size_t c, double radius) const;
  void prefetch_parts(std::size_t c, double radius, const LargeBodyShape &shape) const;

  double memory_usage() const;

 private:
  struct Search;
  void clear();
  void list_near(const Search &search, int threads);
  void list_with_parts(const Search &search);

  std::vector<int> particles;
  BodyFrame listed_frame;
  double listed_reach = 0.0;    // see reach()

  // by candidate, only of shapes with several contacts
  struct Listed {
    Vector3<double> at;    // frame of the body
    double nearest;        // distance of the nearest of its parts, 0 without parts
  };
  std::vector<Listed> listed;
  std::vector<std::uint8_t> most_contacts;
  std::vector<std::size_t> parts_begin;    // and one more
  std::vector<NearPart> parts;
};

}    // namespace Talus

#endif
