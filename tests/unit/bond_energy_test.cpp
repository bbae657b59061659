// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What a bond stores against the work of its loads, for small strains: of finite ones there is no energy whose gradient
// these loads are.

#include "bonds/rotational_bond.h"
#include "random_source.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace Talus;
using Vector = Eigen::Vector3d;
using Turn = Eigen::Quaterniond;

namespace {

Vector random_vector(RandomSource &random, double half)
{
  const auto v = random.in_cube(half);
  return {v[0], v[1], v[2]};
}

Turn turned(const Turn &q, const Vector &by)
{
  return Turn(Eigen::AngleAxisd(by.norm(), by.normalized())) * q;
}

Vector3<double> talus(const Vector &v)
{
  return {v.x(), v.y(), v.z()};
}
Quaternion<double> talus(const Turn &q)
{
  return {q.w(), q.x(), q.y(), q.z()};
}
double work(const Vector3<double> &load, const Vector &way)
{
  return load.x * way.x() + load.y * way.y() + load.z * way.z();
}

template <BondFrame frame> void compare_work()
{
  const BondCoeffs<double> elastic{
      {3.0, 2.0, 0.7, 0.9}, {1.0, 1.0, 1.0, 1.0}, {0.0, 0.0, 0.0, 0.0}};
  constexpr double strain = 1e-4, step = 1e-7;
  RandomSource random(11);
  for (int n = 0; n < 100; n++) {
    const Turn common = turned(Turn::Identity(), random_vector(random, 2.0));
    const Turn turn1 = turned(common, random_vector(random, strain)),
               turn2 = turned(common, random_vector(random, strain));
    const Vector rest = random_vector(random, 1.0) + Vector(1.5, 0.0, 0.0),
                 separation = common * rest + random_vector(random, strain);
    const Vector v = random_vector(random, 1.0), w1 = random_vector(random, 1.0),
                 w2 = random_vector(random, 1.0);
    const auto after = [&](double h) {
      BondedPair<double> moved{};
      moved.at_rest = talus(Vector(rest.normalized()));
      moved.length_at_rest = rest.norm();
      moved.separation = talus(Vector(separation + h * v));
      moved.turn1 = talus(turned(turn1, h * w1));
      moved.turn2 = talus(turned(turn2, h * w2));
      return load_bond<frame, BondDamping::DEM>(moved, elastic, 1.0);
    };
    const BondLoads<double> now = after(0.0);
    const double power = work(now.force, v) + work(now.torque1, w1) + work(now.torque2, w2);
    EXPECT_NEAR((after(step).stored - after(-step).stored) / (2.0 * step), -power,
                20.0 * strain * strain);
  }
}

}    // namespace

TEST(BondEnergy, IsTheWorkOfItsLoads)
{
  compare_work<BondFrame::PARTICLE>();
  compare_work<BondFrame::AVERAGE>();
}
