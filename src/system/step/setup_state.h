// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// With what a run was set up: fixes, computes, regions, equal-style variables (fixes know them by their place),
// the pair style and its laws, the run style, the communication object, and the particles of this rank. Commands
// between two runs may define, delete or replace any of them, and LAMMPS does not tell. Who goes on without a
// set-up (`run ... pre no`, calls of the coupling, snapshots) asks here before it looks at anything that it
// remembers.
//
// Fixes and computes have numbers, communication objects are watched by ExchangeSwitch; regions have
// neither, and are told apart by what they look like and where they are in memory.
//
// All questions are collective, and answered alike on all ranks.

#ifndef TALUS_SYSTEM_STEP_SETUP_STATE_H
#define TALUS_SYSTEM_STEP_SETUP_STATE_H

#include "lmptype.h"
#include "pointers.h"

#include <cstdint>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Region;
}

namespace Talus {

class GranularSystem;

class SetupState : protected LAMMPS_NS::Pointers {
 public:
  SetupState(LAMMPS_NS::LAMMPS *lmp, GranularSystem &owner) : Pointers(lmp), system(owner) {}

  /// LAMMPS lists the fixes that act, for whatever command: in each of its init(). And before that of the pair style
  /// makes coefficients of the script's words again.
  void list_fixes();
  void expect_new_laws();
  /// A run style of Talus has been defined.
  void expect_new_run_style() { run_style_is_new = true; }
  /// A run has been set up.
  void record_setup();
  /// It has ended, which may have added or deleted particles; or a snapshot is restored.
  void record();
  /// "" or what others may point to and is there no more as it was set up, or what LAMMPS has not listed,
  /// as text for messages: "fix w (wall/gran) has been defined".
  std::string lost() const;
  /// The same of all that commands define, and of the number of particles.
  std::string change() const;
  /// And of which particles each rank owns, in which order.
  std::string change_with_particles() const;
  /// The pair style is not the one that was set up.
  bool has_another_pair_style() const { return is_set_up && then.pair != present_pair(); }
  /// A dump has been defined that no run has been set up with: LAMMPS ends one rank when it is written, or all.
  bool has_new_dump() const;
  /// Where each rank owns the same particles as then, in the same order: whether ghosts are others, so that
  /// neighbor lists have to be made.
  bool has_other_ghosts() const;

 private:
  struct One {
    std::string name;
    std::uint64_t number;
  };
  using List = std::vector<One>;
  struct SetUp {
    List fixes, computes, regions, variables;
    std::string run_style;
    std::vector<const LAMMPS_NS::Region *> addresses;    // of the regions
    int pair = -1, laws = -1, communication = -1;
    LAMMPS_NS::bigint particles = 0;
    std::uint64_t owned = 0, ghosts = 0;
  };
  List present_fixes() const;
  List present_computes() const;
  List present_regions() const;
  List present_variables() const;
  int present_pair() const;
  std::string lost_here() const;
  bool has_moved_region() const;
  std::uint64_t digest_of_particles(int begin, int end) const;
  bool on_any_rank(bool here) const;

  GranularSystem &system;
  List listed;                                       // fixes
  bool is_set_up = false, laws_are_known = false;    // the second: in an init()
  bool run_style_is_new = false;
  SetUp then;
};

}    // namespace Talus

#endif
