// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Queries of single contacts between steps: forces, and the energy stored in springs; and
// accounting for the work that contacts take from particles (contact_work.h). Not part of the
// kernels.

#ifndef TALUS_LAWS_CONTACT_ENERGY_H
#define TALUS_LAWS_CONTACT_ENERGY_H

#include "laws/contact_batch.h"
#include "laws/contact_kernel.h"

#include <utility>
#include <vector>

namespace Talus {

/// Stored: in the normal law with cohesion, in the spring of friction, in those of rolling and
/// twisting. Dissipated: by normal damping, friction, resistance.
struct EnergyByCause {
  double normal = 0.0, tangential = 0.0, resistance = 0.0;
  /// Of `normal`, if stored, that of contacts whose whole normal force works: those that end by
  /// pull-off, or are hysteretic.
  double detaching = 0.0;

  double total() const { return normal + tangential + resistance; }
  EnergyByCause &operator+=(const EnergyByCause &o)
  {
    normal += o.normal;
    tangential += o.tangential;
    resistance += o.resistance;
    detaching += o.detaching;
    return *this;
  }
  friend EnergyByCause operator*(double share, const EnergyByCause &e)
  {
    return {share * e.normal, share * e.tangential, share * e.resistance, share * e.detaching};
  }
  friend EnergyByCause operator+(EnergyByCause a, const EnergyByCause &b) { return a += b; }
  friend EnergyByCause operator-(const EnergyByCause &a, const EnergyByCause &b)
  {
    return {a.normal - b.normal, a.tangential - b.tangential, a.resistance - b.resistance,
            a.detaching - b.detaching};
  }
};

/// Dissipated energy: the work that contacts have taken less what their springs store now.
inline EnergyByCause dissipated(const EnergyByCause &work, const EnergyByCause &stored)
{
  return work - EnergyByCause{stored.detaching, stored.tangential, stored.resistance};
}

/// One contact, or one contact point of a shape, after a step, for outputs. Signs are those of the
/// first body, vectors are in space axes.
struct ContactReport {
  int i = 0, j = -1;     ///< local indices; j is -1 if the second body is a large one
  int body = -1;         ///< number of the large body, in the order of the script, from 0; or -1
  int part = -1;         ///< of the large body; -1 without parts
  double share = 1.0;    ///< 1/2 if another rank has this contact as well, else 1
  /// Of the particles, where they were when the force was found; the second only of two particles.
  Vector3<double> center[2]{};
  Vector3<double> normal{};    ///< from the second body to the first
  double overlap = 0.0;        ///< length; negative of contacts that last beyond zero
  Vector3<double> force{};     ///< on the first body
  Vector3<double> torque_per_radius{}, twisting_torque{};    ///< of spheres, see ContactLanes
  double heat_flow = 0.0;     ///< to the first body (energy/time); only of bodies and walls
  HistoryValues history{};    ///< the first three of a large body in its own frame
  EnergyByCause stored;
  /// By body, 0 of a large one: from its center to the point of contact, in the middle of the
  /// overlap or on the surface of the large body; torque on it about its center, if asked for.
  Vector3<double> arm[2]{}, torque[2]{};

  /// From the other numbers, of spheres with these radii or one and a large body.
  void set_arms_of_spheres(double radius, double other_radius);
};

inline void ContactReport::set_arms_of_spheres(double radius, double other_radius)
{
  const bool with_body = j < 0;
  const double inside = with_body ? overlap : 0.5 * overlap;
  arm[0] = (inside - radius) * normal;
  torque[0] = twisting_torque - radius * torque_per_radius;
  if (with_body) return;
  arm[1] = (other_radius - inside) * normal;
  torque[1] = -twisting_torque - other_radius * torque_per_radius;
}

/// Which data of a contact are requested: energies alone are computed faster.
enum class ContactData : bool { ENERGIES, ALL };

/// Fills in history, stored energy and, if requested, force and torques, in the frame of `state`.
/// `history`: after the step.
void report_contact(const ContactLaw &law, const ContactCoefficients &coefficients,
                    const ContactState<double> &state, double dt, const HistoryValues &history,
                    ContactData requested, ContactReport &to);

/// Of these the stored energy alone.
EnergyByCause stored_energy(const ContactLaw &law, const ContactCoefficients &coefficients,
                            const ContactState<double> &state, double dt,
                            const HistoryValues &history);

/// A vector of one lane of a batch.
inline Vector3<double> lane_of(const double (&v)[3][ContactBatch::width], int lane)
{
  return {v[0][lane], v[1][lane], v[2][lane]};
}

/// The state of one lane of a batch, as before its kernel has run.
ContactState<double> state_of_lane(const ContactBatch &batch, int lane);

/// Tangent stiffness dF_n/d overlap of the elastic normal force (force/distance) of a contact.
double tangent_stiffness(const ContactLaw &law, const ContactCoefficients &coefficients,
                         double overlap, double mass_eff, double radius_eff);

/// How a contact at rest answers to small motions: stiffness (force/distance) and damping
/// (force/velocity) of its normal force and, as long as it sticks, of its tangential force.
struct ContactResponse {
  double kn, gn, kt, gt;
};
ContactResponse response(const ContactLaw &law, const ContactCoefficients &coefficients,
                         double overlap, double mass_eff, double radius_eff);

/// Normal damping over the critical one of that stiffness, gn/(2 sqrt(m_eff dF_n/d overlap)), 0
/// without stiffness.
double damping_ratio(const ContactLaw &law, const ContactCoefficients &coefficients, double overlap,
                     double mass_eff, double radius_eff);

/// Receives ContactBatch::work of a step: the sum over contacts, and for each list one row of six
/// numbers by local index (half of a contact between two particles for each of them, all of one
/// with a large body for the particle). The first three of a row are the work up to the step
/// before, the others that of this step, whose forces have not changed the velocities yet.
struct WorkAccount {
  static constexpr int row_size = 6;

  /// During setup: the time of the kick that these forces will give in the first step; the work is
  /// then computed separately from the forces. Else -1: that kick lasts one time step.
  double time_at_setup = -1.0;
  EnergyByCause sum;    ///< of this step and rank: half of contacts that others have as well
  std::vector<double **> by_particle;    ///< rows may be added to by several threads, each its own
};

/// Begins the next step of a particle's row, or with `again` the last one once more.
inline void begin_work(double *row, bool again)
{
  for (int n = 0; n < 3; n++) {
    const double last = std::exchange(row[3 + n], 0.0);
    if (!again) row[n] += last;
  }
}

inline EnergyByCause work_of_lane(const ContactBatch &batch, int lane)
{
  return {batch.work[0][lane], batch.work[1][lane], batch.work[2][lane]};
}

/// Adds a share of the work to a particle.
inline void add_work(const WorkAccount &to, int atom, const EnergyByCause &work, double share)
{
  for (double **rows : to.by_particle) {
    rows[atom][3] += share * work.normal;
    rows[atom][4] += share * work.tangential;
    rows[atom][5] += share * work.resistance;
  }
}

}    // namespace Talus

#endif
