// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The owned particles as contacts with large bodies see them: in the host's arrays, or in the
// records of ContactPipeline while particles live there. A particle has the host's index, and in
// the records a slot; its index in the view is the one or the other.

#ifndef TALUS_BODY_CONTACT_BODY_PARTICLE_VIEW_H
#define TALUS_BODY_CONTACT_BODY_PARTICLE_VIEW_H

#include "base/vector3.h"
#include "particles/particle_records.h"

namespace Talus {

/// The host's arrays, rows of three doubles. Forces, torques and virials are added to. With
/// `records`, which keep angular velocities or else are of a scene without torques, only owned,
/// type and virial are those of the host.
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
  const int *slot_of_atom = nullptr;       ///< of the records
  const ChangeRecord *change = nullptr;    ///< see ParticleView

  // by the host's index
  int index_of(int atom) const { return records ? slot_of_atom[atom] : atom; }
  Vector3<double> position(int atom) const { return position_at(index_of(atom)); }
  double radius_of(int atom) const { return radius_at(index_of(atom)); }
  Vector3<double> velocity(int atom) const
  {
    return records ? vector(records->velocity(slot_of_atom[atom]).c) : vector(v + 3L * atom);
  }
  Vector3<double> angular_velocity(int atom) const
  {
    if (!records) return vector(omega + 3L * atom);
    if (records->stride == 1) return {0.0, 0.0, 0.0};
    return vector(records->omega(slot_of_atom[atom]).c);
  }

  // by the index in the view
  Vector3<double> position_at(int index) const
  {
    return vector(records ? records->position[index].c : x + 3L * index);
  }
  double radius_at(int index) const
  {
    return records ? records->position[index].c[3] : radius[index];
  }
  /// Without records.
  double inverse_mass_in_arrays(int index) const
  {
    const bool replaced = mass_override && mass_override[index] > 0.0;
    return 1.0 / (replaced ? mass_override[index] : mass[index]);
  }
  void prefetch_position(int index) const
  {
    if (records) {
      __builtin_prefetch(records->position.data() + index);
    } else {
      __builtin_prefetch(x + 3L * index);
      __builtin_prefetch(radius + index);
    }
  }
  /// What a contact reads and adds to, once its position is known.
  void prefetch_for_contact(int index) const
  {
    if (records) {
      records->prefetch_for_contact(index);
    } else {
      for (const double *rows : {v, omega}) __builtin_prefetch(rows + 3L * index);
      for (double *rows : {f, torque}) __builtin_prefetch(rows + 3L * index, 1);
      __builtin_prefetch(mass + index);
    }
  }

 private:
  static Vector3<double> vector(const double *row) { return {row[0], row[1], row[2]}; }
};

}    // namespace Talus

#endif
