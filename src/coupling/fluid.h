// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What a partner that computes a fluid has told of it: cells and laws.

#ifndef TALUS_COUPLING_FLUID_H
#define TALUS_COUPLING_FLUID_H

#include "coupling/partner.h"

#include "fluid/drag_law.h"
#include "fluid/lift_law.h"
#include "system/loads/grains_in_fluid.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace Talus {

struct PartnerFluid {
  std::unique_ptr<GrainsInFluid> grains;    ///< nullptr: no cells yet
  bool whole = false;    ///< each rank has all cells, and the first one owns them
  int num_cells = 0;     ///< of this rank

  bool has_law = false;
  DragLaw law;
  LiftLaw lift;
  double density = 0.0, viscosity = 0.0;
};

/// Of the partner, made if there is none.
PartnerFluid &fluid_of(talus_partner &partner);
/// With cells that fit to this box, and that hold its grains if these are `inside`. Throws Refusal.
PartnerFluid &fluid_with_cells(talus_partner &partner, bool inside);

}    // namespace Talus

#endif
