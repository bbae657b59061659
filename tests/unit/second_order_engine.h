// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Spheres and planes of second_order_twin.h with the laws of the engine: every pair in every step,
// the contacts side by side in one batch.

#ifndef TALUS_TESTS_SECOND_ORDER_ENGINE_H
#define TALUS_TESTS_SECOND_ORDER_ENGINE_H

#include "second_order_twin.h"

#include "base/words.h"
#include "laws/circle_of_intersection.h"
#include "laws/contact_words.h"
#include "laws/second_order_laws.h"
#include "laws/tangential/end_of_contact.h"
#include "material/contact_spec.h"
#include "material/law_table.h"

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace Engine {

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
  Motion(const Kernels &its, const Twin::System &start, double time, int steps) :
      kernels(its), gravity(start.gravity), particles(start.particles), planes(start.planes),
      dt(time / steps)
  {
    contacts.resize(particles.size() * (particles.size() + planes.size()));
    batch.clear();
    compute(false);
    for (int n = 0; n < steps; n++) {
      const double kick = lag + 0.5 * dt;
      lag = 0.5 * dt;
      for (Twin::Particle &p : particles) {
        p.v = p.v + kick * p.a;
        p.w = p.w + kick * p.alpha;
        p.x = p.x + dt * p.v;
      }
      compute(true);
    }
    for (Twin::Particle &p : particles) {
      p.v = p.v + lag * p.a;
      p.w = p.w + lag * p.alpha;
    }
  }

  const std::vector<Twin::Particle> &result() const { return particles; }

 private:
  struct Contact {
    bool touches = false;
    double history[ContactBatch::history_size] = {};
  };
  struct Lane {
    Contact *contact;
    Twin::Particle *i, *j;    // j: nullptr for a plane
  };

  static void set(double (&to)[3][ContactBatch::width], std::size_t lane, Twin::Vec v)
  {
    to[0][lane] = v.x;
    to[1][lane] = v.y;
    to[2][lane] = v.z;
  }
  static Twin::Vec get(const double (&from)[3][ContactBatch::width], std::size_t lane)
  {
    return {from[0][lane], from[1][lane], from[2][lane]};
  }

  void compute(bool advance)
  {
    for (Twin::Particle &p : particles) p.force = p.torque = Twin::Vec{};
    std::size_t place = 0;
    for (std::size_t i = 0; i < particles.size(); i++) {
      for (std::size_t j = 0; j < i; j++)
        meet(contacts[place++], particles[j], &particles[i], particles[j].x - particles[i].x,
             advance);
      for (const Twin::Plane &p : planes)
        meet(contacts[place++], particles[i], nullptr,
             dot(particles[i].x - p.point, p.normal) * p.normal, advance);
    }
    flush(advance);
    for (Twin::Particle &p : particles) {
      p.a = gravity + (1.0 / p.mass) * p.force;
      p.alpha = (1.0 / p.inertia()) * p.torque;
    }
  }

  void meet(Contact &contact, Twin::Particle &i, Twin::Particle *j, Twin::Vec r, bool advance)
  {
    const double rj = j ? j->radius : 0.0, reach = i.radius + rj;
    const double squared = dot(r, r);
    if (squared >= reach * reach) {
      const bool lasts = kernels.second_order && contact.touches &&
                         Talus::has_just_ended(contact.history[3], advance);
      if (!lasts) {
        contact = Contact{};
        return;
      }
    }
    const std::size_t k = used.size();
    const Twin::Particle none{}, &other = j ? *j : none;
    const double distance = std::sqrt(squared), mass_j = j ? 1.0 / j->mass : 0.0;
    set(batch.normal, k, (1.0 / distance) * r);
    set(batch.velocity, k, i.v - other.v);
    set(batch.surface_rotation, k, i.radius * i.w + rj * other.w);
    set(batch.relative_omega, k, i.w - other.w);
    set(batch.velocity_change, k, lag * (i.a - other.a));
    set(batch.rotation_change, k, lag * (i.radius * i.alpha + rj * other.alpha));
    set(batch.omega_change, k, lag * (i.alpha - other.alpha));
    batch.arm_loss[k] = j ? (reach - distance) / reach : 0.0;
    batch.arm_difference[k] = j ? 0.5 * batch.arm_loss[k] * (rj - i.radius) : 0.0;
    const double d = reach - distance, in_plane = 2.0 * i.radius * d - d * d;
    batch.circle[k] =
        j ? Talus::circle_of_intersection(i.radius, rj, d) : std::sqrt(std::max(in_plane, 0.0));
    batch.lag = lag;
    batch.overlap[k] = reach - distance;
    batch.inverse_mass[k] = 1.0 / i.mass + mass_j;
    batch.inverse_radius[k] = 1.0 / i.radius + (j ? 1.0 / rj : 0.0);
    batch.inverse_distance[k] = j ? 1.0 / distance : 0.0;
    for (int n = 0; n < ContactBatch::history_size; n++) batch.history[n][k] = contact.history[n];
    contact.touches = true;
    used.push_back({&contact, &i, j});
    if (used.size() == ContactBatch::width) flush(advance);
  }

  void flush(bool advance)
  {
    const int end =
        (static_cast<int>(used.size()) + Talus::lanes - 1) / Talus::lanes * Talus::lanes;
    (advance ? kernels.advancing : kernels.reading)(batch, 0, end, &kernels.row, dt);
    for (std::size_t k = 0; k < used.size(); k++) {
      const Lane &its = used[k];
      for (int n = 0; n < ContactBatch::history_size && advance; n++)
        its.contact->history[n] = batch.history[n][k];
      const Twin::Vec force = get(batch.force, k);
      const Twin::Vec moment = kernels.law.has_friction() ? get(batch.moment, k) : Twin::Vec{};
      const Twin::Vec twist = kernels.law.twists() ? get(batch.twisting_torque, k) : Twin::Vec{};
      its.i->force = its.i->force + force;
      its.i->torque = its.i->torque - its.i->radius * moment + twist;
      if (!its.j) continue;
      its.j->force = its.j->force - force;
      its.j->torque = its.j->torque - its.j->radius * moment - twist;
    }
    used.clear();
  }

  const Kernels &kernels;
  Twin::Vec gravity;
  std::vector<Twin::Particle> particles;
  std::vector<Twin::Plane> planes;
  std::vector<Contact> contacts;
  ContactBatch batch;
  std::vector<Lane> used;
  double dt, lag = 0.0;
};

}    // namespace Engine

#endif
