// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The law of a wall of LAMMPS, and where the stock fix keeps what its contacts remember.

#ifndef TALUS_FIX_WALL_WALL_LAW_H
#define TALUS_FIX_WALL_WALL_LAW_H

#include "base/history_values.h"
#include "material/law_table.h"
#include "system/contacts/granular_spec.h"

#include <vector>

namespace Talus {

class WallLaw {
 public:
  /// Of a model without a reason_of_model(), after the init() of its fix; the same for all types of
  /// particles.
  void take(const Model &model, int num_types);

  const LawTable &laws() const { return table; }
  const ContactLaw &law() const { return table.law(0); }

  /// A row of the stock fix: whether it is that of a contact; what it holds; and such a row of a
  /// contact. Values that the law does not use are zero.
  bool touches(const double *row) const;
  void read(const double *row, HistoryValues &values) const;
  void write(const HistoryValues &values, double *row) const;

 private:
  LawTable table;
  std::vector<int> places;     // of each value of a row: its index with us, -1: not used
  bool marks_touch = false;    // the first value tells that the contact has begun
};

}    // namespace Talus

#endif
