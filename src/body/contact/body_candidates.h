// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The owned particles of a rank that may touch a large body before they are listed again, and of
// shapes with parts which of these are near each of them.

#ifndef TALUS_BODY_CONTACT_BODY_CANDIDATES_H
#define TALUS_BODY_CONTACT_BODY_CANDIDATES_H

#include "base/aligned_vector.h"
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
  /// thread_safe().
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
  Vector3<double> listed_at(std::size_t c) const
  {
    const Eight &eight = listed[c / EightSpheres::width];
    const std::size_t k = c % EightSpheres::width;
    return {eight.at[0][k], eight.at[1][k], eight.at[2][k]};
  }

  /// Sorts candidates by slot, so that a step goes through the records from their beginning to
  /// their end; returns whether this changed anything. Only without parts.
  bool sort_by_slot(const int *slot_of_atom);

  /// The parts that candidate c can have reached since it was listed, if it is at `x` (frame of the
  /// body) now; nearest first. `may_touch`: false if there are parts, and none is near enough.
  NearParts parts_near(const BodyFrame &frame, std::size_t c, const Vector3<double> &x,
                       double radius, bool &may_touch) const;

  /// Of the candidates 8 block ... 8 block + 7, which are these spheres now (frame of the body), the bits
  /// of those that touch one part, whose contacts are filled in; of shapes with several contacts. `told`
  /// receives the bits of those of which this is all: parts_near() need not be asked.
  unsigned touch_flat(const LargeBodyShape &shape, const BodyFrame &frame, std::size_t block,
                      const EightSpheres &spheres, EightContacts &contacts, unsigned &told) const;

  /// Bits of those of a block for which parts_near() will be asked; 0 beyond the end.
  unsigned with_parts(std::size_t block) const
  {
    return block < listed.size() ? listed[block].with_parts : 0;
  }
  /// Prefetches the list of parts of a candidate, and the parts that it probably touches.
  void prefetch_list(std::size_t c) const { __builtin_prefetch(parts.data() + parts_begin[c]); }
  void prefetch_parts(std::size_t c, double radius, const LargeBodyShape &shape) const;

  double memory_usage() const;

 private:
  struct Search;
  struct Found;
  void clear();
  void list_near(const Search &search, int threads);
  void list_with_parts(const Search &search, int threads);
  void add(const Found &found);
  template <class Real> static Real reach_of(Real radius, Real way);

  std::vector<int> particles;
  BodyFrame listed_frame;
  double listed_reach = 0.0;    // see reach()

  // by candidate, only of shapes with several contacts
  struct alignas(64) Eight {
    double at[3][EightSpheres::width];      // frame of the body
    double nearest[EightSpheres::width];    // distance of the nearest of its parts, 0 without parts
    double another[EightSpheres::width];    // of the nearest one of another group than that
    double flat_way[EightSpheres::width];    // see FlatPlace
    EightFlatPlaces flat;                    // of the nearest part
    unsigned with_parts;                     // bits of those that are near others as well
  };
  AlignedVector<Eight> listed;
  std::vector<std::uint8_t> most_contacts;
  std::vector<std::size_t> parts_begin;    // and one more
  std::vector<NearPart> parts;
};

}    // namespace Talus

#endif
