// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// From the arrays of a batch to the lanes that laws compute with, and back: what a stage reads, and what it leaves for
// later ones.

#ifndef TALUS_LAWS_BATCH_LANES_H
#define TALUS_LAWS_BATCH_LANES_H

#include "base/simd.h"
#include "laws/law.h"

namespace Talus {

using LanesOfVector = double[3][ContactBatch::width];

template <class Real> TALUS_INLINE Vector3<Real> load_vector(const LanesOfVector &v, int k)
{
  using In = Memory<Real>;
  return {In::load(&v[0][k]), In::load(&v[1][k]), In::load(&v[2][k])};
}

template <class Real>
TALUS_INLINE void store_vector(LanesOfVector &v, int k, const Vector3<Real> &value)
{
  Memory<Real>::store(&v[0][k], value.x);
  Memory<Real>::store(&v[1][k], value.y);
  Memory<Real>::store(&v[2][k], value.z);
}

/// The state of the contacts from lane k on, as many as a Real is wide. What is not used afterwards
/// is not read: compilers see to that.
template <class Real>
TALUS_INLINE void load_state(const ContactBatch &b, int k, ContactLanes<Real> &s)
{
  using In = Memory<Real>;
  s.normal = load_vector<Real>(b.normal, k);
  s.overlap = In::load(&b.overlap[k]);
  s.velocity = load_vector<Real>(b.velocity, k);
  s.surface_rotation = load_vector<Real>(b.surface_rotation, k);
  s.inverse_mass = In::load(&b.inverse_mass[k]);
  s.inverse_radius = In::load(&b.inverse_radius[k]);
  s.relative_omega = load_vector<Real>(b.relative_omega, k);
  s.intersection_radius = In::load(&b.intersection_radius[k]);
  s.inverse_distance = In::load(&b.inverse_distance[k]);
  s.arm_loss = In::load(&b.arm_loss[k]);
  s.arm_difference = In::load(&b.arm_difference[k]);
  s.temperature_difference = In::load(&b.temperature_difference[k]);
  s.lag = splat<Real>(b.lag);
  s.velocity_change = load_vector<Real>(b.velocity_change, k);
  s.rotation_change = load_vector<Real>(b.rotation_change, k);
  s.omega_change = load_vector<Real>(b.omega_change, k);
  s.normal_change = load_vector<Real>(b.normal_change, k);
  s.separated = In::load(&b.separated[k]);
  s.pulloff_distance = In::load(&b.pulloff_distance[k]);
}

/// The numbers that stages leave for each other: visit(member of ContactLanes, array of the batch)
/// for those that the stage writes.
template <Stage stage, class Lanes, class Batch, class Visit>
TALUS_INLINE void visit_written(Lanes &s, Batch &b, Visit visit)
{
  if constexpr (stage == Stage::NORMAL) {
    visit(s.kn, b.between.kn);
    visit(s.kt, b.between.kt);
    visit(s.tangent_n, b.between.tangent_n);
    visit(s.tangent_t, b.between.tangent_t);
    visit(s.contact_radius, b.between.contact_radius);
    visit(s.elastic, b.between.elastic);
    visit(s.pulloff_force, b.between.pulloff_force);
  } else if constexpr (stage == Stage::DAMPING) {
    visit(s.gn, b.between.gn);
    visit(s.gt, b.between.gt);
    visit(s.normal_force, b.between.normal_force);
    visit(s.critical_force, b.between.critical_force);
  }
}

/// What tangential laws of second order compute again, of the normal law.
template <class Lanes, class Batch, class Visit>
TALUS_INLINE void visit_normal_force(Lanes &s, Batch &b, Visit visit)
{
  visit(s.elastic, b.between.elastic);
  visit(s.normal_force, b.between.normal_force);
  visit(s.critical_force, b.between.critical_force);
}

template <class Lanes, class Batch, class Visit>
TALUS_INLINE void visit_approach(Lanes &s, Batch &b, Visit visit)
{
  visit(s.normal_velocity, b.between.normal_velocity);
  visit(s.mass, b.between.mass);
  visit(s.radius, b.between.radius);
  visit(s.impact_speed, b.between.impact_speed);
  visit(s.age, b.between.age);
}

/// What the stages before `stage` have found.
template <Stage stage, class Real>
TALUS_INLINE void load_found(const ContactBatch &b, int k, ContactLanes<Real> &s)
{
  const auto load = [k](Real &value, const double *from) { value = Memory<Real>::load(from + k); };
  visit_approach(s, b, load);
  if (stage == Stage::NORMAL) return;
  visit_written<Stage::NORMAL>(s, b, load);
  if (stage == Stage::DAMPING) return;
  visit_written<Stage::DAMPING>(s, b, load);
  load(s.adhesive_share, b.between.adhesive_share);
  load(s.uncorrected_force, b.between.uncorrected_force);
  load(s.delayed_force, b.between.delayed_force);
  s.full_normal = load_vector<Real>(b.between.full_normal, k);
  s.force = load_vector<Real>(b.force, k);
  if (stage == Stage::TANGENTIAL) return;
  s.torque_per_radius = load_vector<Real>(b.torque_per_radius, k);
  s.twisting_torque = load_vector<Real>(b.twisting_torque, k);
}

template <Stage stage, class Real>
TALUS_INLINE void store_found(ContactBatch &b, int k, ContactLanes<Real> &s)
{
  visit_written<stage>(s, b, [k](Real value, double *to) { Memory<Real>::store(to + k, value); });
  if constexpr (stage == Stage::HEAT) Memory<Real>::store(&b.heat_flow[k], s.heat_flow);
  if constexpr (stage == Stage::DAMPING || stage == Stage::TANGENTIAL || stage == Stage::COHESION)
    store_vector(b.force, k, s.force);
  if constexpr (stage == Stage::TANGENTIAL || stage == Stage::ROLLING)
    store_vector(b.torque_per_radius, k, s.torque_per_radius);
  if constexpr (stage == Stage::TANGENTIAL || stage == Stage::ROLLING || stage == Stage::TWISTING)
    store_vector(b.twisting_torque, k, s.twisting_torque);
}

}    // namespace Talus

#endif
