// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The large bodies of a LAMMPS instance, and which of them add their forces while contacts between
// particles are computed, in the records. GranularSystem owns them; commands create and query them.

#ifndef TALUS_SYSTEM_BODIES_LARGE_BODIES_H
#define TALUS_SYSTEM_BODIES_LARGE_BODIES_H

#include "system/bodies/large_body.h"

#include "pointers.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Fix;
}

namespace Talus {

class GranularSystem;

class LargeBodies : protected LAMMPS_NS::Pointers {
 public:
  LargeBodies(LAMMPS_NS::LAMMPS *lmp, GranularSystem &owner) : Pointers(lmp), system(owner) {}

  /// A new body, until remove(): at the end of the constructor of the command that defines it, and in its
  /// destructor.
  LargeBody &add(const LAMMPS_NS::Fix *command, LargeBodySpec spec);
  void remove(const LargeBody &body);
  /// All of them, in the order of the script.
  std::vector<LargeBody *> in_order() const;
  int count() const { return static_cast<int>(all.size()); }
  /// Of the command with this ID; nullptr: there is none.
  LargeBody *find(const std::string &id) const;
  /// The work of the contacts of one of them is accounted for.
  bool account() const;

  /// At the start of a run, after set-up: which bodies come before all fixes that add their forces
  /// on their own.
  void start_run();
  /// At the beginning of a step whose particles are in the records before and after it: those that
  /// join it, see LargeBody::join_step(). Returns whether there are any.
  bool join_step();
  /// See LargeBody: of the bodies that have joined.
  void add_to_slots(int thread, int begin, int end);

 private:
  GranularSystem &system;
  std::vector<std::unique_ptr<LargeBody>> all;
  std::vector<LargeBody *> may_join;    // in this run
  std::size_t joined = 0;               // the first of these, in this step
};

}    // namespace Talus

#endif
