// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Bonds between spheres: loads against the same equations with matrices of rotation; what
// strains give by hand; momenta; and sums that do not depend on lists and threads.

#include "bonds/rotational_bonds.h"
#include "random_source.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace Talus;
using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

namespace {

constexpr double dt = 0.01;
const BondCoeffs<double> coeffs{{3.0, 2.0, 0.7, 0.9}, {5.0, 4.0, 3.0, 2.0}, {0.3, 0.2, 0.1, 0.4}};

Vector eigen(const Vector3<double> &v)
{
  return {v.x, v.y, v.z};
}
Vector3<double> talus(const Vector &v)
{
  return {v.x(), v.y(), v.z()};
}
Quaternion<double> talus(const Eigen::Quaterniond &q)
{
  return {q.w(), q.x(), q.y(), q.z()};
}

struct Turns {
  Eigen::Quaterniond first = Eigen::Quaterniond::Identity(), second = first;
};

Vector random_vector(RandomSource &random, double half)
{
  const auto v = random.in_cube(half);
  return {v[0], v[1], v[2]};
}

Eigen::Quaterniond random_turn(RandomSource &random, double most)
{
  const Vector axis = random_vector(random, 1.0);
  return Eigen::Quaterniond(Eigen::AngleAxisd(random.uniform(0.0, most), axis.normalized()));
}

BondedPair<double> random_pair(RandomSource &random, double strain, Turns &turns)
{
  const Eigen::Quaterniond common = random_turn(random, 3.0);
  turns.first = random_turn(random, strain) * common;
  turns.second = random_turn(random, strain) * common;
  const Vector rest = random_vector(random, 1.0) + Vector(1.5, 0.0, 0.0);
  BondedPair<double> b;
  b.length_at_rest = rest.norm();
  b.at_rest = talus(rest.normalized());
  b.separation = talus(common * rest + random_vector(random, strain));
  b.turn1 = talus(turns.first);
  b.turn2 = talus(turns.second);
  const Vector v = random_vector(random, 1.0), w1 = random_vector(random, 1.0),
               w2 = random_vector(random, 1.0);
  b.velocity = talus(v);
  b.omega = talus(w1 - w2);
  b.sum_of_omegas = talus(w1 + w2);
  b.before = {random.uniform(0.0, 0.1), random.uniform(0.0, 0.1), random.uniform(0.0, 0.1)};
  return b;
}

double angle_between(const Vector &a, const Vector &b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// A rotation as one about n and then one about an axis perpendicular to it.
struct Parts {
  double twist;
  Matrix twisting, swinging;

  Parts(const Matrix &rotation, const Vector &n)
  {
    const Vector moved = rotation * n;
    swinging = Eigen::Quaterniond::FromTwoVectors(n, moved).toRotationMatrix();
    twisting = swinging.transpose() * rotation;
    const Vector e = n.unitOrthogonal(), turned = twisting * e;
    twist = std::atan2(e.cross(turned).dot(n), e.dot(turned));
  }
};

struct Reference {
  Vector force, torque1, torque2;
  double breaking;
};

Reference reference_of(const BondedPair<double> &b, const Turns &turns, BondFrame frame,
                       BondDamping damping)
{
  const auto &[k, limit, g] = coeffs;
  const Vector d = eigen(b.separation), n = d.normalized(), v = eigen(b.velocity);
  const double r = d.norm();
  const bool by_rates = damping == BondDamping::RATE, of_particle = frame == BondFrame::PARTICLE;
  const Matrix first = turns.first.toRotationMatrix(), second = turns.second.toRotationMatrix();
  const Matrix mean = turns.second.slerp(0.5, turns.first).toRotationMatrix();
  const Vector rest = (of_particle ? second : mean) * (b.length_at_rest * eigen(b.at_rest));
  const double shear = angle_between(rest, d);
  const Vector w = rest.cross(d).normalized();

  double twist, bend;
  Vector twist_axis, bend_axis;
  if (of_particle) {
    const Matrix p = first * second.transpose();
    const Vector moved = p * n;
    twist = Parts(p, n).twist;
    twist_axis = n;
    bend = angle_between(n, moved);
    bend_axis = n.cross(moved).normalized();
  } else {
    const Matrix h = second * mean.transpose();
    const Parts parts(h, n);
    const Matrix inner = parts.twisting.transpose() * h;
    const Eigen::AngleAxisd swing(
        Matrix(inner * (parts.twisting * inner * parts.twisting.transpose())));
    twist = 2.0 * std::fabs(parts.twist);
    twist_axis = (parts.twist > 0.0 ? -1.0 : 1.0) * n;
    bend = swing.angle();
    bend_axis = -swing.axis();
  }

  double fr = k.normal * (r - b.length_at_rest), fs = k.shear * r * shear;
  double tt = k.twist * twist, tb = k.bend * bend, of_bending = k.shear * bend;
  double breaking =
      std::fabs(fr) / limit.normal + fs / limit.shear + tt / limit.twist + tb / limit.bend;
  if (by_rates) {
    fr += g.normal * v.dot(n);
    fs += g.shear * r * (shear - b.before.shear) / dt;
    tt += g.twist * (twist - b.before.twist) / dt;
    tb += g.bend * (bend - b.before.bend) / dt;
    of_bending += g.shear * (bend - b.before.bend) / dt;
  }
  const Vector s = (of_particle ? 0.5 * r * of_bending : 0.0) * bend_axis - fs * w;
  if (of_particle)
    breaking = fr / limit.normal + s.norm() / limit.shear + std::fabs(tt) / limit.twist +
               std::fabs(tb) / limit.bend;
  const Vector turning = tb * bend_axis + tt * twist_axis;
  Vector on_second = fr * n + n.cross(s), t1 = -0.5 * r * s - turning, t2 = -0.5 * r * s + turning;
  if (!by_rates) {
    const Vector dw = eigen(b.omega), sum = eigen(b.sum_of_omegas);
    const Vector slip = v - v.dot(n) * n - 0.5 * sum.cross(d);
    on_second += g.normal * v.dot(n) * n + g.shear * slip;
    const Vector of_slip = 0.5 * d.cross(g.shear * slip);
    const Vector roll = 0.5 * g.bend * d.cross(dw.cross(n)) + 0.5 * g.twist * dw.dot(n) * n;
    t1 += of_slip - roll;
    t2 += of_slip + roll;
  }
  return {-on_second, t1, t2, std::max(breaking, 0.0)};
}

template <BondFrame frame, BondDamping damping> void compare(double strain)
{
  RandomSource random(7);
  for (int n = 0; n < 200; n++) {
    Turns turns;
    const BondedPair<double> b = random_pair(random, strain, turns);
    const BondLoads<double> found = load_bond<frame, damping>(b, coeffs, 1.0 / dt);
    const Reference expected = reference_of(b, turns, frame, damping);
    // angles of matrices are exact to 1e-16 alone, and rates are these over dt
    const double tolerance = damping == BondDamping::RATE ? 1e-11 : 1e-13;
    EXPECT_LT((eigen(found.force) - expected.force).norm(), tolerance);
    EXPECT_LT((eigen(found.torque1) - expected.torque1).norm(), tolerance);
    EXPECT_LT((eigen(found.torque2) - expected.torque2).norm(), tolerance);
    EXPECT_NEAR(found.breaking, expected.breaking, tolerance);
    const Vector momentum =
        eigen(found.torque1) + eigen(found.torque2) + eigen(b.separation).cross(eigen(found.force));
    EXPECT_LT(momentum.norm(), 1e-13 * (1.0 + eigen(found.force).norm()));
  }
}

BondedPair<double> along_x(double length)
{
  BondedPair<double> b{};
  b.at_rest = {-1.0, 0.0, 0.0};
  b.length_at_rest = length;
  b.separation = {-length, 0.0, 0.0};
  b.turn1 = b.turn2 = {1.0, 0.0, 0.0, 0.0};
  return b;
}

}    // namespace

TEST(RotationalBond, LoadsAreThoseOfMatrices)
{
  for (const double strain : {0.01, 0.3}) {
    compare<BondFrame::PARTICLE, BondDamping::DEM>(strain);
    compare<BondFrame::PARTICLE, BondDamping::RATE>(strain);
    compare<BondFrame::AVERAGE, BondDamping::DEM>(strain);
    compare<BondFrame::AVERAGE, BondDamping::RATE>(strain);
  }
}

/* A length of 1e-3 and angles of 1e-12: nothing is lost. */

TEST(RotationalBond, TinyStrains)
{
  constexpr double length = 1e-3, angle = 1e-12;
  for (int way = 0; way < 3; way++) {
    BondedPair<double> b = along_x(length);
    if (way == 0) b.separation.y = length * angle;
    (way == 1 ? b.turn1.x : b.turn1.y) = way == 0 ? 0.0 : 0.5 * angle;
    const BondLoads<double> particle =
        load_bond<BondFrame::PARTICLE, BondDamping::DEM>(b, coeffs, 1.0 / dt);
    const BondLoads<double> average =
        load_bond<BondFrame::AVERAGE, BondDamping::DEM>(b, coeffs, 1.0 / dt);
    const FourWays<double> &k = coeffs.stiffness;
    if (way == 0) {
      EXPECT_NEAR(particle.force.y, -k.shear * length * angle, 1e-26);
      EXPECT_NEAR(average.force.y, -k.shear * length * angle, 1e-26);
    } else if (way == 1) {
      EXPECT_NEAR(particle.torque1.x, -k.twist * angle, 1e-26);
      EXPECT_NEAR(average.torque1.x, -k.twist * angle, 1e-26);
    } else {
      const double expected = -(k.bend + k.shear * length * length / 4.0) * angle;
      EXPECT_NEAR(particle.torque1.y, expected, 1e-26);
      EXPECT_NEAR(average.torque1.y, expected, 1e-26);
    }
  }
}

TEST(RotationalBond, AtRestThereIsNoLoad)
{
  const BondLoads<double> found =
      load_bond<BondFrame::PARTICLE, BondDamping::DEM>(along_x(2.0), coeffs, 1.0 / dt);
  for (const Vector3<double> &v : {found.force, found.torque1, found.torque2})
    EXPECT_EQ(eigen(v).norm(), 0.0);
  EXPECT_EQ(found.breaking, 0.0);
  EXPECT_EQ(found.energy, 0.0);
}

/* ---------------------------------------------------------------------- */

namespace {

/// A ball of particles, each bonded to some others.
struct Agglomerate {
  static constexpr int count = 60, stride = 7;
  std::vector<double> x, v, omega, turn, history;
  std::vector<std::int64_t> tag;
  std::vector<BondEnds> bonds;

  explicit Agglomerate(unsigned seed)
  {
    RandomSource random(seed);
    for (int i = 0; i < count; i++) {
      tag.push_back((37 * i) % 61 + 1);
      for (std::vector<double> *rows : {&x, &v, &omega})
        for (const double number : random.in_cube(1.0)) rows->push_back(number);
      const Eigen::Quaterniond q = random_turn(random, 0.2);
      turn.insert(turn.end(), {q.w(), q.x(), q.y(), q.z()});
    }
    for (int i = 0; i < count; i++)
      for (int j = 0; j < i; j++)
        if (random.chance(0.2)) add(i, j, 1 + random.below(2), random);
  }

  void add(int i, int j, int type, RandomSource &random)
  {
    if (tag[j] < tag[i]) std::swap(i, j);
    bonds.push_back({i, j, type});
    Vector rest;
    for (int d = 0; d < 3; d++) rest[d] = x[3 * i + d] - x[3 * j + d];
    rest += random_vector(random, 0.02);
    const Vector n = rest.normalized();
    history.insert(history.end(), {rest.norm(), n.x(), n.y(), n.z(), 0.0, 0.0, 0.0});
  }

  /// Force and torque of all particles; `drop`: a bond that is gone.
  std::vector<double> forces(BondModel model, int threads, int drop = -1)
  {
    RotationalBonds all;
    all.set_model(model);
    all.set_bonds(bonds, count, tag.data());
    std::vector<double> history_now = history, f(3 * count, 0.5), t(3 * count, -0.25);
    const BondedParticles particles{
        {x.data()}, {v.data()}, {omega.data()}, turn.data(), history_now.data(), stride, 1.0};
    all.compute(particles, dt, threads);
    if (drop >= 0) {
      all.drop(drop);
      all.compute(particles, dt, threads);
    }
    ParticleView sums{};
    sums.f = f.data();
    sums.torque = t.data();
    all.add_to({count, sums, nullptr}, threads);
    f.insert(f.end(), t.begin(), t.end());
    return f;
  }

  void shuffle(unsigned seed)
  {
    RandomSource random(seed);
    for (std::size_t n = bonds.size(); n > 1; n--) {
      const std::size_t m = random.below(static_cast<int>(n));
      std::swap(bonds[n - 1], bonds[m]);
      std::swap_ranges(&history[stride * (n - 1)], &history[stride * (n - 1)] + stride,
                       &history[stride * m]);
    }
  }
};

BondModel model_of(BondFrame frame, BondDamping damping)
{
  BondModel model;
  model.frame = frame;
  model.damping = damping;
  model.breaks = model.smooth = false;
  BondCoeffs<double> other = coeffs;
  other.stiffness.bend = 1.7;
  model.coeffs = {{}, coeffs, other};
  return model;
}

}    // namespace

TEST(RotationalBonds, SumsDoNotDependOnTheListAndThreads)
{
  for (const BondFrame frame : {BondFrame::PARTICLE, BondFrame::AVERAGE})
    for (const BondDamping damping : {BondDamping::DEM, BondDamping::RATE}) {
      const BondModel model = model_of(frame, damping);
      Agglomerate ball(5);
      ASSERT_NE(ball.bonds.size() % lanes, 0U);
      const std::vector<double> expected = ball.forces(model, 1);
      for (const int threads : {2, 3}) {
        ball.shuffle(threads);
        EXPECT_EQ(ball.forces(model, threads), expected);
      }
    }
}

TEST(RotationalBonds, WhatIsDroppedIsAsIfItWereNotThere)
{
  const BondModel model = model_of(BondFrame::PARTICLE, BondDamping::DEM);
  Agglomerate ball(6);
  const std::vector<double> without =
      ball.forces(model, 1, static_cast<int>(ball.bonds.size()) - 1);
  ball.bonds.pop_back();
  EXPECT_EQ(ball.forces(model, 1), without);
}

TEST(RotationalBonds, BreakAtTheirLimit)
{
  BondModel model = model_of(BondFrame::PARTICLE, BondDamping::DEM);
  model.breaks = true;
  Agglomerate ball(7);
  for (const double factor : {0.0, 10.0}) {    // 1 + that
    RotationalBonds all;
    for (BondCoeffs<double> &c : model.coeffs) c.limit = {1e9, 1e9, 1e9, 1e9};
    if (factor > 0.0) model.coeffs[2].limit.normal = 1e-12;
    all.set_model(model);
    all.set_bonds(ball.bonds, Agglomerate::count, ball.tag.data());
    all.compute({{ball.x.data()},
                 {ball.v.data()},
                 {ball.omega.data()},
                 ball.turn.data(),
                 ball.history.data(),
                 Agglomerate::stride,
                 1.0},
                dt, 2);
    std::vector<int> expected, broken;
    all.for_each_broken([&](int b) { broken.push_back(b); });
    for (int b = 0; b < all.count(); b++) {
      const auto [i, j, type] = ball.bonds[b];
      const Vector d(ball.x[3 * i] - ball.x[3 * j], ball.x[3 * i + 1] - ball.x[3 * j + 1],
                     ball.x[3 * i + 2] - ball.x[3 * j + 2]);
      if (factor > 0.0 && type == 2 && d.norm() > ball.history[Agglomerate::stride * b])
        expected.push_back(b);
    }
    EXPECT_EQ(broken, expected);
    EXPECT_EQ(broken.empty(), factor == 0.0);
  }
}
