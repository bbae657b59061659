// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/contact_kernel.h"

#include "laws/contact_work.h"
#include "laws/end_of_touch.h"
#include "laws/fused_kernels.h"
#include "laws/law_definition.h"
#include "laws/law_list.h"
#include "laws/tangential/end_of_contact.h"

#include <algorithm>

namespace Talus {
namespace {

/// Replaces the normal at the time of the positions by that of half a step before, and keeps the
/// former.
void go_half_way_back(ContactBatch &b, int begin, int end, const StageInput &in)
{
  for (int k = begin; k < end; k += lanes) {
    Vec8 dt = splat<Vec8>(in.table[0].c[in.first_coefficient]);
    for (int q = 0; q < lanes && !in.uniform; q++)
      dt[q] = in.table[b.coefficients[k + q]].c[in.first_coefficient];
    ContactLanes<Vec8> s;
    load_state(b, k, s);
    store_vector(b.between.full_normal, k, s.normal);
    store_vector(b.normal, k, normal_half_way(s, dt));
  }
}

void return_to_full_step(ContactBatch &b, int begin, int end, const StageInput & /*in*/)
{
  for (int k = begin; k < end; k += lanes)
    store_vector(b.normal, k, load_vector<Vec8>(b.between.full_normal, k));
}

/// Few contacts have ended. `beyond`: some last beyond zero overlap.
template <bool beyond>
void find_last_overlap(ContactBatch &b, int begin, int end, const StageInput &in)
{
  for (int k = begin; k < end; k += lanes) {
    store(&b.separated[k], splat<Vec8>(0.0));
    if (!any(load8(&b.overlap[k]) <= splat<Vec8>(0.0))) continue;
    ContactState<Vec8> s;
    s.overlap = load8(&b.overlap[k]);
    s.normal = load_vector<Vec8>(b.normal, k);
    s.velocity = load_vector<Vec8>(b.velocity, k);
    s.inverse_distance = load8(&b.inverse_distance[k]);
    s.pulloff_distance = splat<Vec8>(0.0);
    if constexpr (beyond)
      s.pulloff_distance = load8(&b.pulloff_distance[k]);
    else
      store(&b.pulloff_distance[k], s.pulloff_distance);
    last_overlap(s, in.dt);
    store(&b.overlap[k], s.overlap);
    store(&b.separated[k], s.separated);
  }
}

template <bool with_radius, bool impact, bool advance, bool second_order = false>
void run_approach(ContactBatch &b, int begin, int end, const StageInput &in)
{
  for (int k = begin; k < end; k += lanes) {
    ContactLanes<Vec8> s;
    load_state(b, k, s);
    approach<with_radius>(s);
    if constexpr (impact) {
      double *const at[3] = {&b.history[in.history_index[0]][k], &b.history[in.history_index[1]][k],
                             &b.history[in.history_index[2]][k]};
      ContactImpact<Vec8> contact_impact{load8(at[0]), load8(at[1]), load8(at[2])};
      const Vec8 separated = second_order ? s.separated : splat<Vec8>(0.0);
      follow_impact<advance>(contact_impact, speed_at_begin<second_order>(s, in.dt), separated,
                             in.dt);
      s.impact_speed = contact_impact.speed;
      s.age = contact_impact.age;
      if constexpr (advance) {
        store(at[0], contact_impact.speed);
        store(at[1], contact_impact.age);
        store(at[2], contact_impact.begun);
      }
    }
    visit_approach(s, b, [k](Vec8 value, double *to) { store(to + k, value); });
  }
}

template <bool with_radius, bool second_order> StageFunction impact_function(bool advance)
{
  return advance ? run_approach<with_radius, true, true, second_order>
                 : run_approach<with_radius, true, false, second_order>;
}

template <bool with_radius> StageFunction approach_function(const ContactLaw &law, bool advance)
{
  if (!law.history().keeps_impact) return run_approach<with_radius, false, false>;
  return law.tangential().second_order ? impact_function<with_radius, true>(advance)
                                       : impact_function<with_radius, false>(advance);
}

/// The stages that a law has, in their order: visit(stage, law of the stage).
template <class Visit> void for_each_stage(const ContactLaw &law, Visit visit)
{
  for (Stage stage : {Stage::NORMAL, Stage::DAMPING, Stage::TANGENTIAL, Stage::ROLLING,
                      Stage::TWISTING, Stage::COHESION, Stage::HEAT}) {
    const bool turns = stage == Stage::TANGENTIAL && law.has_friction();
    if (law[stage].acts || turns) visit(stage, law[stage]);
  }
}

/// The law resists by Chrono's rule: to be found before the first stage that asks.
bool needs_delay(const ContactLaw &law, Stage stage)
{
  return law.delayed() && stage == (law.rolling().acts ? Stage::ROLLING : Stage::TWISTING);
}

}    // namespace

bool ContactKernel::operator==(const ContactKernel &other) const
{
  return uniform == other.uniform && count == other.count &&
         std::equal(steps.begin(), steps.begin() + count, other.steps.begin(),
                    [](const Step &a, const Step &b) {
                      return a.run == b.run && a.first_coefficient == b.first_coefficient &&
                             a.history_index == b.history_index;
                    });
}

void ContactKernel::add_end_of_contact(const ContactLaw &law)
{
  if (!law.tangential().second_order) return;
  if (!law.normal().lasts_beyond_contact) return add(find_last_overlap<false>);
  add(law.normal().find_pulloff_distance, law.first_coefficient(Stage::NORMAL));
  add(find_last_overlap<true>);
}

/// Of the history values those of laws that end with the touch, then -1. What the law of cohesion itself remembers
/// stays; heat has no history.
static HistoryIndices ending_with_touch(const ContactLaw &law)
{
  const HistoryLayout layout = law.history();
  const HistoryIndices &kept = layout.of_stage[static_cast<int>(Stage::COHESION)];
  const int *const end = kept.data() + law.cohesion().odd_history + law.cohesion().even_history;
  HistoryIndices ending;
  ending.fill(-1);
  int count = 0;
  for (int n = 0; n < layout.size; n++)
    if (std::find(kept.data(), end, n) == end) ending[count++] = n;
  return ending;
}

template <ReadBehindTouch read>
void ContactKernel::add_end_of_touch(const ContactLaw &law, bool advance)
{
  const StageFunction ends = advance ? end_touch<true, false, read> : end_touch<false, false, read>,
                      twisting_ends =
                          advance ? end_touch<true, true, read> : end_touch<false, true, read>;
  add(law.twists() ? twisting_ends : ends, 0, ending_with_touch(law));
}

ContactKernel staged_kernel(const ContactLaw &law, bool uniform, bool advance)
{
  const HistoryLayout layout = law.history();
  ContactKernel kernel;
  kernel.uniform = uniform;
  if (law.synchronized()) kernel.add(go_half_way_back, law.place_of_time_step());
  kernel.add_end_of_contact(law);
  kernel.add(law.needs_radius() ? approach_function<true>(law, advance)
                                : approach_function<false>(law, advance),
             0, layout.impact);
  for_each_stage(law, [&](Stage stage, const Law &stage_law) {
    if (needs_delay(law, stage)) kernel.add(law.normal().delay);
    if (law.acts_apart_from(stage)) kernel.add_end_of_touch<ReadBehindTouch::ALL>(law, advance);
    kernel.add(advance ? stage_law.advancing : stage_law.reading, law.first_coefficient(stage),
               layout.of_stage[static_cast<int>(stage)]);
  });
  if (law.synchronized()) kernel.add(return_to_full_step);
  return kernel;
}

/// Of tangential, rolling and twisting laws.
static HistoryIndices consecutive_history_indices(const ContactLaw &law)
{
  const HistoryLayout layout = law.history();
  HistoryIndices history_index{};
  int next = 0;
  for (const Stage stage : {Stage::TANGENTIAL, Stage::ROLLING, Stage::TWISTING})
    for (int n = 0; n < law[stage].odd_history + law[stage].even_history; n++)
      history_index[next++] = layout.of_stage[static_cast<int>(stage)][n];
  return history_index;
}

/// The law without the stage that may follow a function for all others, if it has one: heat, behind a normal law that
/// finds the circle again, or cohesion that reads nothing of other stages but their sums. Effective masses are rounded as
/// approach() finds them, with the radius or without: the same for all stages.
static ContactLaw before_last_stage(const ContactLaw &law)
{
  const auto without = [&law](Stage stage) {
    ContactLaw rest = law;
    rest.choose(stage, laws_of(stage).front());
    const bool alike = !law.tangential().second_order && rest.needs_radius() == law.needs_radius();
    return alike && rest.has_friction() ? rest : law;
  };
  const bool remembers = law.normal().odd_history + law.normal().even_history > 0;
  if (law.conducts_heat()) return remembers ? law : without(Stage::HEAT);
  return law.cohesion().reads_sums_alone ? without(Stage::COHESION) : law;
}

ContactKernel contact_kernel(const ContactLaw &law, bool uniform, bool advance)
{
  const ContactLaw before = before_last_stage(law);
  const StageFunction fused =
      uniform && (advance || !law.has_history()) ? fused_function(before) : nullptr;
  if (!fused) return staged_kernel(law, uniform, advance);
  ContactKernel kernel;
  kernel.uniform = true;
  kernel.add_end_of_contact(law);
  kernel.add(fused, 0, consecutive_history_indices(law));
  if (before == law) return kernel;
  kernel.add(run_approach<true, false, false>);    // fused functions leave nothing of it
  const Stage last = law.conducts_heat() ? Stage::HEAT : Stage::COHESION;
  if (last == Stage::HEAT) {
    kernel.add(law.normal().reading, law.first_coefficient(Stage::NORMAL));
    if (law.reaches()) kernel.add_end_of_touch<ReadBehindTouch::CIRCLE>(law, advance);
  } else {
    kernel.add_end_of_touch<ReadBehindTouch::NOTHING>(law, advance);
  }
  kernel.add(law[last].advancing, law.first_coefficient(last),
             law.history().of_stage[static_cast<int>(last)]);
  return kernel;
}

ContactKernel accounting_kernel(const ContactLaw &law, bool uniform, bool advance)
{
  ContactKernel kernel;
  kernel.uniform = uniform;
  if (const StageFunction fused = uniform && advance ? fused_accounting_function(law) : nullptr) {
    kernel.add_end_of_contact(law);
    kernel.add(fused, 0, consecutive_history_indices(law));
    return kernel;
  }
  kernel.add(staged_kernel(law, uniform, advance));
  kernel.add(work_finder(law));
  return kernel;
}

ContactLanes<double> single_contact(const ContactLaw &law, const ContactCoefficients &coefficients,
                                    const ContactState<double> &state, double dt,
                                    const HistoryValues &history, Stage last)
{
  ContactLanes<double> s;
  static_cast<ContactState<double> &>(s) = state;
  s.full_normal = s.normal;
  if (law.synchronized()) s.normal = normal_half_way(s, coefficients.c[law.place_of_time_step()]);
  if (law.tangential().second_order) {
    if (s.overlap <= 0.0)
      s.pulloff_distance = pulloff_distance_of(law, coefficients, 1.0 / s.inverse_radius);
    last_overlap(s, dt);
  }
  if (law.needs_radius())
    approach<true>(s);
  else
    approach<false>(s);
  const HistoryLayout layout = law.history();
  const double *const kept = history.data();
  if (layout.keeps_impact) {
    const HistoryIndices &at = layout.impact;
    ContactImpact<double> impact{kept[at[0]], kept[at[1]], kept[at[2]]};
    const double speed =
        law.tangential().second_order ? speed_at_begin<true>(s, dt) : speed_at_begin<false>(s, dt);
    follow_impact<false>(impact, speed, s.separated, dt);
    s.impact_speed = impact.speed;
    s.age = impact.age;
  }
  for_each_stage(law, [&](Stage stage, const Law &stage_law) {
    if (stage > last) return;
    if (law.acts_apart_from(stage)) end_touch(s);
    if (needs_delay(law, stage)) law.normal().one_delay(s, nullptr, nullptr, dt);
    double values[ContactBatch::history_size] = {};
    for (int n = 0; n < stage_law.odd_history + stage_law.even_history; n++)
      values[n] = kept[layout.of_stage[static_cast<int>(stage)][n]];
    stage_law.one(s, law.coefficients(stage, coefficients), values, dt);
  });
  for (const Stage stage : {Stage::COHESION, Stage::HEAT})
    if (last < stage && law.acts_apart_from(stage)) end_touch(s);
  return s;
}

}    // namespace Talus
