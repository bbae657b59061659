// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Part of a snapshot: what LAMMPS keeps of the particles that a rank owns, in their order.

#ifndef TALUS_SYSTEM_SNAPSHOT_SAVED_PARTICLES_H
#define TALUS_SYSTEM_SNAPSHOT_SAVED_PARTICLES_H

#include "lmptype.h"
#include "pointers.h"

#include <cstddef>
#include <vector>

namespace Talus {

class SavedParticles : protected LAMMPS_NS::Pointers {
 public:
  explicit SavedParticles(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  void save();
  /// All arrays of the particles with these indices; particles behind them are gone, and ghosts too unless
  /// they `stay`. Room for all that there were.
  void restore(bool ghosts_stay) const;
  /// After it, where only positions may have changed since.
  void restore_positions() const;
  int count() const { return owned; }
  double memory_usage() const;

 private:
  struct Rows {
    std::size_t place;    ///< in the list of arrays of LAMMPS
    std::size_t bytes;    ///< of a particle
    std::vector<char> data;
  };
  /// Those that are in use.
  struct Array {
    char *first;
    std::size_t bytes;
  };
  Array array(std::size_t place) const;
  void restore(const Rows &rows) const;

  int owned = 0, first_group = 0, total = 0;
  LAMMPS_NS::bigint number = 0;    // of particles on all ranks
  std::vector<Rows> arrays;
};

}    // namespace Talus

#endif
