// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Decides when neighbor lists are rebuilt, without waiting for all ranks in every step: takes the
// place of Neighbor::decide() in our Verlet loop and keeps to `neigh_modify`.
//
// The question how far particles may be in the next step is asked in one step (ask()) and the
// answer used in the next (decide()), see motion_forecast.h. With `every 1` a forecast that a
// particle may be beyond half of the skin is followed by LAMMPS' own check in the step itself:
// lists are rebuilt in the same steps as by LAMMPS. With `every N` they are rebuilt if a particle
// may move beyond it before the next step in which they may be rebuilt.
//
// All methods are collective; every rank decides the same.

#ifndef TALUS_RUN_REBUILD_CHECK_H
#define TALUS_RUN_REBUILD_CHECK_H

#include "exchange/motion_forecast.h"
#include "system/step/neighbor_lists.h"

#include "pointers.h"

#include <array>
#include <functional>
#include <memory>

namespace Talus {

class GranularSystem;

class RebuildCheck : protected LAMMPS_NS::Pointers {
 public:
  explicit RebuildCheck(LAMMPS_NS::LAMMPS *lmp);
  /// Completes what was asked; after a second without an end (a rank has left with an error) gives
  /// it up. Collective.
  ~RebuildCheck() override;
  RebuildCheck(const RebuildCheck &) = delete;
  RebuildCheck &operator=(const RebuildCheck &) = delete;

  /// LAMMPS has just made new lists.
  void list_is_new();

  /// After the particles of this step have moved and lists, if due, are made: starts to find out
  /// how far particles may be in the next step, if a check is due there. Does not wait.
  /// `in_records`: who knows, where the arrays of LAMMPS are not up to date, or nullptr.
  void ask(Talus::GranularSystem *in_records);

  /// Once per step, after particles have moved: whether lists are rebuilt in this step. `moved`:
  /// tells how far the particles of this rank are from where they were when lists were made.
  bool decide(const std::function<double()> &moved);

  /// At the start of a run, and at its end, where what was asked is not needed: lists that have other numbers
  /// between them come from a snapshot.
  void start_run(const NeighborLists &present);
  void end_run(const NeighborLists &present);

  /// Lists that were used too long, in this run: because `neigh_modify every` and `delay` left no
  /// step before in which they could be rebuilt, or because particles moved further than
  /// foreseen.
  int num_delayed() const { return delayed; }
  int num_unforeseen() const { return unforeseen; }

 private:
  MotionForecast forecast(Talus::GranularSystem &in_records) const;
  using Corners = std::array<std::array<double, 3>, 8>;
  void drop();
  static Corners corners_of(const DomainBox &box);
  double limit() const;
  double limit_when_asked() const;
  bool has_left(double moved) const;

  MPI_Comm own_world = MPI_COMM_NULL;
  MPI_Request request = MPI_REQUEST_NULL;
  bool asked = false;
  struct Lengths {
    double mine[2], all[2];    ///< of a MotionForecast, here and everywhere
  };
  std::unique_ptr<Lengths> lengths = std::make_unique<Lengths>();    ///< MPI writes here
  LAMMPS_NS::bigint list_step = -1;    ///< when the lists were made, as far as we know
  LAMMPS_NS::bigint number = 0;        ///< of NeighborLists, at the end of the last run
  Corners corners_of_list{}, corners_when_asked{};
  int delayed = 0, unforeseen = 0;
};

}    // namespace Talus

#endif
