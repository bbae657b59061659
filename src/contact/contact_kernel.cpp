// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/contact_kernel.h"

#include "contact/model_dispatch.h"

namespace Talus {
namespace {

using Lanes = double[3][ContactBatch::width];

inline Vector3<Vec8> load_lanes(const Lanes &v, int k)
{
  return {load8(&v[0][k]), load8(&v[1][k]), load8(&v[2][k])};
}

inline void store_lanes(Lanes &v, int k, const Vector3<Vec8> &value)
{
  store(&v[0][k], value.x);
  store(&v[1][k], value.y);
  store(&v[2][k], value.z);
}

// Coefficients<Real> is a row of Reals: the same numbers, one or eight contacts wide
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

Coefficients<Vec8> spread(const ContactCoefficients &c)
{
  const int same[lanes] = {};
  return collect(&c, same);
}

template <class Model> TALUS_INLINE ContactState<Vec8> load_state(const ContactBatch &b, int k)
{
  ContactState<Vec8> s{};
  s.normal = load_lanes(b.normal, k);
  s.overlap = load8(&b.overlap[k]);
  s.velocity = load_lanes(b.velocity, k);
  s.inverse_mass = load8(&b.inverse_mass[k]);
  if constexpr (Model::needs_radius) s.inverse_radius = load8(&b.inverse_radius[k]);
  if constexpr (Model::rotates) s.spin = load_lanes(b.spin, k);
  if constexpr (Model::midpoint) s.inverse_distance = load8(&b.inverse_distance[k]);
  if constexpr (Model::resists) {
    s.relative_spin = load_lanes(b.relative_spin, k);
    s.circle = load8(&b.circle[k]);
  }
  return s;
}

template <class Model, bool uniform, bool advance>
void compute_batch(ContactBatch &b, int begin, int end, const ContactCoefficients *table, double dt)
{
  const Coefficients<Vec8> common = spread(table[0]);
  for (int k = begin; k < end; k += lanes) {
    TangentialHistory<Vec8> history;
    ContactOnset<Vec8> onset;
    if constexpr (Model::history) history = {load_lanes(b.displacement, k), load8(&b.at_limit[k])};
    if constexpr (Model::onset)
      onset = {load8(&b.onset[0][k]), load8(&b.onset[1][k]), load8(&b.onset[2][k])};

    const auto out =
        evaluate_contact<Model, advance>(uniform ? common : collect(table, &b.coefficients[k]),
                                         load_state<Model>(b, k), dt, history, onset);

    store_lanes(b.force, k, out.force);
    if constexpr (Model::rotates) store_lanes(b.moment, k, out.moment);
    if constexpr (Model::resists) store_lanes(b.couple, k, out.couple);
    if constexpr (Model::history && advance) {
      store_lanes(b.displacement, k, history.displacement);
      store(&b.at_limit[k], history.at_limit);
    }
    if constexpr (Model::onset && advance)
      store_lanes(b.onset, k, {onset.speed, onset.age, onset.begun});
  }
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
                                    const ContactOnset<double> &onset)
{
  TangentialHistory<double> history_copy = history;
  ContactOnset<double> onset_copy = onset;
  return dispatch_model(law, [&](auto model) {
    return evaluate_contact<decltype(model), false>(coefficients, state, dt, history_copy,
                                                    onset_copy);
  });
}

}    // namespace Talus
