/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#ifndef LMP_CLUMP_TABLE_H
#define LMP_CLUMP_TABLE_H

#include "base/vector3.h"

#include "lmptype.h"

#include <cstdint>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   The clumps of which a rank owns a sphere, between two rebuilds: all their spheres, also those
   that other ranks own, in ascending order of their IDs. What is summed over the spheres of a
   clump in this order has the same bits on all ranks that own a part of it.

   Made by the fix that moves clumps whenever neighbor lists are made; indices are those of LAMMPS,
   below the number of owned particles or of a ghost.
------------------------------------------------------------------------- */

struct ClumpSphere {
  Talus::Vector3<double> place;    // relative to the center of mass, along the principal axes
  tagint tag;
  int atom;
  bool owned;        // by this rank: its state is set here
  bool wrapped;      // box holds periods other than 0
  int periods[3];    // between the sphere and the center of mass as it is counted
};

struct ClumpTable {
  std::vector<int> body;              // of each clump, as the fix counts bodies
  std::vector<std::int64_t> first;    // of each clump in spheres, and the end
  std::vector<ClumpSphere> spheres;

  int size() const { return static_cast<int>(body.size()); }
  const ClumpSphere *begin(int clump) const { return spheres.data() + first[clump]; }
  const ClumpSphere *end(int clump) const { return spheres.data() + first[clump + 1]; }
  ClumpSphere *begin(int clump) { return spheres.data() + first[clump]; }
  ClumpSphere *end(int clump) { return spheres.data() + first[clump + 1]; }
};

}    // namespace LAMMPS_NS

#endif
