// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The state of the particles of a rank and the sums of their forces, wherever they live in a step:
// in the arrays of LAMMPS, or in the records in steps at which nothing outside of Talus reads them.
// Code that computes contacts with bodies, walls and shapes, or moves clumps, reads and writes
// particles here and does not ask which it is.
//
// A particle has a local index i; its place is where it is stored: that index in the arrays, its
// slot in the records. Loops over many particles keep places, and read eight of them at a time.
//
// Made for each use, by GranularSystem::particles(); valid until the particles go elsewhere:
// when forces between particles are computed, or they return to LAMMPS. Units are those of LAMMPS.

#ifndef TALUS_PARTICLES_PARTICLE_STATE_H
#define TALUS_PARTICLES_PARTICLE_STATE_H

#include "base/lanes.h"
#include "base/vector3.h"
#include "particles/particle_records.h"
#include "particles/particle_rows.h"

#include <cstddef>

namespace Talus {

class ParticleState {
 public:
  /// Of no particles.
  ParticleState() = default;
  /// In the arrays; `type` counts from 1. With `records` there, of owned particles and ghosts, with
  /// the slot of each.
  ParticleState(int owned, const ParticleView &view, const int *type,
                ParticleRecords *records = nullptr, const int *slot_of_atom = nullptr) :
      num_owned(owned),
      arrays(view), types(type), in_records(records), slots(slot_of_atom)
  {
  }

  int owned() const { return num_owned; }
  int type(int i) const { return types[i]; }
  /// In the arrays, other masses for some particles, see ParticleView; in the records they are those
  /// of the last step.
  void replace_masses(const double *mass_override) { arrays.mass_override = mass_override; }

  /// The records, for code that moves many particles in its own way; nullptr: particles are in the
  /// arrays.
  ParticleRecords *records() const { return in_records; }
  /// Slots by local index, in whose order a step goes through the particles; nullptr: in none.
  const int *order() const { return in_records ? slots : nullptr; }

  // ---- by local index

  int place(int i) const { return in_records ? slots[i] : i; }
  Vector3<double> position(int i) const { return vector(x(i)); }
  double radius(int i) const { return radius_at(place(i)); }
  Vector3<double> velocity(int i) const { return vector(v(i)); }
  /// 0 in a scene without torques.
  Vector3<double> angular_velocity(int i) const
  {
    return keeps_omega() ? vector(w(i)) : Vector3<double>{0.0, 0.0, 0.0};
  }
  /// As contacts feel it; 0 of frozen particles.
  double inverse_mass(int i) const
  {
    return in_records ? in_records->velocity(slots[i]).c[3] : inverse_mass_in_arrays(i);
  }

  /// Rows of three: position, velocity, angular velocity (only where there are torques); to be moved
  /// by integrators.
  double *x(int i) const { return row_at(place(i)); }
  double *v(int i) const
  {
    return in_records ? in_records->motion[in_records->stride * slots[i]].c : arrays.v + 3L * i;
  }
  double *w(int i) const
  {
    return in_records ? in_records->motion[2 * slot(i) + 1].c : arrays.omega + 3L * i;
  }
  /// Rows of three: the sums of forces, and of torques (only where there are torques), to be changed
  /// by forces other than those of contacts.
  double *f(int i) const
  {
    if (!in_records) return arrays.f + 3L * i;
    in_records->has_acted(slots[i]);
    return in_records->load[in_records->stride * slots[i]].c;
  }
  double *torque(int i) const
  {
    if (!in_records) return arrays.torque + 3L * i;
    in_records->settle_torque(slots[i]);
    return in_records->load[2 * slot(i) + 1].c;
  }
  /// The same of all particles. Without torques angular velocities stay in the arrays.
  ParticleRows positions() const
  {
    if (!in_records) return {arrays.x};
    return {in_records->position.empty() ? nullptr : in_records->position[0].c, 4, slots};
  }
  ParticleRows velocities() const { return in_records ? motion_rows(0) : ParticleRows{arrays.v}; }
  ParticleRows angular_velocities() const
  {
    return in_records && keeps_omega() ? motion_rows(1) : ParticleRows{arrays.omega};
  }
  /// Angular velocities and torques are kept; without friction in the records they are not.
  bool keeps_omega() const { return !in_records || in_records->stride == 2; }
  /// Of its velocities, see ParticleRecords::change; nullptr if they are not kept.
  ChangeRecord *change(int i) const
  {
    ChangeRecord *const all = changes();
    return all ? all + place(i) : nullptr;
  }

  struct Load {
    Vector3<double> force, torque;
  };
  /// The sums, where there are torques, as integrators see them: those of a frozen particle are not
  /// cleared in the records.
  Load load(int i) const
  {
    if (!in_records) return {vector(arrays.f + 3L * i), vector(arrays.torque + 3L * i)};
    if (!(in_records->velocity(slots[i]).c[3] > 0.0)) return {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    Record torque;
    store(torque, in_records->torque(slots[i]));
    return {vector(in_records->load[2 * slot(i)].c), vector(torque.c)};
  }
  /// The sum of forces, of any particle.
  Vector3<double> force(int i) const { return vector(f(i)); }
  /// Adds to the sums of one particle, where there are torques; by one thread for each.
  void add(int i, const Vector3<double> &force, const Vector3<double> &torque) const
  {
    double *const t_sum = this->torque(i), *const f_sum = f(i);
    f_sum[0] += force.x;
    f_sum[1] += force.y;
    f_sum[2] += force.z;
    t_sum[0] += torque.x;
    t_sum[1] += torque.y;
    t_sum[2] += torque.z;
  }

  // ---- by place

  double radius_at(int place) const
  {
    return in_records ? in_records->position[place].c[3] : arrays.radius[place];
  }

  /// Prefetches a position and radius.
  void prefetch_position(int place) const
  {
    if (in_records) {
      __builtin_prefetch(in_records->position.data() + place);
    } else {
      __builtin_prefetch(arrays.x + 3L * place);
      __builtin_prefetch(arrays.radius + place);
    }
  }
  /// Prefetches what a contact reads and adds to, once its position is known.
  void prefetch_for_contact(int place) const
  {
    if (in_records) {
      in_records->prefetch_for_contact(place);
    } else {
      for (const double *rows : {arrays.v, arrays.omega}) __builtin_prefetch(rows + 3L * place);
      for (const double *rows : {arrays.f, arrays.torque}) __builtin_prefetch(rows + 3L * place, 1);
      __builtin_prefetch(arrays.mass + place);
    }
  }

  /// Adds to the sums of one particle, by one thread for each; `torque`: nullptr where there are none. The fourth numbers
  /// are not read.
  TALUS_INLINE void add_at(int place, Vec4 force, const Vec4 *torque) const;

  // ---- by place, eight at a time: lane k is the particle at place(k)

  template <class Place>
  TALUS_INLINE void spheres_at(Place place, double (&center)[3][lanes],
                               double (&radii)[lanes]) const;
  struct Motion {
    Vector3<Vec8> velocity, omega;
    Vec8 inverse_mass, inverse_radius;
  };
  /// `radii`: of these particles; without torques omega is 0.
  template <class Place>
  TALUS_INLINE Motion motion_at(Place place, Vec8 radii, bool with_torques) const;
  /// Changes of velocities by place, as change().
  ChangeRecord *changes() const
  {
    if (!in_records) return arrays.change;
    return in_records->keeps_changes() ? in_records->change.data() : nullptr;
  }
  /// Adds to the sums of the first `count` of these particles, one after another: some may be the
  /// same. `torques`: nullptr where there are none.
  template <class Place>
  TALUS_INLINE void add_at(Place place, int count, const EightRows &forces,
                           const EightRows *torques) const;

 private:
  static Vector3<double> vector(const double *row) { return {row[0], row[1], row[2]}; }
  ParticleRows motion_rows(int which) const
  {
    const auto &motion = in_records->motion;
    return {motion.empty() ? nullptr : motion[which].c, 4 * static_cast<int>(in_records->stride),
            slots};
  }
  std::size_t slot(int i) const { return static_cast<std::size_t>(slots[i]); }
  double *row_at(int place) const
  {
    return in_records ? in_records->position[place].c : arrays.x + 3L * place;
  }
  double inverse_mass_in_arrays(int i) const
  {
    const bool replaced = arrays.mass_override && arrays.mass_override[i] > 0.0;
    return 1.0 / (replaced ? arrays.mass_override[i] : arrays.mass[i]);
  }

  int num_owned = 0;
  ParticleView arrays{};
  const int *types = nullptr;
  ParticleRecords *in_records = nullptr;
  const int *slots = nullptr;
};

template <class Place>
TALUS_INLINE void ParticleState::spheres_at(Place place, double (&center)[3][lanes],
                                            double (&radii)[lanes]) const
{
  if (in_records) {
    const Record *const positions = in_records->position.data();
    const EightRows spheres =
        to_lanes([=](int k) -> const Record & { return positions[place(k)]; });
    for (int d = 0; d < 3; d++) store(center[d], spheres.number[d]);
    store(radii, spheres.number[3]);
    return;
  }
  for (int k = 0; k < lanes; k++) {
    const int i = place(k);
    for (int d = 0; d < 3; d++) center[d][k] = arrays.x[3L * i + d];
    radii[k] = arrays.radius[i];
  }
}

template <class Place>
TALUS_INLINE ParticleState::Motion ParticleState::motion_at(Place place, Vec8 radii,
                                                            bool with_torques) const
{
  if (in_records) {
    const EightRows v =
        to_lanes([&](int k) -> const Record & { return in_records->velocity(place(k)); });
    const Vector3<Vec8> velocity{v.number[0], v.number[1], v.number[2]};
    if (!with_torques) return {velocity, Vector3<Vec8>{}, v.number[3], splat<Vec8>(1.0) / radii};
    const EightRows w =
        to_lanes([&](int k) -> const Record & { return in_records->omega(place(k)); });
    return {velocity, {w.number[0], w.number[1], w.number[2]}, v.number[3], w.number[3]};
  }
  alignas(64) double velocity[3][lanes], omega[3][lanes] = {}, inverse_mass[lanes];
  for (int k = 0; k < lanes; k++) {
    const int i = place(k);
    for (int d = 0; d < 3; d++) velocity[d][k] = arrays.v[3L * i + d];
    for (int d = 0; d < 3 && with_torques; d++) omega[d][k] = arrays.omega[3L * i + d];
    inverse_mass[k] = inverse_mass_in_arrays(i);
  }
  return {{load8(velocity[0]), load8(velocity[1]), load8(velocity[2])},
          {load8(omega[0]), load8(omega[1]), load8(omega[2])},
          load8(inverse_mass),
          splat<Vec8>(1.0) / radii};
}

/* The mark of settle_torque() is set together with the force: a record that is read whole right
   after one number of it was written is late. */

TALUS_INLINE void ParticleState::add_at(int place, Vec4 force, const Vec4 *torque) const
{
  if (in_records) {
    Record *const sums = &in_records->load[in_records->stride * place];
    in_records->has_acted(place);
    const Vec4 before = load4(sums[0]);
    if (torque) store(sums[1], in_records->torque(place) + *torque);
    const Vec4 mark = torque ? four(1.0, 1.0, 1.0, 1.0) : before;
    store(sums[0], shuffle<0, 1, 2, 7>(before + force, mark));
  } else {
    const auto add = [place](Vec4 more, double *rows) {
      double *const row = rows + 3L * place;
      write_row(record_of(row, 0.0) + more, row);
    };
    add(force, arrays.f);
    if (torque) add(*torque, arrays.torque);
  }
}

template <class Place>
TALUS_INLINE void ParticleState::add_at(Place place, int count, const EightRows &forces,
                                        const EightRows *torques) const
{
  Record force[lanes], torque[lanes];
  to_rows(forces, force);
  if (torques) to_rows(*torques, torque);
  for (int k = 0; k < count; k++) {
    const Vec4 of_lane = torques ? load4(torque[k]) : Vec4{};
    add_at(place(k), load4(force[k]), torques ? &of_lane : nullptr);
  }
}

}    // namespace Talus

#endif
