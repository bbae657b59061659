// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A warning about scenes in which nothing takes energy away: no contact is damped, none slides.
//
// The force of a contact begins and ends with a kink, and within a time step. What the integrator
// makes of the kinks depends on the moments within a step at which they happen, so that an elastic
// impact leaves with a little more or less energy than it came with: by up to .24 f^2 of it with a
// linear law, .06 f^2.5 with a Hertzian one, f = dt/sqrt(m_eff/k) with k at the largest overlap.
// The mean over the moments is next to zero, but nothing brings the energy back: it walks at
// random, with the root of the number of impacts. Limits are those of `scripts/bench stability`,
// section "Elastic impacts without friction", where 1e-3 counts. They are fractions of the critical
// time step, that of Hertzian contacts at an overlap of 1 %; deeper ones, up to 10 %, are allowed
// for. Integrators of second order make up for the kinks (laws/tangential/end_of_contact.h): then
// nothing is said.

#ifndef TALUS_SYSTEM_MONITOR_ELASTIC_IMPACTS_H
#define TALUS_SYSTEM_MONITOR_ELASTIC_IMPACTS_H

#include "laws/contact_law.h"
#include "pointers.h"

#include <string>

namespace LAMMPS_NS {

class ElasticImpacts : protected Pointers {
 public:
  /// Largest time steps that are advised, over the critical one.
  static constexpr double advised_linear = 0.03, advised_hertzian = 0.07;

  explicit ElasticImpacts(LAMMPS *lmp) : Pointers(lmp) {}

  /// Forgets what was considered.
  void clear();

  /// A kind of contact of the scene. `who` names it in the warning; the damping is taken at
  /// `overlap` (length) with the effective mass and radius.
  void consider(const std::string &who, const Talus::ContactLaw &law,
                const Talus::ContactCoefficients &coefficients, double overlap, double mass_eff,
                double radius_eff);

  /// Prints what there is to say about a time step that is `fraction` of the critical one. Not
  /// collective: on one rank.
  void warn(double fraction) const;

 private:
  bool loses_energy = false;    ///< some contact does
  std::string strictest;        ///< kind of contact with the lowest limit
  double advised = 0.0;         ///< its limit, 0: none was considered
};

}    // namespace LAMMPS_NS

#endif
