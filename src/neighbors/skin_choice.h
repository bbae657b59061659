// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which skin neighbor lists should have: a wide one lists more pairs that do not touch and is made
// less often. Chosen from what is counted, not timed, so that it is the same on any machine and any
// number of ranks and threads. The idea of a list range that follows from its cost is that of the
// Verlet buffer of GROMACS (Pall and Hess, Comput. Phys. Commun. 184, 2641 (2013)).
//
// With skin s a list of n particles has C(s) = C (D + s)^3 / (D + s_0)^3 candidates, where D is the
// mean diameter, and lasts T(s) = T s / s_0 steps, if C and T are what was counted with s_0. A step
// costs C(s) c_look, and to make a list costs n c_particle + C(s) c_list.
//
// Units: any, the same for all lengths. Called by the owner of the lists; knows nothing of LAMMPS.

#ifndef TALUS_NEIGHBORS_SKIN_CHOICE_H
#define TALUS_NEIGHBORS_SKIN_CHOICE_H

#include <cstdint>

namespace Talus {

/// Of the lists that have just served, over all ranks.
struct CountedLists {
  double skin;                ///< length, > 0
  double mean_diameter;       ///< length
  std::int64_t particles;     ///< > 0
  std::int64_t candidates;    ///< pairs, each once
  std::int64_t
      steps;    ///< for which they served until a particle had moved by half of the skin, > 0
};

/// Lists of these skins are allowed (length).
struct SkinLimits {
  double given;    ///< by the user: the least
  double most;     ///< below `given`: only that
};

/// A skin on a grid of ratios to the given one; the present one where another is not clearly better.
double choose_skin(const CountedLists &counted, const SkinLimits &limits);

}    // namespace Talus

#endif
