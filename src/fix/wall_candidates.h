// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The owned particles that may touch a wall of LAMMPS in the next steps.

#ifndef TALUS_FIX_WALL_CANDIDATES_H
#define TALUS_FIX_WALL_CANDIDATES_H

#include "base/in_parallel.h"
#include "base/lanes.h"
#include "base/vector3.h"
#include "particles/particle_state.h"

#include <algorithm>
#include <vector>

namespace Talus {

/// Centers and radii of eight particles, in lanes.
struct SphereLanes {
  Vector3<Vec8> position;
  Vec8 radius;
};

/// Of the particles i[0] ... i[7].
inline SphereLanes sphere_lanes(const ParticleState &particles, const int *i)
{
  alignas(64) double center[3][lanes], radius[lanes];
  particles.spheres_at([&](int k) { return particles.place(i[k]); }, center, radius);
  return {{load8(center[0]), load8(center[1]), load8(center[2])}, load8(radius)};
}

/// A list of particles that holds all that may touch until particles and wall together have gone
/// further than the margin it was made with.
class WallCandidates {
 public:
  /// Particles have got other indices, or a run begins.
  void forget() { known = false; }

  /// `moved`: how far a particle has gone at most since neighbor lists were made; `shifted`: the
  /// wall since list().
  bool are_stale(double moved, double shifted, int owned) const
  {
    return !known || owned != owned_then ||
           (!everything && !(moved + moved_then + shifted <= margin));
  }

  /// Those of the owned particles that are near; far(i) is called with the others. near(eight,
  /// margin) has a bit for each of eight particles, the last of which may be there several times.
  /// `margin`: a little more than the way that particles and wall may go. Both are called by
  /// `threads` at the same time, each particle once.
  template <class Near, class Far>
  void list(int owned, double skin, double moved, int threads, Near near, Far far)
  {
    begin(owned, skin, moved);
    std::vector<std::vector<int>> found(threads);
    in_ranges(owned, threads, [&](int t, int begin, int end) {
      for (int first = begin; first < end; first += lanes) {
        int eight[lanes];
        for (int k = 0; k < lanes; k++) eight[k] = std::min(first + k, end - 1);
        const unsigned bits = near(eight, widened());
        for (int k = 0; k < lanes && first + k < end; k++)
          if (bits >> k & 1U)
            found[t].push_back(first + k);
          else
            far(first + k);
      }
    });
    for (const std::vector<int> &some : found) atoms.insert(atoms.end(), some.begin(), some.end());
    touched.assign(atoms.size(), 1);
  }

  /// All that are members: for a wall of which no distance is known. Stale only if indices change.
  template <class Member> void list_all(int owned, Member member)
  {
    begin(owned, 0.0, 0.0);
    everything = true;
    for (int i = 0; i < owned; i++)
      if (member(i)) atoms.push_back(i);
    touched.assign(atoms.size(), 1);
  }

  int size() const { return static_cast<int>(atoms.size()); }
  /// Local indices of candidate c and those behind it, of the last one again where there is none.
  void eight_from(int c, int (&eight)[lanes]) const
  {
    for (int k = 0; k < lanes; k++) eight[k] = atoms[std::min(c + k, size() - 1)];
  }
  /// Local indices, ascending.
  std::vector<int> atoms;
  /// Whether each may have a history that is not zero; for the owner.
  std::vector<unsigned char> touched;

  double memory_usage() const
  {
    return static_cast<double>(atoms.capacity() * sizeof(int) + touched.capacity());
  }

 private:
  bool known = false, everything = false;
  int owned_then = 0;
  double margin = 0.0, moved_then = 0.0;

  void begin(int owned, double skin, double moved)
  {
    atoms.clear();
    known = true;
    everything = false;
    owned_then = owned;
    margin = skin;
    moved_then = moved;
  }
  double widened() const { return 1.000001 * margin; }    // rounding must not hide a particle
};

}    // namespace Talus

#endif
