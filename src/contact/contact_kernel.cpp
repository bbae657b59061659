// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/contact_kernel.h"

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

  Coefficients<Vec8> spread(const ContactCoefficients &c)
  {
    return {splat<Vec8>(c.kn), splat<Vec8>(c.gn), splat<Vec8>(c.kt),
            splat<Vec8>(c.gt), splat<Vec8>(c.mu), splat<Vec8>(c.force_floor)};
  }

  Coefficients<Vec8> collect(const ContactCoefficients *table, const int *row)
  {
    Coefficients<Vec8> c;
    for (int lane = 0; lane < lanes; lane++) {
      const ContactCoefficients &one = table[row[lane]];
      c.kn[lane] = one.kn;
      c.gn[lane] = one.gn;
      c.kt[lane] = one.kt;
      c.gt[lane] = one.gt;
      c.mu[lane] = one.mu;
      c.force_floor[lane] = one.force_floor;
    }
    return c;
  }

  template <class Normal, class Tangential, bool uniform, bool advance>
  void compute_batch(ContactBatch &b, int begin, int end, const ContactCoefficients *table, double dt)
  {
    const Coefficients<Vec8> common = spread(table[0]);
    for (int k = begin; k < end; k += lanes) {
      ContactState<Vec8> state{load_lanes(b.normal, k),    load8(&b.overlap[k]),
                               load_lanes(b.velocity, k),  Vector3<Vec8>{},
                               load8(&b.inverse_mass[k]),  Vec8{}};
      TangentialHistory<Vec8> history;
      if constexpr (Normal::needs_radius) state.inverse_radius = load8(&b.inverse_radius[k]);
      if constexpr (Tangential::friction) state.spin = load_lanes(b.spin, k);
      if constexpr (Tangential::history)
        history = {load_lanes(b.displacement, k), load8(&b.at_limit[k])};

      const auto out = evaluate_contact<Normal, Tangential, advance>(
          uniform ? common : collect(table, &b.coefficients[k]), state, dt, history);

      store_lanes(b.force, k, out.force);
      if constexpr (Tangential::friction) store_lanes(b.moment, k, out.moment);
      if constexpr (Tangential::history && advance) {
        store_lanes(b.displacement, k, history.displacement);
        store(&b.at_limit[k], history.at_limit);
      }
    }
  }

  template <class Normal, class Tangential> ContactKernel pick(bool uniform, bool advance)
  {
    if (uniform)
      return advance ? compute_batch<Normal, Tangential, true, true>
                     : compute_batch<Normal, Tangential, true, false>;
    return advance ? compute_batch<Normal, Tangential, false, true>
                   : compute_batch<Normal, Tangential, false, false>;
  }

  /// Calls visitor(Normal{}, Tangential{}) with the types that stand for the law.
  template <class Normal, class Visitor> auto dispatch_tangential(TangentialLaw law, Visitor visitor)
  {
    switch (law) {
      case TangentialLaw::DASHPOT: return visitor(Normal{}, TangentialDashpot{});
      case TangentialLaw::ONESTEP: return visitor(Normal{}, TangentialOnestep{});
      case TangentialLaw::MULTISTEP: return visitor(Normal{}, TangentialMultistep{});
      default: return visitor(Normal{}, TangentialNone{});
    }
  }

  template <class Visitor> auto dispatch(ContactLaw law, Visitor visitor)
  {
    if (law.normal == NormalLaw::HOOKE)
      return dispatch_tangential<NormalHooke>(law.tangential, visitor);
    return dispatch_tangential<NormalHertz>(law.tangential, visitor);
  }

}    // namespace

ContactKernel contact_kernel(ContactLaw law, bool uniform, bool advance)
{
  return dispatch(law, [=](auto normal, auto tangential) {
    return pick<decltype(normal), decltype(tangential)>(uniform, advance);
  });
}

ContactForce<double> single_contact(ContactLaw law, const ContactCoefficients &coefficients,
                                    const ContactState<double> &state, double dt,
                                    const TangentialHistory<double> &history)
{
  TangentialHistory<double> copy = history;
  return dispatch(law, [&](auto normal, auto tangential) {
    return evaluate_contact<decltype(normal), decltype(tangential), false>(coefficients, state, dt,
                                                                           copy);
  });
}

}    // namespace Talus
