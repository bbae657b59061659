// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Part of a snapshot: the neighbor lists of then. Where these are gone they are made again, with the
// same ghosts (pairs are kept, and shared by snapshots with the same lists): from the positions at which they were made, which LAMMPS keeps, in the
// decomposition and in the box of then. Lists from the positions at the time of the snapshot would not do:
// particles may go back by more than the skin before the next rebuild. And the next rebuild has to come in the
// same step, for in periodic boxes it rounds positions.
//
// All methods but the constructor are collective.

#ifndef TALUS_SYSTEM_SNAPSHOT_SAVED_LISTS_H
#define TALUS_SYSTEM_SNAPSHOT_SAVED_LISTS_H

#include "contact/contact_pipeline.h"
#include "system/step/neighbor_lists.h"

#include "lmptype.h"
#include "pointers.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace Talus {

class GranularSystem;

class SavedLists : protected LAMMPS_NS::Pointers {
 public:
  /// `owner` must live as long as this.
  SavedLists(LAMMPS_NS::LAMMPS *lmp, GranularSystem &owner);

  void save();
  /// "", or why these lists cannot be made again, and the cure.
  std::string reason_against_restoring() const;
  /// The instance still has these lists, and the same particles at the same places of its arrays.
  bool are_present() const;
  /// Before particles come back: decomposition and box of then.
  void prepare() const;
  /// The particles of this rank are back, but for their positions: makes the lists, and then the box is that
  /// of the snapshot. Returns false on all ranks if ghosts are not the same on some: then nothing is made.
  bool make_again() const;
  double memory_usage() const;

 private:
  struct Decomposition {
    int layout = 0, cut_dimension = 0;
    double cut = 0.0;
    std::array<double, 6> own_split{};
    std::array<std::vector<double>, 3> splits;

    bool operator==(const Decomposition &o) const
    {
      return layout == o.layout && cut_dimension == o.cut_dimension && cut == o.cut &&
             own_split == o.own_split && splits == o.splits;
    }
  };
  Decomposition present_decomposition() const;
  std::uint64_t digest_of_particles() const;
  bool on_all_ranks(bool here) const;
  void run_hooks_and_build() const;

  GranularSystem &system;
  NeighborLists &made;
  std::shared_ptr<const ContactPipeline::Lists>
      pairs;    ///< between spheres; those with shapes are found anew
  LAMMPS_NS::bigint number = 0, step = -1;
  Decomposition decomposition;
  int comm_style = 0;
  DomainBox box;
  DomainBox box_of_lists;
  std::uint64_t particles = 0;      // digest of owned ones and ghosts
  std::vector<double> positions;    // at which lists were made; empty: not known
};

}    // namespace Talus

#endif
