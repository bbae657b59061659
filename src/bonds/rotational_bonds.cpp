// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "bonds/rotational_bonds.h"

#include "base/in_parallel.h"
#include "base/lanes.h"
#include "particles/record.h"

#include <algorithm>
#include <tuple>

namespace Talus {

namespace {

/// Lane k: the numbers of row(k), a Vec4.
template <class Row> TALUS_INLINE EightRows lanes_of(Row row)
{
  EightRows to;
  for (int k = 0; k < 4; k++) to.number[k] = join(row(k), row(k + 4));
  transpose(to.number[0], to.number[1], to.number[2], to.number[3]);
  return to;
}

TALUS_INLINE Vector3<Vec8> vector_of(const EightRows &rows)
{
  return {rows.number[0], rows.number[1], rows.number[2]};
}

TALUS_INLINE Vec4 row_at(const double *rows, int place)
{
  return record_of(rows + 3 * static_cast<std::int64_t>(place), 0.0);
}

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

void RotationalBonds::set_bonds(const std::vector<BondEnds> &all, int owned,
                                const std::int64_t *tag)
{
  num_bonds = static_cast<int>(all.size());
  bonds = all;
  while (bonds.size() % lanes != 0) bonds.push_back(bonds.back());
  loads.resize(bonds.size());

  sides_begin.assign(owned + 1L, 0);
  const auto for_each_side = [&](auto visit) {
    for (int b = 0; b < num_bonds; b++)
      for (const bool first : {true, false})
        if (const int i = first ? all[b].first : all[b].second; i < owned) visit(i, Side{b, first});
  };
  for_each_side([&](int i, Side) { sides_begin[i + 1L]++; });
  for (int i = 0; i < owned; i++) sides_begin[i + 1L] += sides_begin[i];
  sides.resize(sides_begin[owned]);
  std::vector<std::uint32_t> next = sides_begin;
  for_each_side([&](int i, Side side) { sides[next[i]++] = side; });
  const auto order = [&](const Side &s) {
    const BondEnds &b = all[s.bond];
    return std::make_tuple(tag[s.first ? b.second : b.first], b.type);
  };
  for (int i = 0; i < owned; i++)
    std::sort(sides.begin() + sides_begin[i], sides.begin() + sides_begin[i + 1L],
              [&](const Side &a, const Side &b) { return order(a) < order(b); });
}

void RotationalBonds::drop(int b)
{
  bonds[b].type = 0;
  loads[b] = {};
}

double RotationalBonds::memory_usage() const
{
  return static_cast<double>(
      bonds.capacity() * sizeof(BondEnds) + loads.capacity() * sizeof(Loads) +
      sides_begin.capacity() * sizeof(std::uint32_t) + sides.capacity() * sizeof(Side));
}

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
  broken.resize(threads);
  const std::int64_t blocks = static_cast<std::int64_t>(bonds.size()) / lanes;
  in_ranges(blocks, threads, [&](int thread, int begin, int end) {
    std::vector<int> &breaking = broken[thread];
    breaking.clear();
    for (int block = begin; block < end; block++)
      compute_eight<frame, damping>(block * lanes, particles, 1.0 / dt, breaking);
  });
}

/* Most often all eight are of one type. */

BondCoeffs<Vec8> RotationalBonds::coeffs_of(int begin) const
{
  const BondEnds *const eight = &bonds[begin];
  const BondCoeffs<double> *const table = model.coeffs.data();
  const bool same =
      std::all_of(eight, eight + lanes, [=](const BondEnds &b) { return b.type == eight->type; });
  if (same) {
    const BondCoeffs<double> &one = table[eight->type];
    return {in_lanes(one.stiffness), in_lanes(one.limit), in_lanes(one.damping)};
  }
  const auto ways = [=](FourWays<double> BondCoeffs<double>::*which) {
    const EightRows rows = lanes_of([=](int k) {
      const FourWays<double> &one = table[eight[k].type].*which;
      return four(one.normal, one.shear, one.twist, one.bend);
    });
    return FourWays<Vec8>{rows.number[0], rows.number[1], rows.number[2], rows.number[3]};
  };
  return {ways(&BondCoeffs<double>::stiffness), ways(&BondCoeffs<double>::limit),
          ways(&BondCoeffs<double>::damping)};
}

template <BondFrame frame, BondDamping damping>
void RotationalBonds::compute_eight(int begin, const BondedParticles &particles, double inverse_dt,
                                    std::vector<int> &breaking)
{
  const BondEnds *const eight = &bonds[begin];
  const int count = std::min(lanes, num_bonds - begin);
  const auto history = [&](int k) {
    return particles.history +
           static_cast<std::int64_t>(particles.stride) * (begin + std::min(k, count - 1));
  };
  const auto difference = [=](const double *rows) {
    return vector_of(lanes_of(
        [=](int k) { return row_at(rows, eight[k].first) - row_at(rows, eight[k].second); }));
  };

  BondedPair<Vec8> pairs;
  const EightRows rest = lanes_of([&](int k) { return Memory<Vec4>::load_anywhere(history(k)); });
  pairs.length_at_rest = rest.number[0];
  const Vec8 sign = splat<Vec8>(particles.sign);
  pairs.at_rest = {sign * rest.number[1], sign * rest.number[2], sign * rest.number[3]};
  pairs.separation = difference(particles.position);
  pairs.turn1 = turns_of(particles.orientation, eight, &BondEnds::first);
  pairs.turn2 = turns_of(particles.orientation, eight, &BondEnds::second);
  pairs.velocity = difference(particles.velocity);
  pairs.omega = difference(particles.omega);
  if constexpr (damping == BondDamping::DEM) {
    pairs.sum_of_omegas = vector_of(lanes_of([&](int k) {
      return row_at(particles.omega, eight[k].first) + row_at(particles.omega, eight[k].second);
    }));
    pairs.before = BondAngles<Vec8>{};
  } else {
    pairs.sum_of_omegas = Vector3<Vec8>{};
    const EightRows before = lanes_of([&](int k) { return record_of(history(k) + 4, 0.0); });
    pairs.before = {before.number[0], before.number[1], before.number[2]};
  }

  BondCoeffs<Vec8> coeffs = coeffs_of(begin);
  if (model.per_length) {
    coeffs.stiffness.normal = coeffs.stiffness.normal / pairs.length_at_rest;
    coeffs.stiffness.shear = coeffs.stiffness.shear / pairs.length_at_rest;
  }
  const BondLoads<Vec8> found = load_bond<frame, damping>(pairs, coeffs, inverse_dt);

  const Vec8 one = splat<Vec8>(1.0), square = found.breaking * found.breaking;
  const Vec8 share = model.smooth ? one - square * square : one;
  const auto write = [&](double(Loads::*which)[4], const Vector3<Vec8> &v, Vec8 fourth) {
    alignas(64) double vector[3][lanes], last[lanes];
    store(vector[0], share * v.x);
    store(vector[1], share * v.y);
    store(vector[2], share * v.z);
    store(last, fourth);
    for (const int k : {0, 4})
      to_rows(vector, last, k, [&](int q) { return loads[begin + k + q].*which; });
  };
  write(&Loads::force, found.force, found.breaking);
  write(&Loads::torque1, found.torque1, found.energy);
  write(&Loads::torque2, found.torque2, larger(share, Vec8{}) * found.stored);

  const unsigned over = model.breaks ? bits_of(found.breaking >= one) : 0U;
  for (int k = 0; k < count; k++) {
    const int b = begin + k;
    if (is_dropped(b)) {
      loads[b] = {};
      continue;
    }
    if (over >> k & 1U) breaking.push_back(b);
    if constexpr (damping == BondDamping::RATE) {
      double *const angles = history(k) + 4;
      angles[0] = found.angles.shear[k];
      angles[1] = found.angles.bend[k];
      angles[2] = found.angles.twist[k];
    }
  }
}

/* ---------------------------------------------------------------------- */

void RotationalBonds::add_to(double *force, double *torque, int threads) const
{
  const auto owned = static_cast<std::int64_t>(sides_begin.size()) - 1;
  in_ranges(owned, threads, [=](int, int begin, int end) {
    for (int i = begin; i < end; i++) {
      const std::uint32_t first = sides_begin[i], last = sides_begin[i + 1L];
      if (first == last) continue;
      Vec4 f{}, t{};
      for (std::uint32_t s = first; s < last; s++) {
        const Loads &of_bond = loads[sides[s].bond];
        const Vec4 on_first = load4(of_bond.force);
        f = sides[s].first ? f + on_first : f - on_first;
        t = t + load4(sides[s].first ? of_bond.torque1 : of_bond.torque2);
      }
      double *const f_of_i = force + 3L * i, *const t_of_i = torque + 3L * i;
      write_row(record_of(f_of_i, 0.0) + f, f_of_i);
      write_row(record_of(t_of_i, 0.0) + t, t_of_i);
    }
  });
}

}    // namespace Talus
