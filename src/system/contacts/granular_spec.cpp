// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/granular_spec.h"

#include "laws/law_list.h"
#include "system/host/lammps_compat.h"
#include "system/host/private_members.h"

#include "gran_sub_mod_normal.h"
#include "gran_sub_mod_rolling.h"
#include "gran_sub_mod_tangential.h"
#include "gran_sub_mod_twisting.h"
#include "granular_model.h"

#include <algorithm>
#include <array>

using namespace LAMMPS_NS::Granular_NS;

namespace Talus {

namespace {

struct StageOfModel {
  SubModelType type;
  Stage stage;
  const char *word;
};
constexpr StageOfModel stages[] = {{NORMAL, Stage::NORMAL, "normal"},
                                   {DAMPING, Stage::DAMPING, "damping"},
                                   {TANGENTIAL, Stage::TANGENTIAL, "tangential"},
                                   {ROLLING, Stage::ROLLING, "rolling"},
                                   {TWISTING, Stage::TWISTING, "twisting"},
                                   {HEAT, Stage::HEAT, "heat"}};

/* In releases that have it. */

template <class AnyModel>
auto is_synchronized(const AnyModel *model) -> decltype(model->synchronized_verlet != 0)
{
  return model->synchronized_verlet != 0;
}
[[maybe_unused]] bool is_synchronized(const void *)
{
  return false;
}

const Law *law_of(const Model &model, const StageOfModel &sub_model)
{
  const Stage stage = sub_model.stage;
  const std::string &name = model.sub_models[sub_model.type]->name;
  const bool follows = stage == Stage::TANGENTIAL || (stage == Stage::ROLLING && name != "none");
  if (follows && is_synchronized(&model)) return find_law(stage, name + " synchronized_verlet");
  if (stage == Stage::NORMAL && name == "hertz/material") return find_law(stage, "hertz");
  const bool classic = name == "linear_history_classic" || name == "mindlin_classic";
  if (classic && !TALUS_HOST_SCALES_CLASSIC_SLIP) return find_law(stage, "classic of 4 Feb 2025");
  return find_law(stage, name);
}

void give_normal(const Model &model, GivenNumbers &given)
{
  GranSubModNormal *normal = model.normal_model;
  const std::string &damping = model.sub_models[DAMPING]->name;
  const bool restitutes = damping == "tsuji" || damping == "coeff_restitution";
  given[restitutes ? "eta" : "gn"] = normal->get_damp();
  if (normal->get_material_properties()) {
    given["E"] = normal->coeffs[0];
    given["nu"] = normal->coeffs[2];
  }
  if (const auto *hooke = dynamic_cast<GranSubModNormalHooke *>(normal))
    given["kn"] = stiffness_of(*hooke);
  if (const auto *hertz = dynamic_cast<GranSubModNormalHertz *>(normal))
    given["kn"] = stiffness_of(*hertz);
  if (const auto *dmt = dynamic_cast<GranSubModNormalDMT *>(normal)) {
    given["E_eff"] = 0.75 * stiffness_of(*dmt);
    given["gamma"] = dmt->coeffs[3];
  }
  if (const auto *jkr = dynamic_cast<GranSubModNormalJKR *>(normal)) {
    given["E_eff"] = modulus_of(*jkr);
    given["gamma"] = jkr->coeffs[3];
  }
}

/* The last two coefficients of all tangential models are xt and mu; k is 0 without a spring. */

void give_tangential(const Model &model, GivenNumbers &given)
{
  const GranSubModTangential &tangential = *model.tangential_model;
  given["kt"] = tangential.get_k();
  given["xt"] = tangential.coeffs[tangential.num_coeffs - 2];
  given["mu"] = tangential.get_mu();
}

void give_resistance(const GranSubMod &sub_model, const std::array<const char *, 3> &names,
                     GivenNumbers &given)
{
  if (sub_model.num_coeffs != static_cast<int>(names.size())) return;
  for (std::size_t n = 0; n < names.size(); n++) given[names[n]] = sub_model.coeffs[n];
}

}    // namespace

std::string reason_of_model(const Model &model)
{
  for (const StageOfModel &sub_model : stages) {
    const std::string &name = model.sub_models[sub_model.type]->name;
    if (!law_of(model, sub_model)) return std::string(sub_model.word) + " model " + name;
  }
  return "";
}

ContactSpec spec_of_model(const Model &model)
{
  ContactSpec spec;
  for (const StageOfModel &sub_model : stages)
    spec.law.choose(sub_model.stage, law_of(model, sub_model));
  give_normal(model, spec.given);
  give_tangential(model, spec.given);
  give_resistance(*model.rolling_model, {"k_roll", "gamma_roll", "mu_roll"}, spec.given);
  give_resistance(*model.twisting_model, {"k_twist", "gamma_twist", "mu_twist"}, spec.given);
  if (spec.law.conducts_heat()) spec.given["heat"] = model.sub_models[HEAT]->coeffs[0];
  if (spec.law.synchronized()) spec.given["dt"] = model.dt;
  if (model.limit_damping) spec.given["limit_damping"] = 1.0;
  return spec;
}

std::optional<std::vector<int>> stock_history_of(const std::vector<const Model *> &models)
{
  std::array<std::vector<int>, NSUBMODELS> values;
  bool beyond_contact = false;
  for (const Model *model : models) {
    beyond_contact = beyond_contact || model->beyond_contact;
    for (int type = 0; type < NSUBMODELS; type++) {
      const std::size_t size = model->sub_models[type]->size_history;
      if (size > values[type].size()) values[type].resize(size, -1);
    }
    if (!reason_of_model(*model).empty()) continue;
    const ContactLaw law = spec_of_model(*model).law;
    const HistoryLayout layout = law.history();
    for (const StageOfModel &sub_model : stages) {
      const int kept = law[sub_model.stage].odd_history + law[sub_model.stage].even_history;
      for (int n = 0; n < kept; n++) {
        const int place = layout.of_stage[static_cast<int>(sub_model.stage)][n];
        int &known = values[sub_model.type].at(n);
        if (known >= 0 && known != place) return {};
        known = place;
      }
    }
  }
  std::vector<int> all;
  for (const std::vector<int> &indices : values)
    all.insert(all.end(), indices.begin(), indices.end());
  if (all.empty() && beyond_contact) all.push_back(-1);    // that the particles touch
  return all;
}

}    // namespace Talus
