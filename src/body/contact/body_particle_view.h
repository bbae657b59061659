// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The owned particles as contacts with large bodies see them: in the host's arrays, or in the
// records of ContactPipeline while particles live there. Particles are named by the host's index
// either way.

#ifndef TALUS_BODY_CONTACT_BODY_PARTICLE_VIEW_H
#define TALUS_BODY_CONTACT_BODY_PARTICLE_VIEW_H

#include "base/vector3.h"
#include "particles/particle_records.h"

namespace Talus {

/// The host's arrays, rows of three doubles. Forces, torques and virials are added to. With
/// `records`, which keep spins or else are of a scene without torques, only owned, type and virial
/// are those of the host.
struct BodyParticleView {
  int owned;
  const double *x, *v, *omega;
  const double *radius, *mass;
  const double
      *mass_override;    ///< nullptr, or per particle: > 0 replaces its mass (infinity: frozen)
  const int *type;       ///< counts from 1
  double *f, *torque;
  double *virial = nullptr;    ///< nullptr, or six for each particle: xx yy zz xy xz yz
  ParticleRecords *records = nullptr;
  const int *slot_of_atom = nullptr;    ///< of the records

  Vector3<double> position(int i) const
  {
    return records ? vector(records->position[slot_of_atom[i]].c) : vector(x + 3L * i);
  }
  Vector3<double> velocity(int i) const
  {
    return records ? vector(records->velocity(slot_of_atom[i]).c) : vector(v + 3L * i);
  }
  Vector3<double> spin(int i) const
  {
    if (!records) return vector(omega + 3L * i);
    if (records->stride == 1) return {0.0, 0.0, 0.0};
    return vector(records->spin(slot_of_atom[i]).c);
  }
  double radius_of(int i) const
  {
    return records ? records->position[slot_of_atom[i]].c[3] : radius[i];
  }
  double inverse_mass(int i) const
  {
    if (records) return records->velocity(slot_of_atom[i]).c[3];
    const bool replaced = mass_override && mass_override[i] > 0.0;
    return 1.0 / (replaced ? mass_override[i] : mass[i]);
  }
  void add_force(int i, const Vector3<double> &force) const
  {
    add(records ? records->load[records->stride * slot_of_atom[i]].c : f + 3L * i, force);
  }
  void add_torque(int i, const Vector3<double> &more) const
  {
    if (records) records->settle_torque(slot_of_atom[i]);
    add(records ? records->load[2 * static_cast<std::size_t>(slot_of_atom[i]) + 1].c
                : torque + 3L * i,
        more);
  }

  /// Calls the state of a particle into the cache.
  void call(int i) const
  {
    if (records) {
      const std::size_t s = slot_of_atom[i];
      __builtin_prefetch(&records->position[s]);
      __builtin_prefetch(&records->motion[records->stride * s]);
      __builtin_prefetch(&records->load[records->stride * s], 1);
    } else {
      for (const double *rows :
           {x, v, omega, static_cast<const double *>(f), static_cast<const double *>(torque)})
        __builtin_prefetch(rows + 3L * i);
      for (const double *numbers : {radius, mass}) __builtin_prefetch(numbers + i);
    }
  }

 private:
  static Vector3<double> vector(const double *row) { return {row[0], row[1], row[2]}; }
  static void add(double *row, const Vector3<double> &value)
  {
    row[0] += value.x;
    row[1] += value.y;
    row[2] += value.z;
  }
};

}    // namespace Talus

#endif
