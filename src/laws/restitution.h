// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Damping that gives a wanted coefficient of restitution, and effective moduli. Used once when a
// run is set up.

#ifndef TALUS_LAWS_RESTITUTION_H
#define TALUS_LAWS_RESTITUTION_H

namespace Talus {

/// Linear contact: gn = f sqrt(m kn) with f = 2/sqrt(1 + (pi/ln e)^2). Exact for a contact that
/// ends at overlap zero. e in [0, 1].
double linear_damping_factor(double e);

/// Hertzian contact: gn = f sqrt(S_n m) with f = 2 sqrt(5/6) |beta|, beta = ln e/sqrt(ln^2 e +
/// pi^2) (Tsuji 1992, Antypov and Elliott 2011). Exact for a contact that ends at overlap zero,
/// with its attractive tail.
double hertz_damping_factor(double e);

/// The same two for a contact whose force is cut at zero (limit_damping): it ends as soon as the
/// force vanishes. Exact (Schwager and Poeschel 2007 for the linear contact; x^(5/4) and the
/// velocity of the Hertzian one obey the linear equations in stretched time; Thornton, Cummins and
/// Cleary 2013 give a fit). No finite damping gives e = 0: below .01, that of .01 is returned.
double linear_damping_factor_limited(double e);
double hertz_damping_factor_limited(double e);

/// Flores et al. 2011: 8/5 (1-e)/e, with e at least .01.
double flores_damping_factor(double e);
/// The e that the laws of Flores work with: between .01 and just below 1.
double flores_restitution(double e);

/// Effective moduli of two bodies of Young's modulus y and Poisson's ratio nu:
/// 1/E = (1-nu1^2)/y1 + (1-nu2^2)/y2,  1/G = 2(2-nu1)(1+nu1)/y1 + 2(2-nu2)(1+nu2)/y2.
double effective_young(double y1, double nu1, double y2, double nu2);
double effective_shear(double y1, double nu1, double y2, double nu2);

}    // namespace Talus

#endif
