// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How to write a law: a struct derived from the one of its stage in law_base.h, which has
//
//   name          word of scripts and restart files
//   label         in descriptions of whole laws; the name if it is not hidden by another one
//   Row<Real>     its coefficients, all of type Real
//   coefficients  their names
//   compute<advance>(c, s, history, dt)
//                 its equation: reads and writes s (see contact_lanes.h) and, if it has a history,
//                 history[0 ... odd_history + even_history - 1], which it updates only if `advance`
//                 (history_update of LAMMPS). Pure and free of branches. dt in units of the caller.
//   read(reader)  its words; left out if it comes with another law's
//   mix(m)        its row for a contact of two materials
//   stored(s, c, history)   its energy, if it stores some
//
// and whatever else of that struct is not as it says there. The line &law<ThatStruct> in
// list.cpp of the folder makes it known to all.

#ifndef TALUS_LAWS_LAW_DEFINITION_H
#define TALUS_LAWS_LAW_DEFINITION_H

#include "base/power.h"
#include "laws/batch_lanes.h"
#include "laws/law_base.h"

#include <cstddef>
#include <iterator>
#include <utility>

namespace Talus {

template <class L> inline constexpr int num_coefficients_of()
{
  return L::coefficients[0].name ? static_cast<int>(std::size(L::coefficients)) : 0;
}

template <class L> using CoefficientPlaces = std::make_index_sequence<num_coefficients_of<L>()>;

/// A row from its coefficients: all(n) for n = 0, 1, ...
template <class L, class Real, class All, std::size_t... n>
TALUS_INLINE typename L::template Row<Real> row_from(const All &all, std::index_sequence<n...>)
{
  return {all(n)...};
}

/// The same coefficients in every lane.
template <class L, class Real> TALUS_INLINE typename L::template Row<Real> spread(const double *c)
{
  return row_from<L, Real>([c](std::size_t n) { return splat<Real>(c[n]); },
                           CoefficientPlaces<L>{});
}

template <class L>
typename L::template Row<Vec8> collect(const StageInput &in, const int *row_of_lane)
{
  return row_from<L, Vec8>(
      [&](std::size_t n) {
        Vec8 c{};
        for (int k = 0; k < lanes; k++) c[k] = in.table[row_of_lane[k]].c[in.first_coefficient + n];
        return c;
      },
      CoefficientPlaces<L>{});
}

template <class L> inline constexpr int history_size_of = L::odd_history + L::even_history;

/// The equation of a law. Of one of second order, with `ends` false, without the terms for begin
/// and end of a contact; see SecondOrder::at_event().
template <class L, bool advance, bool ends, class Real>
TALUS_INLINE void compute_law(const typename L::template Row<Real> &c, ContactLanes<Real> &s,
                              Real *history, double dt)
{
  if constexpr (L::second_order)
    L::template compute<advance, ends>(c, s, history, dt);
  else
    L::template compute<advance>(c, s, history, dt);
}

/// Whether contacts with a law of second order begin or end among those from lane k on.
/// `history_index`: of the values of the law.
template <class L, class Real>
TALUS_INLINE bool any_at_event(ContactBatch &b, int k, const HistoryIndices &history_index)
{
  return any(L::at_event(Memory<Real>::load(&b.separated[k]),
                         Memory<Real>::load(&b.history[history_index[L::first_even]][k])));
}

template <class L, bool advance, bool ends>
TALUS_INLINE void run_lanes(ContactBatch &b, int k, const typename L::template Row<Vec8> &c,
                            const StageInput &in)
{
  constexpr int history_size = history_size_of<L>;
  ContactLanes<Vec8> s;
  load_state(b, k, s);
  load_found<L::stage>(b, k, s);
  Vec8 history[history_size + 1];    // none has no length 0
  for (int n = 0; n < history_size; n++) history[n] = load8(&b.history[in.history_index[n]][k]);
  compute_law<L, advance, ends>(c, s, history, in.dt);
  store_found<L::stage>(b, k, s);
  if constexpr (L::second_order) {    // finds the normal force again
    visit_normal_force(s, b, [k](Vec8 value, double *to) { store(to + k, value); });
    store(&b.between.adhesive_share[k], s.adhesive_share);
    if constexpr (ends) store(&b.between.uncorrected_force[k], s.uncorrected_force);
  }
  if constexpr (L::stage == Stage::COHESION && L::lasts_beyond_contact)
    store_vector(b.torque_per_radius, k, s.torque_per_radius);
  if constexpr (advance)
    for (int n = 0; n < history_size; n++) store(&b.history[in.history_index[n]][k], history[n]);
}

template <class L, bool advance>
void run_stage(ContactBatch &b, int begin, int end, const StageInput &in)
{
  auto c = spread<L, Vec8>(in.table[0].c + in.first_coefficient);
  for (int k = begin; k < end; k += lanes) {
    if (!in.uniform) c = collect<L>(in, &b.coefficients[k]);
    if constexpr (L::second_order && advance)
      if (!any_at_event<L, Vec8>(b, k, in.history_index)) {
        run_lanes<L, advance, false>(b, k, c, in);
        continue;
      }
    run_lanes<L, advance, true>(b, k, c, in);
  }
}

/// 1 if resistance acts, 0 before the contact has lasted one collision time
/// pi sqrt(m/(k (1-d^2))), d = g/(2 m sqrt(k/m)); over-damped contacts (d >= 1) resist at once.
template <class L, class Real> TALUS_INLINE void find_delayed_force(ContactLanes<Real> &s)
{
  const Real one = splat<Real>(1.0), zero = splat<Real>(0.0),
             pi = splat<Real>(3.14159265358979323846);
  Real k = s.kn, g = s.gn;
  L::reduce(s.overlap, k, g);
  const Real damping = g / (2.0 * s.mass * square_root(k / s.mass));
  const Real duration = pi * square_root(s.mass / (k * (one - damping * damping)));
  s.delayed_force = s.normal_force * select((damping < one) & (s.age <= duration), zero, one);
}

template <class L> void run_delay(ContactBatch &b, int begin, int end, const StageInput & /*in*/)
{
  for (int k = begin; k < end; k += lanes) {
    ContactLanes<Vec8> s;
    load_state(b, k, s);
    load_found<Stage::TANGENTIAL>(b, k, s);
    find_delayed_force<L>(s);
    store(&b.between.delayed_force[k], s.delayed_force);
  }
}

template <class L> typename L::template Row<double> row_of(const double *c)
{
  return row_from<L, double>([c](std::size_t n) { return c[n]; }, CoefficientPlaces<L>{});
}

template <class L>
void compute_one(ContactLanes<double> &s, const double *c, double *history, double dt)
{
  L::template compute<false>(row_of<L>(c), s, history, dt);
}

template <class L> void mix_row(const Mixing &materials, double *c)
{
  const typename L::template Row<double> row = L::mix(materials);
  const auto *numbers = reinterpret_cast<const double *>(&row);
  for (int n = 0; n < num_coefficients_of<L>(); n++) c[n] = numbers[n];
}

template <class L>
double stored_energy(const ContactLanes<double> &s, const double *c, const double *history)
{
  return L::stored(s, row_of<L>(c), history);
}

template <class L> double pulloff_cube_by(const double *c, const ContactSize<double> &size)
{
  return L::pulloff_cube(row_of<L>(c), size);
}

template <class L>
void pulloff_cubes_by(const double *c, const ContactSize<Vec8> &size, Vec8 &cubes)
{
  cubes = L::pulloff_cube(spread<L, Vec8>(c), size);
}

/// Of normal laws, which ask for the radius alone. Few bodies are apart.
template <class L>
void run_pulloff_distance(ContactBatch &b, int begin, int end, const StageInput &in)
{
  for (int k = begin; k < end; k++) {
    if (b.overlap[k] > 0.0) continue;
    const double *c = in.table[in.uniform ? 0 : b.coefficients[k]].c + in.first_coefficient;
    b.pulloff_distance[k] = cube_root(pulloff_cube_by<L>(c, {1.0 / b.inverse_radius[k], 0.0}));
  }
}

template <class L> constexpr Law make_law()
{
  constexpr int n = num_coefficients_of<L>();
  static_assert(n == 0 || sizeof(typename L::template Row<double>) == n * sizeof(double),
                "as many names as coefficients");
  constexpr bool has_history = history_size_of<L> != 0;
  Law law{};
  law.stage = L::stage;
  law.name = L::name;
  law.label = L::label;
  law.coefficients = L::coefficients;
  law.num_coefficients = n;
  law.odd_history = L::odd_history;
  law.even_history = L::even_history;
  law.acts = L::acts;
  law.needs_radius = L::needs_radius;
  law.reads_impact = L::reads_impact;
  law.reads_stiffness = L::reads_stiffness;
  law.has_spring = L::has_spring;
  law.stiffens = L::stiffens;
  law.is_midpoint = L::is_midpoint;
  law.synchronized = L::synchronized;
  law.holds = L::holds;
  law.delayed = L::delayed;
  law.exponent = L::exponent;
  law.lever_arms = L::lever_arms;
  law.cohesive = L::cohesive;
  law.allows_cohesion = L::allows_cohesion;
  law.lasts_beyond_contact = L::lasts_beyond_contact;
  law.hysteretic = L::hysteretic;
  law.reads_sums_alone = L::reads_sums_alone;
  law.shares_liquid = L::shares_liquid;
  law.second_order = L::second_order;
  law.like_stock = L::like_stock;
  law.order_2 = L::order_2;
  law.takes_no_kt = L::takes_no_kt;
  law.takes_no_gt = L::takes_no_gt;
  law.needs_gt = L::needs_gt;
  law.reading = run_stage<L, false>;
  law.advancing = run_stage<L, has_history>;
  law.one = compute_one<L>;
  law.read = L::read;
  law.mix = mix_row<L>;
  law.stored = stored_energy<L>;
  if constexpr (L::stage == Stage::DAMPING) {
    law.read_coefficient = L::read_coefficient;
    law.damping_exponent = L::damping_exponent;
    law.dashpot_exponent = L::dashpot_exponent;
  }
  if constexpr (L::lasts_beyond_contact) {
    law.pulloff_cube = pulloff_cube_by<L>;
    law.pulloff_cubes = pulloff_cubes_by<L>;
  }
  if constexpr (L::stage == Stage::NORMAL) {
    law.damping = L::damping;
    if constexpr (L::lasts_beyond_contact) law.find_pulloff_distance = run_pulloff_distance<L>;
    law.delay = run_delay<L>;
    law.one_delay = [](ContactLanes<double> &s, const double *, double *, double) {
      find_delayed_force<L>(s);
    };
    law.modulus = [](const double *c) { return L::modulus(row_of<L>(c)); };
  }
  return law;
}

template <class L> inline constexpr Law law = make_law<L>();

}    // namespace Talus

#endif
