// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Bridges of the liquid that particles have (laws/cohesion/liquid_of_particles.h), in a step: ContactChunk finds their
// volumes before the kernels run, with the liquid from before the step, and which of them break; when all chunks are
// done the flows are added particle by particle in the canonical order of their neighbors, so that a pair that two
// ranks compute gives on both of them the same bits.

#ifndef TALUS_CONTACT_LIQUID_BRIDGES_H
#define TALUS_CONTACT_LIQUID_BRIDGES_H

#include "material/law_table.h"

#include <vector>

namespace Talus {

/// Of a row of the table of laws.
struct BridgeTerms {
  double share = 0.0;         ///< 0: there are none
  double volume, fraction;    ///< the largest: volume + fraction (V_1 + V_2)
  double reach;               ///< breaks at reach V^(1/3)
  int history;                ///< index of V among the values of the contact

  double largest(double radius_1, double radius_2) const;
  /// Whether a bridge of this volume holds where the surfaces are apart by `gap` (length).
  bool holds(double bridge_volume, double gap) const
  {
    return gap * gap * gap < reach * reach * reach * bridge_volume;
  }
};

class LiquidBridges {
 public:
  void set(const LawTable &table);

  bool any() const { return !of_row.empty(); }
  /// Only if there are any.
  const BridgeTerms &terms(int row) const { return of_row[row]; }

  /// In the history of dry particles that touch; 0 is that of a contact that is new.
  static constexpr double dry = -1.0;

 private:
  std::vector<BridgeTerms> of_row;
};

/// What the first particle of a pair received of the second one when their bridge broke (distance^3), by slot.
struct LiquidFlow {
  int first, second;
  double volume;
};

}    // namespace Talus

#endif
