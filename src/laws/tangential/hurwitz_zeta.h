// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Hurwitz' zeta function of the exponents with which forces of contacts begin and end, see
// second_order.h.

#ifndef TALUS_LAWS_TANGENTIAL_HURWITZ_ZETA_H
#define TALUS_LAWS_TANGENTIAL_HURWITZ_ZETA_H

#include "laws/tangential/midpoint.h"

namespace Talus {

/// Hurwitz' zeta(-p, t) for the p of power() and 0 < t <= 1: t^p + zeta(-p, 1 + t), and that by
/// polynomials, to 4e-8.
template <class Real> TALUS_INLINE Real hurwitz_zeta(Real p, Real t)
{
  constexpr int terms = 8;
  constexpr double of_0[terms] = {-0.5, -1.0}, of_1[terms] = {-1.0 / 12.0, -0.5, -0.5};
  constexpr double of_quarter[terms] = {-0.320451229501,   -0.860325820267,  -0.183870503231,
                                        0.0680906914594,   -0.0378135309747, 0.02023491878,
                                        -0.00776578768526, 0.00145001642375};
  constexpr double of_half[terms] = {-0.207886193114,   -0.730181357831,  -0.326458056008,
                                     0.083088078935,    -0.0407279979801, 0.0205063899565,
                                     -0.00762781400875, 0.00140074307725};
  constexpr double of_3_halves[terms] = {-0.0254852121436, -0.311828018178,   -0.547661363885,
                                         -0.163034422567,  0.030418556131,    -0.0106838251611,
                                         0.00335476767364, -0.000565690041381};
  Real sum = splat<Real>(0.0);
  for (int n = terms - 1; n >= 0; n--) {
    const auto chosen = [p](double below, double yes, Real no) {
      return select(p < splat<Real>(below), splat<Real>(yes), no);
    };
    sum = t * sum + chosen(0.125, of_0[n],
                           chosen(0.375, of_quarter[n],
                                  chosen(0.75, of_half[n],
                                         chosen(1.25, of_1[n], splat<Real>(of_3_halves[n])))));
  }
  return power(t, p) + sum;
}

/// Hurwitz' zeta(-p-1, t) for p = 1, 3/2 in the same way.
template <class Real> TALUS_INLINE Real next_hurwitz_zeta(Real p, Real t)
{
  constexpr int terms = 8;
  constexpr double of_2[terms] = {0.0, -1.0 / 6.0, -0.5, -1.0 / 3.0};
  constexpr double of_5_halves[terms] = {0.00851693932511, -0.063714006929,  -0.389767136457,
                                         -0.456516777643,  -0.101402024882,  0.0141888780042,
                                         -0.0032726276339, 0.000483693683210};
  const auto linear = p < splat<Real>(1.25);
  Real sum = splat<Real>(0.0);
  for (int n = terms - 1; n >= 0; n--)
    sum = t * sum + select(linear, splat<Real>(of_2[n]), splat<Real>(of_5_halves[n]));
  return t * power(t, p) + sum;
}

}    // namespace Talus

#endif
