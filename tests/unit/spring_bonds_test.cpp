// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Springs between particles: loads one by one as the style of LAMMPS has them, their energy, volumes, what breaks, and sums
// that do not depend on lists and threads.

#include "bonds/spring_bonds.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

using namespace Talus;

namespace {

const SpringCoeffs<double> coeffs{3.0, 0.3, 0.4, 0.7};

/// The force on the first of two along the line from the second one, as LAMMPS computes it, one step after another.
double slow_force(const SpringPair<double> &p, const SpringCoeffs<double> &c, bool smooth)
{
  const double r = length(p.separation), r0 = p.length_at_rest, e = (r - r0) / r0;
  double f = -c.stiffness * (r - r0);
  f += c.of_volume * (p.volume_strain - e);
  f -= c.damping * dot(p.separation, p.velocity) / r;
  if (smooth) f *= 1.0 - std::pow(e / c.limit, 8);
  return f;
}

SpringPair<double> random_pair(RandomSource &random)
{
  const auto vector = [&] {
    const auto v = random.in_cube(1.0);
    return Vector3<double>{v[0] + 0.5, v[1], v[2]};
  };
  SpringPair<double> p{0.0, vector(), vector(), random.uniform(-0.1, 0.1)};
  p.length_at_rest = length(p.separation) * random.uniform(0.8, 1.2);
  return p;
}

/// Particles in the unit cube, each bonded to some others; lengths at rest are nearly those at present.
struct Net {
  static constexpr int count = 60;
  std::vector<double> x, v, lengths;
  std::vector<std::int64_t> tag;
  std::vector<BondEnds> bonds;

  explicit Net(unsigned seed)
  {
    RandomSource random(seed);
    for (int i = 0; i < count; i++) {
      tag.push_back((37 * i) % 61 + 1);
      for (std::vector<double> *rows : {&x, &v})
        for (const double number : random.in_cube(1.0)) rows->push_back(number);
    }
    for (int i = 0; i < count; i++)
      for (int j = 0; j < i; j++)
        if (random.chance(0.2)) {
          bonds.push_back({tag[i] < tag[j] ? i : j, tag[i] < tag[j] ? j : i, 1 + random.below(2)});
          lengths.push_back(length(apart(x, bonds.back())) * random.uniform(0.8, 1.2));
        }
  }

  static Vector3<double> apart(const std::vector<double> &rows, const BondEnds &b)
  {
    const double *const p = &rows[3 * b.first], *const q = &rows[3 * b.second];
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  }

  double strain(std::size_t b) const
  {
    return (length(apart(x, bonds[b])) - lengths[b]) / lengths[b];
  }

  void shuffle(unsigned seed)
  {
    RandomSource random(seed);
    for (std::size_t n = bonds.size(); n > 1; n--) {
      const std::size_t m = random.below(static_cast<int>(n));
      std::swap(bonds[n - 1], bonds[m]);
      std::swap(lengths[n - 1], lengths[m]);
    }
  }
};

SpringModel model_of(bool smooth, bool per_length, int dimension = 3)
{
  return {per_length, smooth, dimension, {{}, coeffs, {5.0, 0.25, 0.1, 0.2}}};
}

void add(const SpringBonds &all, std::vector<double> &forces, int threads)
{
  ParticleView sums{};
  sums.f = forces.data();
  all.add_to({Net::count, sums, nullptr}, threads);
}

struct Found {
  std::vector<double> forces, volumes;
  std::vector<int> broken;
};

Found computed(const Net &net, const SpringModel &model, bool breaks, int threads, int dropped = -1)
{
  SpringBonds all;
  all.set_model(model);
  all.set_bonds(net.bonds, Net::count, net.tag.data());
  if (dropped >= 0) all.drop(dropped);
  Found found{std::vector<double>(3 * Net::count, 0.5), std::vector<double>(Net::count), {}};
  all.sum_volumes({net.x.data()}, found.volumes.data(), threads);
  const std::vector<double> at_rest(Net::count, 10.0);
  all.compute(
      {{net.x.data()}, {net.v.data()}, net.lengths.data(), found.volumes.data(), at_rest.data()},
      breaks, threads);
  all.for_each_broken([&](int b) { found.broken.push_back(b); });
  add(all, found.forces, threads);
  return found;
}

}    // namespace

TEST(SpringBond, LoadsAreThoseOfTheFormula)
{
  RandomSource random(3);
  for (int n = 0; n < 200; n++)
    for (const bool smooth : {false, true}) {
      const SpringPair<double> p = random_pair(random);
      const SpringLoads<double> found = load_spring(p, coeffs, smooth);
      const double r = length(p.separation), expected = slow_force(p, coeffs, smooth);
      EXPECT_NEAR(found.force.x, expected * p.separation.x / r, 1e-14);
      EXPECT_NEAR(found.force.y, expected * p.separation.y / r, 1e-14);
      EXPECT_NEAR(found.force.z, expected * p.separation.z / r, 1e-14);
      EXPECT_NEAR(found.strain, r / p.length_at_rest - 1.0, 1e-15);
    }
}

TEST(SpringBond, EnergyIsTheWorkOfTheForce)
{
  const SpringCoeffs<double> elastic{3.0, 0.3, 0.0, 0.0};
  constexpr double step = 1e-5;
  SpringPair<double> p{1.0, {0.6, 0.8, 0.3}, {}, 0.0};
  const SpringLoads<double> now = load_spring(p, elastic, false);
  p.separation.x += step;
  const double after = load_spring(p, elastic, false).energy;
  p.separation.x -= 2.0 * step;
  const double before = load_spring(p, elastic, false).energy;
  EXPECT_NEAR((after - before) / (2.0 * step), -now.force.x, 1e-9);
}

TEST(SpringBonds, SumsAreThoseOfAPlainLoop)
{
  const Net net(9);
  ASSERT_NE(net.bonds.size() % lanes, 0U);
  for (const int dimension : {2, 3})
    for (const bool per_length : {false, true}) {
      const SpringModel model = model_of(true, per_length, dimension);
      std::vector<double> volumes(Net::count), forces(3 * Net::count, 0.5);
      for (const BondEnds &b : net.bonds)
        for (const int i : {b.first, b.second})
          volumes[i] += std::pow(length(Net::apart(net.x, b)), dimension);
      for (std::size_t n = 0; n < net.bonds.size(); n++) {
        const BondEnds &b = net.bonds[n];
        SpringCoeffs<double> c = model.coeffs[b.type];
        if (per_length) c.stiffness /= net.lengths[n];
        const double strain =
            std::pow((volumes[b.first] + volumes[b.second]) / 20.0, 1.0 / dimension) - 1.0;
        const Vector3<double> d = Net::apart(net.x, b);
        const double f =
            slow_force({net.lengths[n], d, Net::apart(net.v, b), strain}, c, true) / length(d);
        const double along[] = {f * d.x, f * d.y, f * d.z};
        for (int k = 0; k < 3; k++) {
          forces[3 * b.first + k] += along[k];
          forces[3 * b.second + k] -= along[k];
        }
      }
      const Found found = computed(net, model, false, 2);
      EXPECT_TRUE(found.broken.empty());
      for (int i = 0; i < Net::count; i++) {
        EXPECT_NEAR(found.volumes[i], volumes[i], 1e-12);
        for (int k = 3 * i; k < 3 * i + 3; k++) EXPECT_NEAR(found.forces[k], forces[k], 1e-12);
      }
    }
}

TEST(SpringBonds, SumsDoNotDependOnTheListAndThreads)
{
  Net net(5);
  const SpringModel model = model_of(true, false);
  const Found expected = computed(net, model, false, 1);
  for (const int threads : {2, 3}) {
    net.shuffle(threads);
    const Found found = computed(net, model, false, threads);
    EXPECT_EQ(found.forces, expected.forces);
    EXPECT_EQ(found.volumes, expected.volumes);
  }
}

TEST(SpringBonds, WhatIsDroppedIsAsIfItWereNotThere)
{
  Net net(6);
  const SpringModel model = model_of(true, false);
  const Found without = computed(net, model, false, 1, static_cast<int>(net.bonds.size()) - 1);
  net.bonds.pop_back();
  net.lengths.pop_back();
  const Found expected = computed(net, model, false, 1);
  EXPECT_EQ(without.forces, expected.forces);
  EXPECT_EQ(without.volumes, expected.volumes);
}

TEST(SpringBonds, BreakBeyondTheirLimit)
{
  const Net net(7);
  SpringModel model = model_of(false, false);
  model.coeffs[1].limit = 0.1;
  model.coeffs[2].limit = 0.2;
  std::vector<int> expected;
  for (std::size_t n = 0; n < net.bonds.size(); n++)
    if (std::fabs(net.strain(n)) > model.coeffs[net.bonds[n].type].limit)
      expected.push_back(static_cast<int>(n));
  EXPECT_GT(expected.size(), 20U);
  EXPECT_EQ(computed(net, model, true, 2).broken, expected);
  EXPECT_TRUE(computed(net, model, false, 2).broken.empty());
}

/* Lengths and volumes have the same strain then. */

TEST(SpringBonds, VolumesGiveNoForceWhereAllIsStretchedAlike)
{
  const Net net(8);
  for (const int dimension : {2, 3}) {
    SpringModel model = model_of(false, false, dimension);
    for (SpringCoeffs<double> &c : model.coeffs) c.stiffness = c.damping = 0.0;
    SpringBonds all;
    all.set_model(model);
    all.set_bonds(net.bonds, Net::count, net.tag.data());
    std::vector<double> lengths, now(Net::count), at_rest(Net::count), f(3 * Net::count);
    std::vector<int> each;
    for (const BondEnds &b : net.bonds) {
      each.push_back(static_cast<int>(lengths.size()));
      lengths.push_back(length(Net::apart(net.x, b)) / 1.1);
    }
    all.sum_volumes({net.x.data()}, now.data(), 1);
    all.add_volumes_at_rest(each, lengths.data(), 1.0, at_rest.data(), 2);
    all.compute({{net.x.data()}, {net.v.data()}, lengths.data(), now.data(), at_rest.data()}, false,
                1);
    add(all, f, 1);
    for (const double number : f) EXPECT_NEAR(number, 0.0, 1e-14);
    EXPECT_NEAR(now[0] / at_rest[0], std::pow(1.1, dimension), 1e-13);
    all.add_volumes_at_rest(each, lengths.data(), -1.0, at_rest.data(), 1);
    for (const double number : at_rest) EXPECT_EQ(number, 0.0);
  }
}
