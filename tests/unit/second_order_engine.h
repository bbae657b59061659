// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Spheres and planes of second_order_reference.h with the laws of the engine: every pair in every
// step, the contacts side by side in one batch.

#ifndef TALUS_TESTS_SECOND_ORDER_ENGINE_H
#define TALUS_TESTS_SECOND_ORDER_ENGINE_H

#include "second_order_reference.h"

#include "base/words.h"
#include "laws/contact_words.h"
#include "laws/intersection_radius.h"
#include "laws/second_order_laws.h"
#include "laws/tangential/end_of_contact.h"
#include "material/contact_spec.h"
#include "material/law_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace Engine {

using namespace second_order;

using Talus::ContactBatch;

inline Talus::ContactSpec spec_of(const std::string &words)
{
  std::vector<std::string> list;
  std::istringstream stream(words);
  for (std::string word; stream >> word;) list.push_back(word);
  std::vector<const char *> arg;
  for (const std::string &word : list) arg.push_back(word.c_str());
  Talus::Words reader("law", static_cast<int>(arg.size()), arg.data(), 0,
                      [](int, const std::string &text) { throw std::runtime_error(text); });
  return Talus::parse_contact(reader, 1.0);
}

inline Talus::ContactCoefficients row_of(const Talus::ContactSpec &spec)
{
  return Talus::contact_coefficients(spec, spec, Talus::FrictionMix::MINIMUM);
}

inline std::string reason_against(const std::string &words)
{
  const Talus::ContactSpec spec = spec_of(words);
  return Talus::reason_against_second_order(spec.law, row_of(spec));
}

/// Kernels of a law, for integrators of second order or as it is.
struct Kernels {
  Talus::ContactLaw law;
  Talus::ContactCoefficients row;
  Talus::ContactKernel advancing, reading;
  bool second_order;

  explicit Kernels(const std::string &words, bool second = true) : second_order(second)
  {
    Talus::ContactSpec spec = spec_of(words);
    if (second) spec.law = Talus::second_order_law(spec.law);
    law = spec.law;
    row = row_of(spec);
    advancing = Talus::contact_kernel(law, true, true);
    reading = Talus::contact_kernel(law, true, false);
  }
};

/// The leapfrog of `start half`, also that of `order 2`.
class Motion {
 public:
  /// From the state of `start` on for `time` in `steps` steps; its law counts for nothing.
  /// `repeats`: after each step the forces are found once more as in a set-up, see sets_up_alike().
  Motion(const Kernels &law_kernels, const System &start, double time, int steps,
         bool repeats = false) :
      kernels(law_kernels),
      gravity(start.gravity), particles(start.particles), planes(start.planes), dt(time / steps)
  {
    contacts.resize(particles.size() * (particles.size() + planes.size()));
    batch.clear();
    for (auto *vectors :
         {batch.normal, batch.velocity, batch.surface_rotation, batch.relative_omega,
          batch.velocity_change, batch.rotation_change, batch.omega_change})
      for (int d = 0; d < 3; d++) filled.push_back(vectors[d]);
    for (double *value :
         {batch.arm_loss, batch.arm_difference, batch.intersection_radius, batch.overlap,
          batch.inverse_mass, batch.inverse_radius, batch.inverse_distance})
      filled.push_back(value);
    for (auto &value : batch.history) filled.push_back(value);
    compute(false);
    for (int n = 0; n < steps; n++) {
      const double kick = lag + 0.5 * dt;
      lag = 0.5 * dt;
      for (Particle &p : particles) {
        p.v = p.v + kick * p.a;
        p.w = p.w + kick * p.alpha;
        p.x = p.x + dt * p.v;
      }
      if (repeats) before = particles;
      compute(true);
      if (repeats) set_up_again();
    }
    for (Particle &p : particles) {
      p.v = p.v + lag * p.a;
      p.w = p.w + lag * p.alpha;
    }
  }

  const std::vector<Particle> &result() const { return particles; }
  /// A set-up at any step has found the same forces, bit for bit, and left the histories alone.
  bool sets_up_alike() const { return alike; }

 private:
  struct Contact {
    bool touches = false;
    double history[ContactBatch::history_size] = {};
  };
  struct Lane {
    Contact *contact;
    Particle *i, *j;    // j: nullptr for a plane
    Vec r;              // from j or the plane to i
  };

  static void set(double (&to)[3][ContactBatch::width], std::size_t lane, Vec v)
  {
    for (int d = 0; d < 3; d++) to[d][lane] = v[d];
  }
  static Vec get(const double (&from)[3][ContactBatch::width], std::size_t lane)
  {
    return {from[0][lane], from[1][lane], from[2][lane]};
  }

  void compute(bool advance)
  {
    for (Particle &p : particles) p.force = p.torque = Vec{};
    std::size_t place = 0;
    for (std::size_t i = 0; i < particles.size(); i++) {
      for (std::size_t j = 0; j < i; j++)
        meet(contacts[place++], particles[j], &particles[i], particles[j].x - particles[i].x,
             advance);
      for (const Plane &p : planes)
        meet(contacts[place++], particles[i], nullptr,
             inner(particles[i].x - p.point, p.normal) * p.normal, advance);
    }
    if (!used.empty()) flush(advance);
    for (Particle &p : particles) {
      p.a = gravity + (1.0 / p.mass) * p.force;
      p.alpha = (1.0 / p.inertia()) * p.torque;
    }
  }

  static double square(double a) { return a * a; }

  /// How far a contact lasts beyond zero overlap.
  double beyond(const Particle &i, const Particle *j) const
  {
    const double radius = j ? i.radius * j->radius / (i.radius + j->radius) : i.radius;
    return Talus::pulloff_distance_of(kernels.law, kernels.row, radius);
  }

  void meet(Contact &contact, Particle &i, Particle *j, Vec r, bool advance)
  {
    const double rj = j ? j->radius : 0.0, reach = i.radius + rj;
    const double squared = inner(r, r);
    if (squared >= reach * reach) {
      const bool lasts = kernels.second_order ? Talus::has_just_ended(contact.history[3], advance)
                                              : squared < square(reach + beyond(i, j));
      if (!contact.touches || !lasts) {
        contact = Contact{};
        return;
      }
    }
    contact.touches = true;
    used.push_back({&contact, &i, j, r});
    if (used.size() == ContactBatch::width) flush(advance);
  }

  void fill(std::size_t k, const Lane &lane)
  {
    const Particle none{}, &i = *lane.i, &other = lane.j ? *lane.j : none;
    const double rj = lane.j ? other.radius : 0.0, mass_j = lane.j ? 1.0 / other.mass : 0.0;
    const double reach = i.radius + rj, distance = norm(lane.r), d = reach - distance;
    set(batch.normal, k, (1.0 / distance) * lane.r);
    set(batch.velocity, k, i.v - other.v);
    set(batch.surface_rotation, k, i.radius * i.w + rj * other.w);
    set(batch.relative_omega, k, i.w - other.w);
    set(batch.velocity_change, k, lag * (i.a - other.a));
    set(batch.rotation_change, k, lag * (i.radius * i.alpha + rj * other.alpha));
    set(batch.omega_change, k, lag * (i.alpha - other.alpha));
    batch.arm_loss[k] = lane.j ? d / reach : 0.0;
    batch.arm_difference[k] = lane.j ? 0.5 * batch.arm_loss[k] * (rj - i.radius) : 0.0;
    const double in_plane = 2.0 * i.radius * d - d * d;
    batch.intersection_radius[k] = lane.j ? Talus::intersection_radius_of(i.radius, rj, d)
                                          : std::sqrt(std::max(in_plane, 0.0));
    batch.lag = lag;
    batch.overlap[k] = d;
    batch.inverse_mass[k] = 1.0 / i.mass + mass_j;
    batch.inverse_radius[k] = 1.0 / i.radius + (lane.j ? 1.0 / rj : 0.0);
    batch.inverse_distance[k] = lane.j ? 1.0 / distance : 0.0;
    for (int n = 0; n < ContactBatch::history_size; n++)
      batch.history[n][k] = lane.contact->history[n];
  }

  void flush(bool advance)
  {
    const int end =
        (static_cast<int>(used.size()) + Talus::lanes - 1) / Talus::lanes * Talus::lanes;
    // lanes without a contact have a copy of the last one, as in a ContactChunk
    for (std::size_t k = 0; k < used.size(); k++) fill(k, used[k]);
    for (double *value : filled)
      std::fill(value + used.size(), value + end, value[used.size() - 1]);
    (advance ? kernels.advancing : kernels.reading)(batch, 0, end, &kernels.row, dt);
    for (std::size_t k = 0; k < used.size(); k++) {
      const Lane &lane = used[k];
      for (int n = 0; n < ContactBatch::history_size && advance; n++)
        lane.contact->history[n] = batch.history[n][k];
      const Vec force = get(batch.force, k);
      const Vec torque_per_radius =
          kernels.law.has_friction() ? get(batch.torque_per_radius, k) : Vec{};
      const Vec twist = kernels.law.twists() ? get(batch.twisting_torque, k) : Vec{};
      lane.i->force = lane.i->force + force;
      lane.i->torque = lane.i->torque - lane.i->radius * torque_per_radius + twist;
      if (!lane.j) continue;
      lane.j->force = lane.j->force - force;
      lane.j->torque = lane.j->torque - lane.j->radius * torque_per_radius - twist;
    }
    used.clear();
  }

  void set_up_again()
  {
    const std::vector<Particle> after = std::exchange(particles, before);
    const std::vector<Contact> known = contacts;
    compute(false);
    for (std::size_t n = 0; n < after.size(); n++)
      alike = alike && particles[n].a == after[n].a && particles[n].alpha == after[n].alpha;
    for (std::size_t n = 0; n < known.size(); n++)
      alike = alike && std::equal(std::begin(known[n].history), std::end(known[n].history),
                                  contacts[n].history);
    particles = after;
  }
  const Kernels &kernels;
  Vec gravity;
  std::vector<Particle> particles, before;
  std::vector<Plane> planes;
  std::vector<Contact> contacts;
  ContactBatch batch;
  std::vector<Lane> used;
  std::vector<double *> filled;    // what fill() fills, by lane
  double dt, lag = 0.0;
  bool alike = true;
};

}    // namespace Engine

#endif
