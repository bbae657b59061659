// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "bonds/rotational_bonds.h"

namespace Talus {

namespace {

TALUS_INLINE Quaternion<Vec8> turns_of(const double *orientation, const BondEnds *bonds,
                                       int BondEnds::*side)
{
  const EightRows q = lanes_of([=](int k) {
    return Memory<Vec4>::load_anywhere(orientation + 4 * static_cast<std::int64_t>(bonds[k].*side));
  });
  return {q.number[0], q.number[1], q.number[2], q.number[3]};
}

TALUS_INLINE FourWays<Vec8> in_lanes(const FourWays<double> &one)
{
  return {splat<Vec8>(one.normal), splat<Vec8>(one.shear), splat<Vec8>(one.twist),
          splat<Vec8>(one.bend)};
}

}    // namespace

/* ---------------------------------------------------------------------- */

void RotationalBonds::compute(const BondedParticles &particles, double dt, int threads)
{
  const bool of_particle = model.frame == BondFrame::PARTICLE;
  const bool by_rates = model.damping == BondDamping::RATE;
  if (of_particle && by_rates)
    compute_all<BondFrame::PARTICLE, BondDamping::RATE>(particles, dt, threads);
  else if (of_particle)
    compute_all<BondFrame::PARTICLE, BondDamping::DEM>(particles, dt, threads);
  else if (by_rates)
    compute_all<BondFrame::AVERAGE, BondDamping::RATE>(particles, dt, threads);
  else
    compute_all<BondFrame::AVERAGE, BondDamping::DEM>(particles, dt, threads);
}

template <BondFrame frame, BondDamping damping>
void RotationalBonds::compute_all(const BondedParticles &particles, double dt, int threads)
{
  find_loads(threads, [&](const EightBonds &eight) {
    return loads_of<frame, damping>(eight, particles, 1.0 / dt);
  });
}

/* Most often all eight are of one type. */

BondCoeffs<Vec8> RotationalBonds::coeffs_of(const EightBonds &eight) const
{
  const BondEnds *const ends = eight.ends;
  const BondCoeffs<double> *const table = model.coeffs.data();
  if (eight.same_type()) {
    const BondCoeffs<double> &one = table[ends->type];
    return {in_lanes(one.stiffness), in_lanes(one.limit), in_lanes(one.damping)};
  }
  const auto ways = [=](FourWays<double> BondCoeffs<double>::*which) {
    const EightRows rows = lanes_of([=](int k) {
      const FourWays<double> &one = table[ends[k].type].*which;
      return four(one.normal, one.shear, one.twist, one.bend);
    });
    return FourWays<Vec8>{rows.number[0], rows.number[1], rows.number[2], rows.number[3]};
  };
  return {ways(&BondCoeffs<double>::stiffness), ways(&BondCoeffs<double>::limit),
          ways(&BondCoeffs<double>::damping)};
}

template <BondFrame frame, BondDamping damping>
EightLoads RotationalBonds::loads_of(const EightBonds &eight, const BondedParticles &particles,
                                     double inverse_dt) const
{
  const BondEnds *const ends = eight.ends;
  const auto history = [&](int k) { return particles.history + particles.stride * eight.place(k); };

  BondedPair<Vec8> pairs;
  const EightRows rest = lanes_of([&](int k) { return Memory<Vec4>::load_anywhere(history(k)); });
  pairs.length_at_rest = rest.number[0];
  const Vec8 sign = splat<Vec8>(particles.sign);
  pairs.at_rest = {sign * rest.number[1], sign * rest.number[2], sign * rest.number[3]};
  pairs.separation = differences(particles.position, ends);
  pairs.turn1 = turns_of(particles.orientation, ends, &BondEnds::first);
  pairs.turn2 = turns_of(particles.orientation, ends, &BondEnds::second);
  pairs.velocity = differences(particles.velocity, ends);
  pairs.omega = differences(particles.omega, ends);
  if constexpr (damping == BondDamping::DEM) {
    pairs.sum_of_omegas = vector_of(lanes_of([&](int k) {
      return particles.omega.at(ends[k].first) + particles.omega.at(ends[k].second);
    }));
    pairs.before = BondAngles<Vec8>{};
  } else {
    pairs.sum_of_omegas = Vector3<Vec8>{};
    const EightRows before = lanes_of([&](int k) { return record_of(history(k) + 4, 0.0); });
    pairs.before = {before.number[0], before.number[1], before.number[2]};
  }

  BondCoeffs<Vec8> coeffs = coeffs_of(eight);
  if (model.per_length) {
    coeffs.stiffness.normal = coeffs.stiffness.normal / pairs.length_at_rest;
    coeffs.stiffness.shear = coeffs.stiffness.shear / pairs.length_at_rest;
  }
  const BondLoads<Vec8> found = load_bond<frame, damping>(pairs, coeffs, inverse_dt);
  if constexpr (damping == BondDamping::RATE) {
    for (int k = 0; k < eight.count; k++) {
      double *const angles = history(k) + 4;
      angles[0] = found.angles.shear[k];
      angles[1] = found.angles.bend[k];
      angles[2] = found.angles.twist[k];
    }
  }

  const Vec8 one = splat<Vec8>(1.0), square = found.breaking * found.breaking;
  const Vec8 share = model.smooth ? one - square * square : one;
  EightLoads to;
  to.force = share * found.force;
  to.torque1 = share * found.torque1;
  to.torque2 = share * found.torque2;
  to.energy = found.energy;
  to.stored = larger(share, Vec8{}) * found.stored;
  to.breaking = model.breaks ? bits_of(found.breaking >= one) : 0U;
  return to;
}

}    // namespace Talus
