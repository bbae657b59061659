// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Two warnings about contacts with a tangential spring and next to no damping, which may gain
// energy in impacts. Limits are those of `scripts/bench stability`, section "Friction without
// damping", where a gain of 1e-3 counts:
//
//   time step   the usual update of the tangential displacement is of first order: a contact counts
//               its first step whole. With a coefficient of friction above .5 the limit of Coulomb
//               takes away less and less of what is too much. None with `midpoint`, below
//               0.14/mu^(1/3) of the critical time step, or with rolling resistance above .01 mu.
//   spring      of a Hertzian contact it stiffens with the overlap while it is stretched: over an
//               impact kt s ds adds up to -1/2 s^2 dkt, and the particles receive 1/2 s^2 dkt.
//               Slip and rotation hide it, unless the coefficient of friction is above 10, or
//               rolling resistance above .2 keeps the particle from turning. No time step is
//               small enough. mindlin_rescale and mindlin_rescale/force lose energy instead.

#ifndef TALUS_SYSTEM_MONITOR_UNDAMPED_FRICTION_H
#define TALUS_SYSTEM_MONITOR_UNDAMPED_FRICTION_H

#include "laws/contact_law.h"
#include "pointers.h"

#include <string>

namespace LAMMPS_NS {

class UndampedFriction : protected Pointers {
 public:
  explicit UndampedFriction(LAMMPS *lmp) : Pointers(lmp) {}

  /// Forgets what was considered.
  void clear() { worst_step = worst_spring = Case{}; }

  /// A kind of contact of the scene. `who` names it in the warning; the damping is taken at
  /// `overlap` (length) with the effective mass and radius.
  void consider(const std::string &who, const Talus::ContactLaw &law,
                const Talus::ContactCoefficients &coefficients, double overlap, double mass_eff,
                double radius_eff);

  /// Prints what there is to say about a time step that is `fraction` of the critical one. Not
  /// collective: on one rank.
  void warn(double fraction) const;

 private:
  struct Case {
    std::string who;
    double mu = 0.0, mu_roll = 0.0;
    bool granular = false;    ///< a law of pair granular, which has other words
    bool grips = false,
         holds = false;    ///< it is friction, or rolling resistance, that is too much
  };
  Case worst_step, worst_spring;    ///< with the largest mu; mu = 0: none
};

}    // namespace LAMMPS_NS

#endif
