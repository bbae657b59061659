// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How far particles have gone since neighbor lists were made. In the records a bound of it costs
// nothing: in each step no particle goes further than the fastest one. To find it exactly takes a
// look at all of them, which is needed only when the bound has come near to half of the skin.

#ifndef TALUS_SYSTEM_STEP_LARGEST_MOVE_H
#define TALUS_SYSTEM_STEP_LARGEST_MOVE_H

#include "lmptype.h"
#include "pointers.h"

namespace Talus {

class ContactPipeline;

class LargestMove : protected LAMMPS_NS::Pointers {
 public:
  explicit LargestMove(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /// At the start of a run: nothing is known.
  void forget() { known_at = moved_in_records = -1; }
  /// The particles of this step are moved in the records of the pipeline.
  void moves_in_records();
  bool was_in_records() const;

  /// After particles have moved: largest distance of an owned particle from where it was when
  /// neighbor lists were made (length), or a little more; infinity if it is not known.
  double at_most(ContactPipeline &pipeline);
  /// The same, exactly.
  double exactly(ContactPipeline &pipeline);

 private:
  bool is_checked() const;
  bool is_known() const;
  template <class Place> double largest(Place place) const;

  LAMMPS_NS::bigint moved_in_records = -1;        // last step whose move was made there
  LAMMPS_NS::bigint known_at = -1, lists = -1;    // step, and how often lists had been made
  double distance = 0.0;
  bool exact = false;
};

}    // namespace Talus

#endif
