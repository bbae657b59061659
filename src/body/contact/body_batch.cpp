// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/body_batch.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

Vector3<double> lane_of(const double (&v)[3][ContactBatch::width], int k)
{
  return {v[0][k], v[1][k], v[2][k]};
}

void set_lane(double (&v)[3][ContactBatch::width], int k, const Vector3<double> &value)
{
  v[0][k] = value.x;
  v[1][k] = value.y;
  v[2][k] = value.z;
}

}    // namespace

BodyBatch::BodyBatch()
{
  batch.clear();
}

void BodyBatch::start(bool with_exact)
{
  filled = 0;
  load = BodyLoad{};
  largest_overlap = 0.0;
  if (with_exact) exact.clear();
  remembered.clear();
  touched.clear();
}

/* Seen from the body, the particle moves with its velocity less that which the body would have at
   its center, and spins less the body's spin: so sliding, rolling and spinning are those of the two
   surfaces. A body that is not free is infinitely heavy: m_eff is the mass of the particle. R_eff
   is its radius. */

void BodyBatch::add(const BodyTask &task, int law, int i, const SurfaceContact &contact,
                    const Record &history, const Record &impact, int slot)
{
  const BodyParticleView &view = task.view;
  const BodyFrame &frame = task.frame;
  const int lane = filled;
  const double r = view.radius_of(i);
  Vector3<double> velocity = view.velocity(i), spin = view.spin(i);
  if (frame.moves) {
    velocity = frame.to_body(velocity - frame.velocity_at(view.position(i)));
    spin = frame.to_body(spin - frame.state.spin);
  }
  atom_of_lane[lane] = i;
  slot_of_lane[lane] = slot;
  part_of_lane[lane] = contact.part;
  set_lane(batch.normal, lane, contact.normal);
  batch.overlap[lane] = contact.overlap;
  set_lane(batch.velocity, lane, velocity);
  set_lane(batch.spin, lane, r * spin);
  batch.inverse_mass[lane] = view.inverse_mass(i) + frame.inverse_mass;
  batch.inverse_radius[lane] = 1.0 / r;
  batch.coefficients[lane] = task.row_of(i);
  if (task.with_resistance) {
    // the body is flat on the scale of the contact: the circle in which it cuts the sphere
    const double d = contact.overlap;
    set_lane(batch.relative_omega, lane, spin);
    batch.circle[lane] = std::sqrt(std::max(2.0 * r * d - d * d, 0.0));
  }
  if (task.with_history) {
    for (int n = 0; n < 4; n++) batch.history[n][lane] = history.c[n];
  }
  if (task.with_impact)
    for (int n = 0; n < 4; n++) batch.history[4 + n][lane] = impact.c[n];
  if (++filled == ContactBatch::width) flush(task, law);
}

void BodyBatch::flush(const BodyTask &task, int law)
{
  if (!filled) return;
  // lanes behind the last contact hold older, finite contacts: computed, but not used
  const int end = (filled + lanes - 1) / lanes * lanes;
  task.laws.kernel(law, task.advance)(batch, 0, end, task.laws.coefficients(), task.dt);
  const ContactLaw &its = task.laws.distinct_law(law);
  const bool keeps = task.with_history && task.advance;
  for (int lane = 0; lane < filled; lane++) {
    apply(task, lane, its);
    if (keeps) keep_history(lane, task.with_impact);
    if (task.record_parts) record(task, lane);
    if (!task.energies) continue;
    const int i = atom_of_lane[lane];
    largest_overlap = std::max(largest_overlap, batch.overlap[lane] / task.view.radius_of(i));
    task.energies->add(
        lane_energy(its, task.laws.coefficients(batch.coefficients[lane]), batch, lane, task.dt),
        1.0, i, task.view.radius_of(i), -1, 0.0);
  }
  filled = 0;
}

void BodyBatch::keep_history(int lane, bool with_impact)
{
  const int slot = slot_of_lane[lane];
  Record history, impact;
  for (int n = 0; n < 4; n++) {
    history.c[n] = batch.history[n][lane];
    impact.c[n] = batch.history[4 + n][lane];
  }
  if (sparse) {
    sparse->record(slot) = history;
    if (with_impact) sparse->impact(slot) = impact;
    return;
  }
  remembered[slot].history = history;
  if (with_impact) remembered[slot].impact = impact;
}

/* The reaction acts where the lever arm of the particle ends, r along the normal, and rolling and
   spinning resistance act as couples of opposite sign: so forces and torques of particle and body
   balance exactly. */

void BodyBatch::apply(const BodyTask &task, int lane, const ContactLaw &law)
{
  const BodyParticleView &view = task.view;
  const BodyFrame &frame = task.frame;
  const int i = atom_of_lane[lane];
  const double r = view.radius_of(i);
  const Vector3<double> force = frame.to_space(lane_of(batch.force, lane));
  view.add_force(i, force);
  Vector3<double> resistance{0.0, 0.0, 0.0};    // couple on the particle
  if (law.resists()) {
    const Vector3<double> couple = frame.to_space(lane_of(batch.couple, lane));
    const Vector3<double> moment = frame.to_space(lane_of(batch.moment, lane));
    view.add_torque(i, couple - r * moment);
    const Vector3<double> normal = frame.to_space(lane_of(batch.normal, lane));
    resistance = couple - r * (moment - cross(normal, force));
  } else if (law.has_friction()) {
    view.add_torque(i, -r * frame.to_space(lane_of(batch.moment, lane)));
  }

  const Vector3<double> branch = r * frame.to_space(lane_of(batch.normal, lane));
  const Vector3<double> about = frame.moves ? frame.state.position : frame.origin;
  const Vector3<double> arm = view.position(i) - branch - about;
  const Vector3<double> torque = -cross(arm, force) - resistance;
  load.force = load.force - force;
  load.torque = load.torque + torque;
  load.contacts += 1.0;
  if (task.exact) exact.add(-force, torque);
  if (view.virial) add_virial(view, i, branch, force);
}

void BodyBatch::add_virial(const BodyParticleView &view, int atom, const Vector3<double> &b,
                           const Vector3<double> &f)
{
  double *const v = view.virial + 6L * atom;
  v[0] += b.x * f.x;
  v[1] += b.y * f.y;
  v[2] += b.z * f.z;
  v[3] += b.x * f.y;
  v[4] += b.x * f.z;
  v[5] += b.y * f.z;
}

void BodyBatch::record(const BodyTask &task, int lane)
{
  const Vector3<double> n = lane_of(batch.normal, lane), f = lane_of(batch.force, lane);
  const double pressed = dot(f, n);
  const Vector3<double> v = lane_of(batch.velocity, lane);
  const Vector3<double> slip = v - dot(v, n) * n - cross(lane_of(batch.spin, lane), n);
  const Vector3<double> shear =
      task.laws.distinct_law(task.laws.law_index(batch.coefficients[lane])).has_friction()
          ? -(f - pressed * n)
          : Vector3<double>{0.0, 0.0, 0.0};
  touched.push_back({part_of_lane[lane], pressed, shear, dot(shear, slip)});
}

}    // namespace Talus
