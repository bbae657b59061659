// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Laws of LAMMPS' pair granular with the word synchronized_verlet (from 4 Jul 2026 on; Vyas,
// Ottino, Lueptow and Umbanhowar 2025, Comput. Phys. Commun. 310, 109524). The velocities that
// velocity Verlet has when forces are computed are those of half a step before, and so is the
// normal that all stages see: that of dx - v dt/2. What is kept of friction and rolling is first
// turned into the tangent plane of that normal, lengthened there, and then turned into that of the
// positions; so is the slip of the tangential dashpot where the displacement has left that plane.
// Both classic laws only see the normal of half a step before.
//
// While a run is set up the slip is not turned, as in LAMMPS.

#ifndef TALUS_LAWS_TANGENTIAL_SYNCHRONIZED_H
#define TALUS_LAWS_TANGENTIAL_SYNCHRONIZED_H

#include "laws/tangential/granular.h"

#include <cstddef>

namespace Talus {

template <class Real> struct SynchronizedRow {
  Real kt, xt, mu, dt;
};

/// Chosen by the models of LAMMPS, not by a word of ours. dt: time step.
template <class L> struct Synchronized : L {
  static constexpr bool synchronized = true;
  template <class Real> using Row = SynchronizedRow<Real>;
  static constexpr CoefficientName coefficients[] = {{"kt"}, {"xt"}, {"mu"}, {"dt", Shown::NEVER}};
  static constexpr std::nullptr_t read = nullptr;

  static SynchronizedRow<double> mix(const Mixing &m)
  {
    const GranularRow<double> row = L::mix(m);
    return {row.kt, row.xt, row.mu, m.smallest("dt")};
  }
  template <class Real>
  static Real stored(const ContactLanes<Real> &s, const Row<Real> &c, const Real *h)
  {
    return L::stored(s, GranularRow<Real>{c.kt, c.xt, c.mu}, h);
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    L::template follow<advance, true>(GranularRow<Real>{c.kt, c.xt, c.mu}, s, h, dt);
  }
};

struct SynchronizedLinear : Synchronized<LinearHistory> {
  static constexpr const char *name = "linear_history synchronized_verlet", *label = name;
};

struct SynchronizedLinearClassic : Synchronized<LinearHistoryClassic> {
  static constexpr const char *name = "linear_history_classic synchronized_verlet", *label = name;
};

struct SynchronizedMindlin : Synchronized<Mindlin> {
  static constexpr const char *name = "mindlin synchronized_verlet", *label = name;
};

struct SynchronizedMindlinForce : Synchronized<MindlinForce> {
  static constexpr const char *name = "mindlin/force synchronized_verlet", *label = name;
};

struct SynchronizedMindlinRescale : Synchronized<MindlinRescale> {
  static constexpr const char *name = "mindlin_rescale synchronized_verlet", *label = name;
};

struct SynchronizedMindlinRescaleForce : Synchronized<MindlinRescaleForce> {
  static constexpr const char *name = "mindlin_rescale/force synchronized_verlet", *label = name;
};

struct SynchronizedMindlinClassic : Synchronized<MindlinClassic> {
  static constexpr const char *name = "mindlin_classic synchronized_verlet", *label = name;
};

}    // namespace Talus

#endif
