// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A contact model of pair_style granular as a contact law of Talus. The laws have the same names as
// the sub-models, but for hertz/material, which is hertz with a stiffness that follows from moduli.

#ifndef TALUS_SYSTEM_CONTACTS_GRANULAR_SPEC_H
#define TALUS_SYSTEM_CONTACTS_GRANULAR_SPEC_H

#include "laws/given_law.h"

#include <optional>
#include <string>
#include <vector>

namespace LAMMPS_NS::Granular_NS {
class GranularModel;
}

namespace Talus {

using Model = LAMMPS_NS::Granular_NS::GranularModel;

/// "", or what in the model only LAMMPS has.
std::string reason_of_model(const Model &model);

/// Of a model without such a reason, after its init().
ContactSpec spec_of_model(const Model &model);

/// What restart files of LAMMPS hold of a contact of any of the models: its values, and the places
/// of these with us, see HistoryLayout; -1: the value is not used. nullopt: the laws keep a value
/// of a stage at different places. Empty: nothing is kept. Models without a law have no places.
std::optional<std::vector<int>> stock_history_of(const std::vector<const Model *> &models);

}    // namespace Talus

#endif
