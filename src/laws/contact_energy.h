// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Where the energy of contacts goes: stored in springs, or dissipated by damping, friction and
// resistance. Diagnostics only, contact by contact; not part of the kernels.

#ifndef TALUS_LAWS_CONTACT_ENERGY_H
#define TALUS_LAWS_CONTACT_ENERGY_H

#include "laws/contact_batch.h"
#include "laws/contact_kernel.h"

#include <vector>

namespace Talus {

/// Energy stored in one contact, and the parts of its forces that take energy from the bodies.
/// Forces act on the first body, torques on body i are -r_i times a moment, plus (first body) or
/// minus a torque.
struct ContactEnergy {
  double elastic_normal = 0.0;                ///< of normal law and cohesion
  double elastic_in_damping = 0.0;            ///< of `elastic_normal`, whose force is in `damping`
  double elastic_tangential = 0.0;            ///< of the tangential law
  double elastic_resistance = 0.0;            ///< of rolling and twisting
  Vector3<double> damping{0.0, 0.0, 0.0};     ///< normal damping force; of contacts that tear, the whole one
  Vector3<double> friction{0.0, 0.0, 0.0};    ///< tangential; its work is stored or dissipated
  Vector3<double> friction_moment{0.0, 0.0, 0.0};
  Vector3<double> friction_torque{0.0, 0.0, 0.0};    ///< of friction, opposite on both bodies
  Vector3<double> rolling_moment{0.0, 0.0, 0.0};
  Vector3<double> resistance_torque{0.0, 0.0, 0.0};    ///< of rolling and twisting, the same
};

/// `memory` as it is after the step.
ContactEnergy contact_energy(const ContactLaw &law, const ContactCoefficients &coefficients,
                             const ContactState<double> &state, double dt,
                             const RememberedValues &memory);

/// The same for one lane of a batch after its kernel has run.
ContactEnergy lane_energy(const ContactLaw &law, const ContactCoefficients &coefficients,
                          const ContactBatch &batch, int lane, double dt);

/// Tangent stiffness dF_n/d overlap of the elastic normal force (force/distance) of a contact.
double tangent_stiffness(const ContactLaw &law, const ContactCoefficients &coefficients,
                         double overlap, double mass_eff, double radius_eff);

/// Normal damping over the critical one of that stiffness, gn/(2 sqrt(m_eff dF_n/d overlap)), 0
/// without stiffness.
double damping_ratio(const ContactLaw &law, const ContactCoefficients &coefficients, double overlap,
                     double mass_eff, double radius_eff);

/// Running account of the contacts of one rank. Work is that of the time step as the integrator
/// takes it: force times the mean of the velocities before and after the kick, so that for
/// semi-implicit Euler it equals the change of kinetic energy exactly. Energy dissipated by
/// friction or resistance is the work of these forces less what is stored at the time of asking:
/// what a contact still stores when it opens is lost, and counted so. Normal forces of
/// contacts that last beyond zero overlap, and then tear, are treated in the same way. What contacts
/// store in the first step of all has come from nowhere.
class EnergyAccount {
 public:
  /// Before the contacts of a step: forgets the forces of the last one and what it stored.
  void begin_step(int num_particles);

  /// Adds a contact of the particles `first` and `second` (second < 0: a large body, which does no
  /// work here). `share` is 1/2 for a contact that another rank counts as well.
  void add(const ContactEnergy &e, double share, int first, double first_radius, int second,
           double second_radius);

  /// After the integrator has moved the velocities of an owned particle. Lengths of time and
  /// velocities in the units of the caller.
  /// `surface`: velocity of a surface that runs past its body.
  void move(int particle, double dt, const Vector3<double> &mean_velocity,
            const Vector3<double> &mean_omega, const Vector3<double> &surface = {0.0, 0.0, 0.0});
  /// After the last move() of a step: the forces have been used.
  void end_step() { forces.clear(); }
  bool waits_for_move() const { return !forces.empty(); }

  double elastic() const { return elastic_normal + elastic_tangential + elastic_resistance; }
  double dissipated_normal() const { return work_normal - elastic_in_damping; }
  double dissipated_tangential() const { return work_tangential - elastic_tangential; }
  double dissipated_resistance() const { return work_resistance - elastic_resistance; }

 private:
  struct Forces {
    Vector3<double> damping{0.0, 0.0, 0.0}, friction{0.0, 0.0, 0.0};
    Vector3<double> friction_torque{0.0, 0.0, 0.0}, resistance_torque{0.0, 0.0, 0.0};
  };
  void add_end(const ContactEnergy &e, int particle, double radius, double sign);

  std::vector<Forces> forces;    // by particle
  double elastic_normal = 0.0, elastic_in_damping = 0.0;
  double elastic_tangential = 0.0, elastic_resistance = 0.0;
  int evaluations = 0;    // of the contacts: none, the first, more
  double work_normal = 0.0, work_tangential = 0.0, work_resistance = 0.0;
};

}    // namespace Talus

#endif
