// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What contacts are asked about between steps, one at a time: forces, and the energy stored in
// springs; and where the work goes that contacts take from particles (contact_work.h). Not part of
// the kernels.

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
  /// Of `normal`, if stored, that of contacts that tear: their work is that of the whole force.
  double tearing = 0.0;

  double total() const { return normal + tangential + resistance; }
  EnergyByCause &operator+=(const EnergyByCause &o)
  {
    normal += o.normal;
    tangential += o.tangential;
    resistance += o.resistance;
    tearing += o.tearing;
    return *this;
  }
  friend EnergyByCause operator*(double share, const EnergyByCause &e)
  {
    return {share * e.normal, share * e.tangential, share * e.resistance, share * e.tearing};
  }
  friend EnergyByCause operator+(EnergyByCause a, const EnergyByCause &b) { return a += b; }
  friend EnergyByCause operator-(const EnergyByCause &a, const EnergyByCause &b)
  {
    return {a.normal - b.normal, a.tangential - b.tangential, a.resistance - b.resistance,
            a.tearing - b.tearing};
  }
};

/// What is gone of the work that contacts have taken while springs store that much now.
inline EnergyByCause dissipated(const EnergyByCause &work, const EnergyByCause &stored)
{
  return work - EnergyByCause{stored.tearing, stored.tangential, stored.resistance};
}

/// A contact, or one point where a shape touches, as it is after a step. Everything as the first
/// body sees it, in space.
struct SurveyedContact {
  int i = 0, j = -1;     ///< host's indices; j is -1 if the second body is a large one
  int body = -1;         ///< number of the large body, in the order of the script, from 0; or -1
  int part = -1;         ///< of the large body; -1 without parts
  double share = 1.0;    ///< 1/2 if another rank has this contact as well, else 1
  Vector3<double> normal{};    ///< from the second body to the first
  double overlap = 0.0;        ///< length; negative of contacts that last beyond zero
  Vector3<double> force{};     ///< on the first body
  Vector3<double> moment{}, twisting_torque{};    ///< of spheres, see ContactLanes
  HistoryValues memory{};    ///< the first three of a large body in its own frame
  EnergyByCause stored;
  /// By body, 0 of a large one: from its center to the point of contact, in the middle of the
  /// overlap or on the surface of the large body; torque on it about its center, if asked for.
  Vector3<double> arm[2]{}, torque[2]{};

  /// From the other numbers, of spheres with these radii or one and a large body.
  void set_arms_of_spheres(double radius, double other_radius);
};

inline void SurveyedContact::set_arms_of_spheres(double radius, double other_radius)
{
  const bool with_body = j < 0;
  const double inside = with_body ? overlap : 0.5 * overlap;
  arm[0] = (inside - radius) * normal;
  torque[0] = twisting_torque - radius * moment;
  if (with_body) return;
  arm[1] = (other_radius - inside) * normal;
  torque[1] = -twisting_torque - other_radius * moment;
}

/// Which numbers of a contact are asked for: energies alone are found faster.
enum class Ask : bool { ENERGIES, ALL };

/// Of `memory` after the step: fills in memory, stored energy and, if asked for, force and torques,
/// in the frame of `state`.
void survey_contact(const ContactLaw &law, const ContactCoefficients &coefficients,
                    const ContactState<double> &state, double dt, const HistoryValues &memory,
                    Ask ask, SurveyedContact &to);

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

/// Where a step puts ContactBatch::work. Sums over contacts, and for each list one row of six by
/// host's index: half of a contact between two particles belongs to each of them, that with a large
/// body to the particle. The first three of a row are what the steps before have taken, the others
/// what this step takes: velocities have not been changed by its forces yet.
struct WorkAccount {
  static constexpr int row_size = 6;

  /// While a run is set up, of the kick that the forces will give in its first step; the work is
  /// then found apart from the forces. Else -1, and that kick lasts as long as the step.
  double time_at_setup = -1.0;
  EnergyByCause sum;    ///< of this step and rank: half of contacts that others have as well
  std::vector<double **> by_particle;    ///< rows may be added to by several threads, each its own
};

/// The next step begins for a particle; or the last one is looked at again.
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
