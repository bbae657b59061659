// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "pair/pair_granular_talus.h"

#include "pair/accelerated_pair_impl.h"

#include "gran_sub_mod.h"
#include "granular_model.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace Talus;

PairGranularTalus::PairGranularTalus(LAMMPS *lmp) : AcceleratedPair(lmp, "granular") {}

PairGranularTalus::~PairGranularTalus()
{
  if (!copymode) leave_system();
}

/* Also those that no pair of types uses any more: the stock style counts their values as well. */

std::vector<const Model *> PairGranularTalus::all_models() const
{
  return {models_list, models_list + nmodels};
}

std::string PairGranularTalus::reason_of_models() const
{
  const std::string lists = system->neighbors().reason_for_lammps_lists();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      if (!setflag[i][j]) continue;
      const std::string reason = reason_of_model(model_of(i, j));
      if (!reason.empty()) return reason;
      if (model_of(i, j).beyond_contact && !lists.empty())
        return "contacts last longer than pairs are in the neighbor lists of LAMMPS: " + lists;
    }
  if (conducts_heat() && !(atom->temperature_flag && atom->heatflow_flag))
    return "particles have no temperature";    // the stock style says how to have one
  return stock_history_of(all_models()) ? "" : "the models keep their histories in different ways";
}

bool PairGranularTalus::conducts_heat() const
{
  const std::vector<const Model *> models = all_models();
  return std::any_of(models.begin(), models.end(), [](const Model *model) {
    return model->sub_models[Granular_NS::HEAT]->name != "none";
  });
}

std::string PairGranularTalus::stock_history() const
{
  const std::optional<std::vector<int>> places = stock_history_of(all_models());
  std::string words;
  for (const int place : places.value()) words += place < 0 ? " -" : " " + std::to_string(place);
  return words;
}

/* The others are set in init_one(), where the stock style mixes them. */

void PairGranularTalus::set_laws()
{
  PairCoeffs &laws = system->laws();
  laws.resize(atom->ntypes);
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++)
      if (setflag[i][j]) laws.set(i, j, spec_of_model(model_of(i, j)));
  if (!conducts_heat() || single_extra > stock_extra) return;
  single_extra = stock_extra + 1;    // and the heat flow
  delete[] svector;
  svector = new double[single_extra];
}

/* Synchronized laws know the time step. */

void PairGranularTalus::reset_dt()
{
  PairGranular::reset_dt();
  if (in_system()) set_laws();
}

/* The stock style may have a larger cutoff: a user's, or that of contacts that last beyond an
   overlap. For a type that has no particles yet it takes the largest radius of all types. */

double PairGranularTalus::init_pair_of_types(int i, int j)
{
  const LargestRadii &radii = system->range().radii();
  for (int type = 1; type <= atom->ntypes; type++) {
    maxrad_dynamic[type] = radii.of_free(type);
    maxrad_frozen[type] = radii.of_frozen(type);
  }
  const double stock = PairGranular::init_one(i, j);
  system->laws().set(i, j, spec_of_model(model_of(i, j)));
  return std::max(stock, system->range().cutoff(i, j));
}

/* ---------------------------------------------------------------------- */

/* Friction, rolling "force" (see the documentation of the stock style), their lengths, twisting
   torque, and separation. What is opposite on both particles is R_eff n x f_r + M_t n, and what
   lever arms that end in the middle of the overlap add to friction. */

void PairGranularTalus::report_single(const std::optional<SinglePair> &pair)
{
  std::fill(svector, svector + single_extra, 0.0);
  if (!pair) return;
  using Vector = Vector3<double>;
  const ContactLanes<double> &s = pair->contact;
  const Vector n = s.normal, fs = s.tangential;
  const Vector opposite = s.twisting_torque - s.arm_difference * cross(n, fs);
  const double twist = dot(opposite, n);
  const Vector fr = s.inverse_radius * cross(opposite - twist * n, n);
  const Vector dx = pair->distance * s.full_normal;
  const double all[] = {fs.x,  fs.y, fs.z, std::sqrt(dot(fs, fs)),
                        fr.x,  fr.y, fr.z, std::sqrt(dot(fr, fr)),
                        twist, dx.x, dx.y, dx.z};
  static_assert(std::size(all) == stock_extra);
  std::copy(std::begin(all), std::end(all), svector);
  if (single_extra > stock_extra) svector[stock_extra] = s.heat_flow;
}

#if TALUS_HOST_HAS_ATOM2CUT
double PairGranularTalus::atom2cut(int i)
{
  return radii2cut(atom->radius[i], atom->radius[i]);
}

double PairGranularTalus::radii2cut(double r1, double r2)
{
  return in_system() ? r1 + r2 + system->range().largest_pulloff_distance()
                     : PairGranular::radii2cut(r1, r2);
}
#endif

/* Fix GRANULAR/MDR looks for the pair style by its name without a suffix. */

void PairGranularTalus::become_stock()
{
  if (force->pair != this) return;
  delete[] force->pair_style;
  force->pair_style = utils::strdup(plain_style());
}
