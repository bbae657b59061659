// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The neighbor lists that a LAMMPS instance has at present: which they are, the box in which they were made, and how
// far they reach. Snapshots ask whether they are still those of then.
//
// The skin is that of the neighbor command, or a wider one that is chosen in the course of a run (skin_choice.h), with
// run style verlet/proxy `skin chosen` where it finds pairs itself. All that lists something until particles have moved by half of the
// skin asks here. Lists that LAMMPS makes for others are then made with the widest that may be chosen: these others have
// no influence on the choice, and ghosts reach as far as the lists that there are.

#ifndef TALUS_SYSTEM_STEP_NEIGHBOR_LISTS_H
#define TALUS_SYSTEM_STEP_NEIGHBOR_LISTS_H

#include "lmptype.h"
#include "pointers.h"

#include <array>
#include <cstdint>
#include <string>

namespace LAMMPS_NS {
class Domain;
}

namespace Talus {

class GranularSystem;
struct NeighborView;
class StateExchange;

/// The simulation box: corners and tilt.
struct DomainBox {
  std::array<double, 3> low{}, high{}, tilt{};    ///< tilt: xy, xz, yz

  static DomainBox of(const LAMMPS_NS::Domain &domain);
  void give_to(LAMMPS_NS::Domain &domain) const;
};

class NeighborLists : protected LAMMPS_NS::Pointers {
 public:
  NeighborLists(LAMMPS_NS::LAMMPS *lmp, GranularSystem &owner) : Pointers(lmp), system(owner) {}

  /// Lists have just been made: the first ones, or others than before.
  void are_new();
  /// They are again those that had this number.
  void are_again(LAMMPS_NS::bigint number) { present = number; }
  /// 0: there are none.
  LAMMPS_NS::bigint number() const { return present; }
  const DomainBox &box() const { return box_then; }

  /// Of the present lists, and of those that are made next (length).
  double skin() const;
  /// In the init() of the pair style, before that of class Neighbor. `wanted`: the skin may be chosen, if nothing is
  /// against it.
  void init(bool wanted);
  /// By the run style, after all init().
  void start_run();
  /// What LAMMPS takes for the reach of neighbor lists, where only ours are there (length).
  double reach_of_ghosts() const;
  /// By the run style, where lists are due since particles have moved, before ghosts are chosen; collective: the next
  /// ones may have another skin.
  void have_served();
  /// By who has just found pairs.
  void count(const NeighborView &found);
  /// "", or for the log what was chosen in this run.
  std::string summary() const;
  /// For restart files: what was chosen (0: nothing) where the neighbor command gives this skin (lengths).
  struct Choice {
    double given = 0.0, chosen = 0.0;
  };
  const Choice &choice() const { return skins; }
  /// Out of a file.
  void go_on_with(const Choice &choice) { skins = choice; }
  /// The pair style goes.
  void end_choice();

  void exchange_state(StateExchange &x);

 private:
  bool can_choose() const;
  bool is_choice_due() const;
  double widest() const;

  GranularSystem &system;
  LAMMPS_NS::bigint present = 0, last = 0;
  DomainBox box_then;
  bool may_choose = false;
  bool is_widened = false;    // class Neighbor has the wide skin at present
  Choice skins;
  double wide = 0.0;    // that of class Neighbor during init(), and of its lists; 0: the given one
  int made = 0;         // lists in this run
  // of the last lists, on this rank: pairs by the number of owned particles in them; diameters in units
  std::int64_t candidates = 0, diameters = 0;
  double unit = 0.0;    // length; 0: not counted
};

}    // namespace Talus

#endif
