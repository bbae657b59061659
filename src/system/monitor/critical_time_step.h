// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Time steps that a granular scene allows, by the three usual rules (units of time; 0 if not
// defined):
//
//   contact    sqrt(m_eff/k), smallest over the contacts of the moment, k = dF_n/d overlap; without
//              contacts over the lightest pair of every pair of types at an overlap of 1 % of the
//              smaller radius; and over the lightest particle of every type against every large
//              body at 1 % of its radius. Of types with a shape always over the pairs of types
//   rayleigh   pi r sqrt(rho/G)/(0.1631 nu + 0.8766), smallest over the particles (Ning and
//              Ghadiri 2006); only types with a material law
//   hertz      2.87 (m_eff^2/(r_eff E_eff^2 v))^(1/5), the duration of a Hertzian impact at the
//              largest relative speed v of neighboring particles; only laws with Hertzian
//              stiffness, and only if v > 0
//   stable     largest one with which a particle among twelve contacts of the kind is stable, with
//              the damping and the friction of the law and the order of the integrator: smallest
//              over the pairs of types; among three contacts with each large body. Overlaps as
//              without contacts; see stable_time_step.h. A body with faces is held at the corners
//              of all of them, or by a large body of half of them
//
// m_eff is that of the contact law: spheres of a clump, or of another rigid body, have the mass of
// the body there. It turns as well when it is pushed, and each sphere may have contacts: for
// `stable` each has its own mass, a bound from below if these add up to that of the body, since the
// stiffness that a motion of the body meets is at most the largest that motions of its spheres
// meet. The density for `rayleigh` is that of the sphere as well.
//
// Collective: all ranks of `world` must call compute().

#ifndef TALUS_SYSTEM_MONITOR_CRITICAL_TIME_STEP_H
#define TALUS_SYSTEM_MONITOR_CRITICAL_TIME_STEP_H

#include "contact/contact_pipeline.h"
#include "material/pair_coeffs.h"
#include "pointers.h"
#include "shape/contact/shape_table.h"
#include "system/monitor/elastic_impacts.h"
#include "system/monitor/stable_time_step.h"
#include "system/monitor/undamped_friction.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class CriticalTimeStep : protected Pointers {
 public:
  explicit CriticalTimeStep(LAMMPS *lmp) : Pointers(lmp), undamped(lmp), elastic(lmp) {}

  double contact = 0.0, rayleigh = 0.0, hertz = 0.0, stable = 0.0;
  double stable_undamped = 0.0;    ///< `stable` of the same contacts without damping
  /// Of the laws that compute() has met.
  UndampedFriction undamped;
  ElasticImpacts elastic;

  /// `group` selects the particles whose sizes count.
  void compute(const Talus::PairCoeffs &laws, const Talus::ContactPipeline &contacts, int group);

  /// The same from the sizes of the particles alone: contacts at an overlap of 1 %, no speeds.
  /// Cheap enough for every rebuild.
  void compute_from_sizes(const Talus::PairCoeffs &laws, int group);

  /// What compute_from_sizes() depends on, of this rank and without communication: radius, then
  /// mass in contacts, then own mass of the smallest particle of each type, of those in `group` and
  /// then of those of them that each large body can touch; infinite where there is none.
  std::vector<double> sizes_here(int types, int group) const;

  /// Smallest of the first three that are defined, 0 if none is.
  double smallest() const;

 private:
  /// Of the smallest particle of each type, masses in units of force/acceleration; infinite if
  /// there is none. Of shapes the radius that laws take, and the overlap is 1 % of that of the
  /// largest sphere inside.
  struct Sizes {
    std::vector<double> radius, mass, own_mass, overlap;
  };
  struct Masses {
    double of_law, own;
  };
  Sizes smallest_particles(int types, int groups) const;
  std::vector<double> smallest_here(int types, int groups) const;
  double reduce_smallest(double mine) const;
  void consider_pairs(const Talus::PairCoeffs &laws, double speed);
  void consider_pair(const Talus::PairCoeffs &laws, int i, int j, double speed);
  void consider_damping(const std::string &who, const Talus::ContactLaw &law,
                        const Talus::ContactCoefficients &c, double overlap, double mass_eff,
                        double radius_eff);
  double smallest_body_period(int types, int group);
  void consider_stability(const Talus::ContactLaw &law, const Talus::ContactCoefficients &c,
                          double overlap, const Masses &mass_eff, double radius_eff, int contacts);
  void consider_faces(const Talus::ContactResponse &contact, const std::vector<HeldBody> &bodies);
  const Talus::ParticleShape *shape_of(int type) const;
  double rayleigh_of(const Talus::ContactSpec &spec, int type) const;

  Sizes sizes;
  double law_period = 0.0, period_of_shapes = 0.0;
  bool looks_at_damping = false;
  int order = 1;    ///< of the integrator
};

}    // namespace LAMMPS_NS

#endif
