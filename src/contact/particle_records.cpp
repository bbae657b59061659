// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/particle_records.h"

#include <algorithm>

namespace Talus {

void ParticleRecords::read(const CandidateList &order, const ParticleView &host, bool spins,
                           bool couples)
{
  const int n = order.num_particles();
  position.resize(n);
  velocity.resize(n);
  spin.resize(spins ? n : 0);
  force.assign(n, Record{});
  moment.assign(spins ? n : 0, Record{});
  couple.assign(couples ? n : 0, Record{});

  for (int s = 0; s < n; s++) {
    const int a = order.atom_of_slot[s];
    const double *x = host.x + 3L * a, *v = host.v + 3L * a;
    const bool replaced = host.mass_override && host.mass_override[a] > 0.0;
    const double mass = replaced ? host.mass_override[a] : host.mass[a];
    position[s] = {{x[0], x[1], x[2], host.radius[a]}};
    velocity[s] = {{v[0], v[1], v[2], 1.0 / mass}};
  }
  if (!spins) return;
  for (int s = 0; s < n; s++) {
    const int a = order.atom_of_slot[s];
    const double *w = host.omega + 3L * a;
    const double r = host.radius[a];
    spin[s] = {{r * w[0], r * w[1], r * w[2], 1.0 / r}};
  }
}

void ParticleRecords::add_to(const CandidateList &order, double *f, double *torque) const
{
  const bool spins = !moment.empty();
  for (int s = 0; s < order.num_particles(); s++) {
    const int a = order.atom_of_slot[s];
    if (!order.is_owned(a)) continue;
    for (int d = 0; d < 3; d++) f[3L * a + d] += force[s].c[d];
    if (!spins) continue;
    const double r = position[s].c[3];
    for (int d = 0; d < 3; d++) torque[3L * a + d] -= r * moment[s].c[d];
    if (couple.empty()) continue;
    for (int d = 0; d < 3; d++) torque[3L * a + d] += couple[s].c[d];
  }
}

double ParticleRecords::memory_usage() const
{
  return static_cast<double>(sizeof(Record)) *
         (position.capacity() + velocity.capacity() + spin.capacity() + force.capacity() +
          moment.capacity() + couple.capacity());
}

}    // namespace Talus
