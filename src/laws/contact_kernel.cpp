// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/contact_kernel.h"

#include "laws/model_dispatch.h"

namespace Talus {
namespace {

using Lanes = double[3][ContactBatch::width];

// A contact is a long chain of operations that wait for each other, too long for a processor to
// look beyond it to the next one. So kernels compute two vectors of the machine at a time.
#if defined(__AVX512F__)
using Wide = Twice<Vec8>;
#else
using Wide = Vec8;
#endif
constexpr int wide_lanes = sizeof(Wide) / sizeof(double);

template <class Real> inline Vector3<Real> load_lanes(const Lanes &v, int k)
{
  using In = Memory<Real>;
  return {In::load(&v[0][k]), In::load(&v[1][k]), In::load(&v[2][k])};
}

template <class Real> inline void store_lanes(Lanes &v, int k, const Vector3<Real> &value)
{
  Memory<Real>::store(&v[0][k], value.x);
  Memory<Real>::store(&v[1][k], value.y);
  Memory<Real>::store(&v[2][k], value.z);
}

// Coefficients<Real> is a row of Reals: the same numbers, one or several contacts wide
constexpr int num_coefficients = sizeof(ContactCoefficients) / sizeof(double);
static_assert(sizeof(Coefficients<Vec8>) == num_coefficients * sizeof(Vec8));

Coefficients<Vec8> collect(const ContactCoefficients *table, const int *row)
{
  Coefficients<Vec8> c;
  auto *wide = reinterpret_cast<double *>(&c);
  for (int lane = 0; lane < lanes; lane++) {
    const auto *one = reinterpret_cast<const double *>(&table[row[lane]]);
    for (int n = 0; n < num_coefficients; n++) wide[n * lanes + lane] = one[n];
  }
  return c;
}

/// The same coefficients in every lane. What a model does not use costs nothing.
template <class Real> TALUS_INLINE Coefficients<Real> spread(const ContactCoefficients &c)
{
  const auto all = splat<Real>;
  return {all(c.kn),       all(c.gn),          all(c.kt),           all(c.gt),
          all(c.mu),       all(c.force_floor), all(c.speed),        all(c.mu_roll),
          all(c.mu_twist), all(c.adhesion),    all(c.adhesion_dmt), all(c.adhesion_perko),
          all(c.slip_min), all(c.roll_min),    all(c.twist_min)};
}

template <class Model, class Real>
TALUS_INLINE ContactState<Real> load_state(const ContactBatch &b, int k)
{
  using In = Memory<Real>;
  ContactState<Real> s{};
  s.normal = load_lanes<Real>(b.normal, k);
  s.overlap = In::load(&b.overlap[k]);
  s.velocity = load_lanes<Real>(b.velocity, k);
  s.inverse_mass = In::load(&b.inverse_mass[k]);
  if constexpr (Model::needs_radius) s.inverse_radius = In::load(&b.inverse_radius[k]);
  if constexpr (Model::rotates) s.spin = load_lanes<Real>(b.spin, k);
  if constexpr (Model::midpoint) s.inverse_distance = In::load(&b.inverse_distance[k]);
  if constexpr (Model::resists) {
    s.relative_omega = load_lanes<Real>(b.relative_omega, k);
    s.circle = In::load(&b.circle[k]);
  }
  return s;
}

/// The contacts from lane k on, as many as a Real is wide.
template <class Model, bool advance, class Real>
TALUS_INLINE void compute_lanes(ContactBatch &b, int k, const Coefficients<Real> &c, double dt)
{
  using InOut = Memory<Real>;
  TangentialHistory<Real> history;
  ContactImpact<Real> impact;
  if constexpr (Model::history)
    history = {load_lanes<Real>(b.displacement, k), InOut::load(&b.sliding[k])};
  if constexpr (Model::impact)
    impact = {InOut::load(&b.impact[0][k]), InOut::load(&b.impact[1][k]),
              InOut::load(&b.impact[2][k])};

  const auto out =
      evaluate_contact<Model, advance>(c, load_state<Model, Real>(b, k), dt, history, impact);

  store_lanes(b.force, k, out.force);
  if constexpr (Model::rotates) store_lanes(b.moment, k, out.moment);
  if constexpr (Model::resists) store_lanes(b.couple, k, out.couple);
  if constexpr (Model::history && advance) {
    store_lanes(b.displacement, k, history.displacement);
    InOut::store(&b.sliding[k], history.sliding);
  }
  if constexpr (Model::impact && advance)
    store_lanes<Real>(b.impact, k, {impact.speed, impact.age, impact.begun});
}

template <class Model, bool uniform, bool advance>
void compute_batch(ContactBatch &b, int begin, int end, const ContactCoefficients *table, double dt)
{
  int k = begin;
  if constexpr (uniform) {
    const Coefficients<Wide> common = spread<Wide>(table[0]);
    for (; k + wide_lanes <= end; k += wide_lanes)
      compute_lanes<Model, advance, Wide>(b, k, common, dt);
  }
  const Coefficients<Vec8> common = spread<Vec8>(table[0]);
  for (; k < end; k += lanes)
    compute_lanes<Model, advance, Vec8>(b, k, uniform ? common : collect(table, &b.coefficients[k]),
                                        dt);
}

template <class Model> ContactKernel pick(bool uniform, bool advance)
{
  constexpr bool live = Model::history;    // without history both kinds of step are the same
  if (uniform)
    return advance && live ? compute_batch<Model, true, live> : compute_batch<Model, true, false>;
  return advance && live ? compute_batch<Model, false, live> : compute_batch<Model, false, false>;
}

}    // namespace

ContactKernel contact_kernel(ContactLaw law, bool uniform, bool advance)
{
  return dispatch_model(law, [=](auto model) { return pick<decltype(model)>(uniform, advance); });
}

ContactForce<double> single_contact(ContactLaw law, const ContactCoefficients &coefficients,
                                    const ContactState<double> &state, double dt,
                                    const TangentialHistory<double> &history,
                                    const ContactImpact<double> &impact)
{
  TangentialHistory<double> history_copy = history;
  ContactImpact<double> impact_copy = impact;
  return dispatch_model(law, [&](auto model) {
    return evaluate_contact<decltype(model), false>(coefficients, state, dt, history_copy,
                                                    impact_copy);
  });
}

}    // namespace Talus
