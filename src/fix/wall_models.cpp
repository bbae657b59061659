// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/wall_models.h"

#include "gran_sub_mod.h"
#include "granular_model.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace Granular_NS;

namespace Talus {
namespace {

/* As a restart file makes one: from the names of its sub-models and their coefficients. */

std::unique_ptr<Model> model_like(LAMMPS *lmp, const Model &given)
{
  auto model = std::make_unique<Model>(lmp);
  model->contact_type = given.contact_type;
  model->limit_damping = given.limit_damping;
  for (int n = 0; n < NSUBMODELS; n++) {
    const GranSubMod &from = *given.sub_models[n];
    model->construct_sub_model(from.name, static_cast<SubModelType>(n));
    GranSubMod &to = *model->sub_models[n];
    std::copy_n(from.coeffs, from.num_coeffs, to.coeffs);
    to.coeffs_to_local();
  }
  model->init();
  for (int n = 0; n < NSUBMODELS; n++)
    model->sub_models[n]->history_index = given.sub_models[n]->history_index;
  return model;
}

}    // namespace

WallModels::WallModels() = default;
WallModels::~WallModels() = default;

void WallModels::init(LAMMPS *lmp, Model &own, int threads)
{
  first = &own;
  others.clear();
  for (int n = 1; n < threads; n++) others.push_back(model_like(lmp, own));
}

void WallModels::begin_step(double dt, bool advance, bool with_details, double *wall_velocity)
{
  for (int t = 0; t < threads(); t++) {
    Model &model = of(t);
    model.dt = dt;
    model.history_update = advance ? 1 : 0;
    model.calculate_svector = with_details ? 1 : 0;
    model.radj = 0.0;
    model.vj = wall_velocity;
    model.omegaj = no_omega;
  }
}

}    // namespace Talus
