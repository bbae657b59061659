// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Calls the fixes of a step, as Modify does. In steps in the records fixes of LAMMPS that are known
// to read and change a few quantities of the particles of their group only see these in the arrays of
// LAMMPS: before the call they are copied there, and what the fix may change is copied back; where
// it does less than that with each particle, it is done in the records instead. What fix deform moves
// at the end of a step is copied as well. Fixes that read particles at the end of a step, such as fix
// ave/time, find all of them there, complete, while the run goes on in the records; and so does what
// updates dynamic groups. All other fixes of LAMMPS that act within steps keep a run from having steps
// in the records.

#ifndef TALUS_SYSTEM_HOST_FIX_CALLS_H
#define TALUS_SYSTEM_HOST_FIX_CALLS_H

#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class Fix;
}    // namespace LAMMPS_NS

namespace Talus {

class GranularSystem;
class ParticleState;

class FixCalls : protected LAMMPS_NS::Pointers {
 public:
  FixCalls(LAMMPS_NS::LAMMPS *lmp, GranularSystem &owner) : Pointers(lmp), system(owner) {}

  /// At the start of a run, of a fix of LAMMPS that acts within steps: "", or why it needs the arrays
  /// in each step, as text for messages. Collective.
  std::string reason_against(const LAMMPS_NS::Fix *fix);
  /// What this fix of LAMMPS does at the end of a step changes no particle.
  static bool only_reads(const LAMMPS_NS::Fix *fix);
  /// Or changes the positions of its group alone, at most: it is called in the records as well.
  bool only_moves(const LAMMPS_NS::Fix *fix) const;
  /// One of the former reads particles at the end of the present step.
  bool somebody_looks() const;
  /// What decides on members of a dynamic group may ask for anything in any step.
  bool groups_may_ask() const { return asking_groups; }

  /// At the start of a run, after all of them were asked.
  void start_run();

  /// The same as the methods of Modify with these names.
  void initial_integrate(int vflag);
  void post_integrate();
  void post_force(int vflag);
  void final_integrate();
  void end_of_step();

 private:
  /// What a style of LAMMPS does: in which calls, with which quantities of its group.
  struct Window {
    const char *style;
    int calls, reads, writes;    ///< bits; what is written is read as well
    bool whole = false;          ///< of all particles: it reads those of another group as well
    /// What it does with one particle, with the same bits, where that is less than to show it.
    void (*on_one)(const ParticleState &particles, int i) = nullptr;
  };
  enum Quantity : int { X = 1, V = 2, OMEGA = 4, F = 8, TORQUE = 16 };

  static const Window *window_of(const LAMMPS_NS::Fix *fix);
  static bool integrates(const Window *window);
  std::string reason_of_mover(const LAMMPS_NS::Fix *fix) const;
  std::string reason_of_variables(const LAMMPS_NS::Fix &fix) const;
  struct Called {
    LAMMPS_NS::Fix *fix;
    const Window *window;        ///< nullptr: it needs none
    std::vector<int> members;    ///< local indices of the particles that it acts on,
    LAMMPS_NS::bigint lists;     ///< as of this build of neighbor lists
    int owned;
  };
  using Phase = std::vector<Called>;
  template <class Call> void call_all(Phase &phase, Call call);
  bool groups_are_due() const;
  bool reads_positions_alone(LAMMPS_NS::Fix *group_fix) const;
  void update_groups(int vflag);
  void forget_members();
  void find_members(Called &called) const;
  void copy(const Called &called, int quantities, bool to_arrays) const;
  template <class Visit> void for_each_member(const Called &called, Visit visit) const;

  GranularSystem &system;
  Phase initial, post, forces, final, end;          // of this run
  std::vector<LAMMPS_NS::Fix *> groups, readers;    // that are dynamic; at the end of a step
  bool asking_groups = false;
};

}    // namespace Talus

#endif
