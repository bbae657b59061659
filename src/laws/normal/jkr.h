// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Johnson, Kendall and Roberts (1971, Proc. R. Soc. A 324, 301), as LAMMPS' pair granular has it:
//
//   overlap = a^2/R - 2 sqrt(pi gamma a/E),   F_e = 4/3 E a^3/R - 4 a^(3/2) sqrt(pi gamma E)
//
// with E = E_eff and the contact radius a, the largest root (Parteli et al. 2014, Sci. Rep. 4,
// 6227, has it in closed form). The bodies separate at the force -3 pi gamma R. A contact begins at
// overlap zero and lasts until the bodies are apart by the distance reach().

#ifndef TALUS_LAWS_NORMAL_JKR_H
#define TALUS_LAWS_NORMAL_JKR_H

#include "base/power.h"
#include "laws/normal/adhesive.h"

#include <algorithm>
#include <cmath>

namespace Talus {

struct Jkr : AdhesiveLaw {
  static constexpr const char *name = "jkr", *label = name;
  static constexpr bool lasts_beyond_contact = true;

  /// 3 pi^2/16 R gamma^2/E^2
  template <class Real>
  TALUS_INLINE static Real pulloff_cube(const Row<Real> &c, const ContactSize<Real> &size)
  {
    const Real ratio = c.gamma / c.young;
    return 3.0 * pi * pi / 16.0 * size.radius * ratio * ratio;
  }

  /// The work of F_e from overlap zero on, where a^3 = 4 pi gamma R^2/E. What is left of it when
  /// the bodies separate is lost.
  static double stored(const ContactLanes<double> &s, const Row<double> &c,
                       const double * /*history*/)
  {
    const double begin = cube_root(4.0 * pi * c.gamma * s.radius * s.radius / c.young);
    return work_from_zero(c, s.contact_radius, s.radius) - work_from_zero(c, begin, s.radius);
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    const Real zero = splat<Real>(0.0);
    const Real a = contact_radius(c, s.overlap, s.radius);
    const Real tension = square_root((pi * a) * c.gamma * c.young);
    s.contact_radius = a;
    s.kn = (4.0 / 3.0) * c.young * a;
    s.kt = s.tangent_t = zero;
    s.elastic = a * (s.kn * a / s.radius - 4.0 * tension);
    s.pulloff_force = pulloff_force(3.0, c.gamma, s);
    // dF/da over d overlap/da; 0 where the bodies separate, at the strongest pull
    const Real opening = 2.0 * a / s.radius - tension / (c.young * a);
    const Real stiffness = (4.0 * c.young * a * a / s.radius - 6.0 * tension) / opening;
    s.tangent_n = select((opening > zero) & (stiffness > zero), stiffness, zero);
  }

 private:
  /// The work of F_e from a = 0 on.
  static double work_from_zero(const Row<double> &c, double a, double radius)
  {
    const double a2 = a * a, tension = std::sqrt(pi * c.gamma * c.young * a);
    return a2 * (8.0 / 15.0 * c.young * a2 * a / (radius * radius) -
                 8.0 / 3.0 * tension * a / radius + 2.0 * pi * c.gamma);
  }

  template <class Real> TALUS_INLINE static Real not_negative(Real x)
  {
    const Real zero = splat<Real>(0.0);
    return select(x > zero, x, zero);
  }

  /// 0 where the divisor is: a contact without adhesion at overlap zero.
  template <class Real> TALUS_INLINE static Real quotient(Real a, Real divisor)
  {
    const Real zero = splat<Real>(0.0);
    return select(divisor > zero, a / divisor, zero);
  }

  /// The closed form loses digits if there is little adhesion: one step of Newton's method brings
  /// them back.
  template <class Real>
  TALUS_INLINE static Real contact_radius(const Row<Real> &c, Real overlap, Real radius)
  {
    const Real a = closed_form(c, overlap * radius, radius);
    const Real stretch = square_root((pi * a) * c.gamma / c.young);
    const Real slope = 2.0 * a / radius - quotient(stretch, a);
    return a - quotient(a * a / radius - 2.0 * stretch - overlap, slope);
  }

  /// dr: overlap times R.
  template <class Real>
  TALUS_INLINE static Real closed_form(const Row<Real> &c, Real dr, Real radius)
  {
    const Real r2 = radius * radius, dr2 = dr * dr;
    const Real adhesion = c.gamma * c.gamma * r2 * r2 * c.young;
    const Real t1 = (27.0 * pi * pi) * adhesion, t2 = 8.0 * dr * dr2 * c.young * c.young * c.young;
    const Real inner = square_root(not_negative(adhesion * (t1 + 2.0 * t2)));
    const Real t4 = cube_root(t1 + t2 + (3.0 * 1.73205080756887729353 * pi) * inner);
    const Real t5 = 4.0 * dr2 * quotient(c.young, t4) + t4 / c.young;
    const Real t6 = square_root(not_negative(2.0 * dr + t5));
    const Real pull = (6.0 * 2.44948974278317809820 * pi) * c.gamma * r2 / c.young;
    const Real outer = 4.0 * dr - t5 + quotient(pull, t6);
    return 0.40824829046386301637 * (t6 + square_root(not_negative(outer)));
  }
};

}    // namespace Talus

#endif
