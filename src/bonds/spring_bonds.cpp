// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "bonds/spring_bonds.h"

#include "base/power.h"

namespace Talus {

namespace {

TALUS_INLINE Vec8 sum_of_both(const double *by_particle, const BondEnds *ends)
{
  return eight_numbers(
      [=](int k) { return by_particle[ends[k].first] + by_particle[ends[k].second]; });
}

}    // namespace

/* ---------------------------------------------------------------------- */

void SpringBonds::compute(const SpringParticles &particles, bool breaks, int threads)
{
  find_loads(threads, [&](const EightBonds &eight) { return loads_of(eight, particles, breaks); });
}

/* Most often all eight are of one type. */

SpringCoeffs<Vec8> SpringBonds::coeffs_of(const EightBonds &eight) const
{
  const BondEnds *const ends = eight.ends;
  const SpringCoeffs<double> *const table = model.coeffs.data();
  if (eight.same_type()) {
    const SpringCoeffs<double> &one = table[ends->type];
    return {splat<Vec8>(one.stiffness), splat<Vec8>(one.limit), splat<Vec8>(one.damping),
            splat<Vec8>(one.of_volume)};
  }
  const EightRows rows = lanes_of([=](int k) {
    const SpringCoeffs<double> &one = table[ends[k].type];
    return four(one.stiffness, one.limit, one.damping, one.of_volume);
  });
  return {rows.number[0], rows.number[1], rows.number[2], rows.number[3]};
}

EightForces SpringBonds::loads_of(const EightBonds &eight, const SpringParticles &particles,
                                  bool breaks) const
{
  const Vec8 zero{}, one = splat<Vec8>(1.0);
  SpringPair<Vec8> pairs;
  pairs.length_at_rest = eight_numbers([&](int k) { return particles.lengths[eight.place(k)]; });
  pairs.separation = differences(particles.position, eight.ends);
  pairs.velocity = differences(particles.velocity, eight.ends);
  pairs.volume_strain = zero;
  if (particles.volume) {
    const Vec8 ratio = sum_of_both(particles.volume, eight.ends) /
                       sum_of_both(particles.volume_at_rest, eight.ends);
    pairs.volume_strain = (model.dimension == 3 ? cube_root(ratio) : square_root(ratio)) - one;
  }
  SpringCoeffs<Vec8> coeffs = coeffs_of(eight);
  if (model.per_length) coeffs.stiffness = coeffs.stiffness / pairs.length_at_rest;
  const SpringLoads<Vec8> found = load_spring(pairs, coeffs, model.smooth);
  return {found.force, found.energy, larger(found.share, zero) * found.energy,
          breaks ? bits_of(magnitude(found.strain) > coeffs.limit) : 0U};
}

/* ---------------------------------------------------------------------- */

void SpringBonds::sum_volumes(const ParticleRows &position, double *volumes, int threads)
{
  volumes_of_bonds.assign(count(), 0.0);
  in_ranges(count(), threads, [&](int, int begin, int end) {
    for (int b = begin; b < end; b++) {
      if (is_dropped(b)) continue;
      const double *const x1 = position.row(bond(b).first), *const x2 =
                                                                position.row(bond(b).second);
      volumes_of_bonds[b] =
          volume_of(length(Vector3<double>{x1[0] - x2[0], x1[1] - x2[1], x1[2] - x2[2]}));
    }
  });
  for_each_sum(volumes_of_bonds.data(), threads, [=](int i, double sum) { volumes[i] = sum; });
}

void SpringBonds::add_volumes_at_rest(const std::vector<int> &of, const double *lengths,
                                      double sign, double *volumes, int threads)
{
  volumes_of_bonds.assign(count(), 0.0);
  for (const int b : of) volumes_of_bonds[b] = volume_of(lengths[b]);
  for_each_sum(volumes_of_bonds.data(), threads,
               [=](int i, double sum) { volumes[i] += sign * sum; });
}

}    // namespace Talus
