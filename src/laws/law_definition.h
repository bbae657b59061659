// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How to write a law: a struct derived from the one of its stage below, which has
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
// and whatever else of the struct below is not as it says there. The line &law<ThatStruct> in
// list.cpp of the folder makes it known to all.

#ifndef TALUS_LAWS_LAW_DEFINITION_H
#define TALUS_LAWS_LAW_DEFINITION_H

#include "base/simd.h"
#include "laws/given_law.h"
#include "laws/law.h"

#include <cstddef>
#include <utility>

namespace Talus {

struct LawBase {
  template <class Real> struct Row {
  };
  static constexpr CoefficientName coefficients[] = {{nullptr}};    // none
  static Row<double> mix(const Mixing & /*m*/) { return {}; }
  static constexpr std::nullptr_t read = nullptr;
  template <class AnyRow>
  static double stored(const ContactLanes<double> & /*s*/, const AnyRow & /*c*/,
                       const double * /*history*/)
  {
    return 0.0;
  }

  static constexpr bool acts = true, needs_radius = false, reads_impact = false;
  static constexpr bool reads_stiffness = false, has_spring = false, stiffens = false;
  static constexpr bool is_midpoint = false, synchronized = false;
  static constexpr bool holds = false, delayed = false, like_stock = false;
  static constexpr bool lever_arms = false, cohesive = false, allows_cohesion = true;
  static constexpr bool lasts_beyond_contact = false, second_order = false, hysteretic = false;
  static constexpr const char *takes_no_kt = nullptr, *takes_no_gt = nullptr, *needs_gt = nullptr;
  static constexpr int odd_history = 0, even_history = 0;
  /// Tangential, rolling, twisting: what integrators of second order take in its place, nullptr if there
  /// is nothing; `adhesive`: the normal law has adhesion of its own. See second_order_laws.h.
  static constexpr std::nullptr_t order_2 = nullptr;
  static constexpr double exponent = 1.0;
  /// Normal, cohesion and heat: how far a contact lasts beyond zero overlap (length), in proportion to the
  /// radius of heat; only called if lasts_beyond_contact.
  template <class Row>
  static double pulloff_distance(const Row & /*c*/, const ContactSize & /*size*/)
  {
    return 0.0;
  }
};

/// Finds kn, kt, tangent_n, tangent_t, contact_radius, elastic; with adhesion of its own
/// pulloff_force.
struct NormalLaw : LawBase {
  static constexpr Stage stage = Stage::NORMAL;
  static constexpr const char *damping = "mass_velocity";

  /// kn and gn without their dependence on the overlap, as Chrono's rule for the collision time of
  /// delayed resistance takes them.
  template <class Real> static void reduce(Real /*overlap*/, Real & /*k*/, Real & /*g*/) {}
  template <class Row> static double modulus(const Row & /*c*/) { return 0.0; }
};

/// Finds gn, gt, normal_force and force; see finish_normal_force().
struct DampingLaw : LawBase {
  static constexpr Stage stage = Stage::DAMPING;
  static constexpr const char *label = nullptr;    // descriptions name it if it was asked for

  static void read_coefficient(LawReader &r) { r.set_not_negative("gn"); }
  /// gn ~ overlap^p with an elastic force ~ overlap^elastic: p = 0, 1/4, 1/2, 1 or 3/2. Read by
  /// laws of second order.
  static double damping_exponent(double elastic) = delete;
  /// The same of gt, where it is another one; below 0 if not.
  static double dashpot_exponent(double /*elastic*/) { return -1.0; }
};

/// Finds tangential and torque_per_radius, and twisting_torque if it has lever_arms, and adds to
/// force.
struct TangentialLaw : LawBase {
  static constexpr Stage stage = Stage::TANGENTIAL;
};

/// Adds to torque_per_radius, or to twisting_torque.
struct RollingLaw : LawBase {
  static constexpr Stage stage = Stage::ROLLING;
};

/// Adds to twisting_torque.
struct TwistingLaw : LawBase {
  static constexpr Stage stage = Stage::TWISTING;
};

/// Adds to force: an adhesive force that is constant while the bodies touch, times adhesive_share. Or,
/// if lasts_beyond_contact, any force and torque_per_radius of bodies that touch or have touched:
/// overlap is below 0 where they are apart, and the stages before have then found nothing.
struct CohesionLaw : LawBase {
  static constexpr Stage stage = Stage::COHESION;
  static constexpr const char *label = "adhesion";
  static constexpr double exponent = 0.0;
  static constexpr bool needs_radius = true;
};

/// Finds heat_flow. If lasts_beyond_contact, also of bodies that are apart, whether they have touched or not: the
/// stages before have then found nothing.
struct HeatLaw : LawBase {
  static constexpr Stage stage = Stage::HEAT;
  static constexpr bool needs_radius = true;    // for the contact radius of the normal law
};

// ---- from a struct to a Law
// ----------------------------------------------------------------------

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

using LanesOfVector = double[3][ContactBatch::width];

template <class Real> TALUS_INLINE Vector3<Real> load_vector(const LanesOfVector &v, int k)
{
  using In = Memory<Real>;
  return {In::load(&v[0][k]), In::load(&v[1][k]), In::load(&v[2][k])};
}

template <class Real>
TALUS_INLINE void store_vector(LanesOfVector &v, int k, const Vector3<Real> &value)
{
  Memory<Real>::store(&v[0][k], value.x);
  Memory<Real>::store(&v[1][k], value.y);
  Memory<Real>::store(&v[2][k], value.z);
}

/// The state of the contacts from lane k on, as many as a Real is wide. What is not used afterwards
/// is not read: compilers see to that.
template <class Real>
TALUS_INLINE void load_state(const ContactBatch &b, int k, ContactLanes<Real> &s)
{
  using In = Memory<Real>;
  s.normal = load_vector<Real>(b.normal, k);
  s.overlap = In::load(&b.overlap[k]);
  s.velocity = load_vector<Real>(b.velocity, k);
  s.surface_rotation = load_vector<Real>(b.surface_rotation, k);
  s.inverse_mass = In::load(&b.inverse_mass[k]);
  s.inverse_radius = In::load(&b.inverse_radius[k]);
  s.relative_omega = load_vector<Real>(b.relative_omega, k);
  s.intersection_radius = In::load(&b.intersection_radius[k]);
  s.inverse_distance = In::load(&b.inverse_distance[k]);
  s.arm_loss = In::load(&b.arm_loss[k]);
  s.arm_difference = In::load(&b.arm_difference[k]);
  s.temperature_difference = In::load(&b.temperature_difference[k]);
  s.lag = splat<Real>(b.lag);
  s.velocity_change = load_vector<Real>(b.velocity_change, k);
  s.rotation_change = load_vector<Real>(b.rotation_change, k);
  s.omega_change = load_vector<Real>(b.omega_change, k);
  s.normal_change = load_vector<Real>(b.normal_change, k);
  s.separated = In::load(&b.separated[k]);
  s.pulloff_distance = In::load(&b.pulloff_distance[k]);
}

/// The numbers that stages leave for each other: visit(member of ContactLanes, array of the batch)
/// for those that the stage writes.
template <Stage stage, class Lanes, class Batch, class Visit>
TALUS_INLINE void visit_written(Lanes &s, Batch &b, Visit visit)
{
  if constexpr (stage == Stage::NORMAL) {
    visit(s.kn, b.between.kn);
    visit(s.kt, b.between.kt);
    visit(s.tangent_n, b.between.tangent_n);
    visit(s.tangent_t, b.between.tangent_t);
    visit(s.contact_radius, b.between.contact_radius);
    visit(s.elastic, b.between.elastic);
    visit(s.pulloff_force, b.between.pulloff_force);
  } else if constexpr (stage == Stage::DAMPING) {
    visit(s.gn, b.between.gn);
    visit(s.gt, b.between.gt);
    visit(s.normal_force, b.between.normal_force);
    visit(s.critical_force, b.between.critical_force);
  }
}

/// What tangential laws of second order compute again, of the normal law.
template <class Lanes, class Batch, class Visit>
TALUS_INLINE void visit_normal_force(Lanes &s, Batch &b, Visit visit)
{
  visit(s.elastic, b.between.elastic);
  visit(s.normal_force, b.between.normal_force);
  visit(s.critical_force, b.between.critical_force);
}

template <class Lanes, class Batch, class Visit>
TALUS_INLINE void visit_approach(Lanes &s, Batch &b, Visit visit)
{
  visit(s.normal_velocity, b.between.normal_velocity);
  visit(s.mass, b.between.mass);
  visit(s.radius, b.between.radius);
  visit(s.impact_speed, b.between.impact_speed);
  visit(s.age, b.between.age);
}

/// What the stages before `stage` have found.
template <Stage stage, class Real>
TALUS_INLINE void load_found(const ContactBatch &b, int k, ContactLanes<Real> &s)
{
  const auto load = [k](Real &value, const double *from) { value = Memory<Real>::load(from + k); };
  visit_approach(s, b, load);
  if (stage == Stage::NORMAL) return;
  visit_written<Stage::NORMAL>(s, b, load);
  if (stage == Stage::DAMPING) return;
  visit_written<Stage::DAMPING>(s, b, load);
  load(s.adhesive_share, b.between.adhesive_share);
  load(s.uncorrected_force, b.between.uncorrected_force);
  load(s.delayed_force, b.between.delayed_force);
  s.full_normal = load_vector<Real>(b.between.full_normal, k);
  s.force = load_vector<Real>(b.force, k);
  if (stage == Stage::TANGENTIAL) return;
  s.torque_per_radius = load_vector<Real>(b.torque_per_radius, k);
  s.twisting_torque = load_vector<Real>(b.twisting_torque, k);
}

template <Stage stage, class Real>
TALUS_INLINE void store_found(ContactBatch &b, int k, ContactLanes<Real> &s)
{
  visit_written<stage>(s, b, [k](Real value, double *to) { Memory<Real>::store(to + k, value); });
  if constexpr (stage == Stage::HEAT) Memory<Real>::store(&b.heat_flow[k], s.heat_flow);
  if constexpr (stage == Stage::DAMPING || stage == Stage::TANGENTIAL || stage == Stage::COHESION)
    store_vector(b.force, k, s.force);
  if constexpr (stage == Stage::TANGENTIAL || stage == Stage::ROLLING)
    store_vector(b.torque_per_radius, k, s.torque_per_radius);
  if constexpr (stage == Stage::TANGENTIAL || stage == Stage::ROLLING || stage == Stage::TWISTING)
    store_vector(b.twisting_torque, k, s.twisting_torque);
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

template <class L> double pulloff_distance_by(const double *c, const ContactSize &size)
{
  return L::pulloff_distance(row_of<L>(c), size);
}

/// Of normal laws, which ask for the radius alone. Few bodies are apart.
template <class L>
void run_pulloff_distance(ContactBatch &b, int begin, int end, const StageInput &in)
{
  for (int k = begin; k < end; k++) {
    if (b.overlap[k] > 0.0) continue;
    const double *c = in.table[in.uniform ? 0 : b.coefficients[k]].c + in.first_coefficient;
    b.pulloff_distance[k] = pulloff_distance_by<L>(c, {1.0 / b.inverse_radius[k], 0.0});
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
  if constexpr (L::lasts_beyond_contact) law.pulloff_distance = pulloff_distance_by<L>;
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
