// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/body_contacts.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

Vector3<double> row(const double *rows, int i)
{
  return {rows[3L * i], rows[3L * i + 1], rows[3L * i + 2]};
}

void add(double *rows, int i, const Vector3<double> &value)
{
  rows[3L * i] += value.x;
  rows[3L * i + 1] += value.y;
  rows[3L * i + 2] += value.z;
}

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

BodyContacts::BodyContacts()
{
  batch.clear();
}

void BodyContacts::set_laws(const LawTable &table)
{
  laws = table;
  with_history = laws.has_history();
  with_onset = laws.has_onset();
}

void BodyContacts::find_candidates(const LargeBodyShape &shape, const BodyParticleView &view,
                                   const int *mask, int group, double skin)
{
  candidates.clear();
  for (int i = 0; i < view.owned; i++) {
    const bool near =
        (mask[i] & group) && shape.distance_bound(row(view.x, i)) < view.radius[i] + skin;
    if (near) candidates.push_back(i);
    if (!near) forget(i);
  }
}

void BodyContacts::forget(int i)
{
  if (with_history) history[i] = Record{};
  if (with_onset) onset[i] = Record{};
}

BodyLoad BodyContacts::compute(const LargeBodyShape &shape, const BodyParticleView &view, double dt,
                               bool advance, EnergyAccount *account)
{
  energies = account;
  if (energies) remember_velocities(view);
  BodyLoad load;
  for (int law = 0; law < laws.num_laws(); law++) {
    int filled = 0;
    for (const int i : candidates) {
      if (laws.law_index(laws.row(view.type[i], view.type[i])) != law) continue;
      SurfaceContact contact;
      if (!shape.touches(row(view.x, i), view.radius[i], contact)) {
        forget(i);
        continue;
      }
      add_lane(filled++, i, contact, view);
      if (filled == ContactBatch::width) {
        flush(law, filled, shape, view, dt, advance, load);
        filled = 0;
      }
    }
    if (filled) flush(law, filled, shape, view, dt, advance, load);
  }
  return load;
}

/* A fixed body is infinitely heavy and its surface does not move: m_eff is the mass of the
   particle, R_eff its radius. */

void BodyContacts::add_lane(int lane, int i, const SurfaceContact &contact,
                            const BodyParticleView &view)
{
  const bool replaced = view.mass_override && view.mass_override[i] > 0.0;
  atom_of_lane[lane] = i;
  set_lane(batch.normal, lane, contact.normal);
  batch.overlap[lane] = contact.overlap;
  set_lane(batch.velocity, lane, row(view.v, i));
  set_lane(batch.spin, lane, view.radius[i] * row(view.omega, i));
  batch.inverse_mass[lane] = 1.0 / (replaced ? view.mass_override[i] : view.mass[i]);
  batch.inverse_radius[lane] = 1.0 / view.radius[i];
  batch.coefficients[lane] = laws.row(view.type[i], view.type[i]);
  if (laws.has_resistance()) {
    // the body is flat on the scale of the contact: the circle in which it cuts the sphere
    const double r = view.radius[i], d = contact.overlap;
    set_lane(batch.relative_spin, lane, row(view.omega, i));
    batch.circle[lane] = std::sqrt(std::max(2.0 * r * d - d * d, 0.0));
  }
  if (!with_history) return;
  const Record &h = history[i];
  set_lane(batch.displacement, lane, {h.c[0], h.c[1], h.c[2]});
  batch.at_limit[lane] = h.c[3];
  if (!with_onset) return;
  const Record &o = onset[i];
  set_lane(batch.onset, lane, {o.c[0], o.c[1], o.c[2]});
}

void BodyContacts::flush(int law, int count, const LargeBodyShape &shape,
                         const BodyParticleView &view, double dt, bool advance, BodyLoad &load)
{
  // lanes behind the last contact hold older, finite contacts: computed, but not used
  const int end = (count + lanes - 1) / lanes * lanes;
  laws.kernel(law, advance)(batch, 0, end, laws.coefficients(), dt);
  for (int lane = 0; lane < count; lane++) {
    apply(lane, laws.distinct_law(law), shape, view, load);
    if (with_history && advance) keep_history(lane);
    if (energies) account_for_lane(lane, laws.distinct_law(law), view, dt);
  }
}

void BodyContacts::account_for_lane(int lane, ContactLaw law, const BodyParticleView &view,
                                    double dt)
{
  const int i = atom_of_lane[lane];
  largest_overlap = std::max(largest_overlap, batch.overlap[lane] / view.radius[i]);
  energies->add(lane_energy(law, laws.coefficients(batch.coefficients[lane]), batch, lane, dt), 1.0,
                i, view.radius[i], -1, 0.0);
}

void BodyContacts::keep_history(int lane)
{
  const int i = atom_of_lane[lane];
  const Vector3<double> d = lane_of(batch.displacement, lane), o = lane_of(batch.onset, lane);
  history[i] = {{d.x, d.y, d.z, batch.at_limit[lane]}};
  if (with_onset) onset[i] = {{o.x, o.y, o.z, 0.0}};
}

/* The reaction acts where the lever arm of the particle ends, r along the normal: so forces and
   torques of particle and body balance exactly. */

void BodyContacts::apply(int lane, ContactLaw law, const LargeBodyShape &shape,
                         const BodyParticleView &view, BodyLoad &load)
{
  const int i = atom_of_lane[lane];
  const double r = view.radius[i];
  const Vector3<double> force = lane_of(batch.force, lane);
  add(view.f, i, force);
  const Vector3<double> couple =
      law.resists ? lane_of(batch.couple, lane) : Vector3<double>{0.0, 0.0, 0.0};
  if (law.has_friction()) add(view.torque, i, couple - r * lane_of(batch.moment, lane));

  const Vector3<double> arm =
      row(view.x, i) - r * lane_of(batch.normal, lane) - shape.reference_point();
  load.force = load.force - force;
  load.torque = load.torque - cross(arm, force) - couple;
  load.contacts += 1.0;
}

void BodyContacts::remember_velocities(const BodyParticleView &view)
{
  energies->begin_step(view.owned);
  largest_overlap = 0.0;
  velocity_before.clear();
  spin_before.clear();
  for (const int i : candidates) {
    velocity_before.push_back(row(view.v, i));
    spin_before.push_back(row(view.omega, i));
  }
}

void BodyContacts::account_for_move(const BodyParticleView &view, double dt,
                                    EnergyAccount &to) const
{
  for (std::size_t n = 0; n < candidates.size(); n++) {
    const int i = candidates[n];
    to.move(i, dt, 0.5 * (velocity_before[n] + row(view.v, i)),
            0.5 * (spin_before[n] + row(view.omega, i)));
  }
  to.end_step();
}

double BodyContacts::memory_usage() const
{
  return static_cast<double>((history.capacity() + onset.capacity()) * sizeof(Record) +
                             candidates.capacity() * sizeof(int));
}

}    // namespace Talus
