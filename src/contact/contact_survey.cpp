// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What ContactPipeline answers about the contacts of its last compute(): diagnostics, not part of a
// step.

#include "contact/contact_pipeline.h"

#include <algorithm>
#include <cmath>

namespace Talus {

double ContactPipeline::share_of_pair(std::int64_t pair) const
{
  const bool both = pairs.is_owned(pairs.atom_of_slot[pairs.first[pair]]) &&
                    pairs.is_owned(pairs.atom_of_slot[pairs.second[pair]]);
  return both ? 1.0 : 0.5;
}

double ContactPipeline::count_contacts() const
{
  double count = 0.0;
  for (std::int64_t n = 0; n < touching_pairs; n++) count += share_of_pair(contact_list[n]);
  return count;
}

double ContactPipeline::count_candidates() const
{
  double count = 0.0;
  for (std::int64_t c = 0; c < pairs.num_pairs(); c++) count += share_of_pair(c);
  return count;
}

void ContactPipeline::account_for_move(const double *v, const double *omega, double dt,
                                       EnergyAccount &to) const
{
  for (int s = 0; s < pairs.num_particles(); s++) {
    const int a = pairs.atom_of_slot[s];
    if (!pairs.is_owned(a)) continue;
    const double *before = particles.velocity[s].c, *now = v + 3L * a;
    Vector3<double> spin{0.0, 0.0, 0.0};
    if (with_friction) {
      const double *w = particles.spin[s].c, *w_now = omega + 3L * a;
      spin = {0.5 * (w[0] * w[3] + w_now[0]), 0.5 * (w[1] * w[3] + w_now[1]),
              0.5 * (w[2] * w[3] + w_now[2])};
    }
    to.move(s, dt,
            {0.5 * (before[0] + now[0]), 0.5 * (before[1] + now[1]), 0.5 * (before[2] + now[2])},
            spin);
  }
  to.end_step();
}

double ContactPipeline::overlap_of(std::int64_t pair) const
{
  const double *a = particles.position[pairs.first[pair]].c,
               *b = particles.position[pairs.second[pair]].c;
  const double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
  return a[3] + b[3] - std::sqrt(dx * dx + dy * dy + dz * dz);
}

double ContactPipeline::largest_overlap_ratio() const
{
  double largest = 0.0;
  for (std::int64_t n = 0; n < touching_pairs; n++) {
    const std::uint32_t pair = contact_list[n];
    const double smaller = std::min(particles.position[pairs.first[pair]].c[3],
                                    particles.position[pairs.second[pair]].c[3]);
    largest = std::max(largest, overlap_of(pair) / smaller);
  }
  return largest;
}

double ContactPipeline::smallest_contact_period() const
{
  double smallest = 0.0;
  for (std::int64_t n = 0; n < touching_pairs; n++) {
    const std::uint32_t pair = contact_list[n];
    const int i = pairs.first[pair], j = pairs.second[pair], row = row_of_pair(pair);
    const double inverse_mass = particles.velocity[i].c[3] + particles.velocity[j].c[3];
    if (!(inverse_mass > 0.0)) continue;
    const double ri = particles.position[i].c[3], rj = particles.position[j].c[3];
    const double k = tangent_stiffness(laws.law(row), laws.coefficients(row), overlap_of(pair),
                                       1.0 / inverse_mass, ri * rj / (ri + rj));
    if (!(k > 0.0)) continue;
    const double period = std::sqrt(1.0 / (inverse_mass * k));
    smallest = smallest > 0.0 ? std::min(smallest, period) : period;
  }
  return smallest;
}

double ContactPipeline::largest_relative_speed() const
{
  double largest = 0.0;
  for (std::int64_t c = 0; c < pairs.num_pairs(); c++) {
    const double *a = particles.velocity[pairs.first[c]].c,
                 *b = particles.velocity[pairs.second[c]].c;
    const double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
    largest = std::max(largest, dx * dx + dy * dy + dz * dz);
  }
  return std::sqrt(largest);
}

}    // namespace Talus
