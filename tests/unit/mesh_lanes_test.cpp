// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Spheres near one plane of a mesh, eight at a time: what the lanes tell has the bits of what
// find_contacts() says of each, for surfaces of all kinds, spheres above faces, edges and vertices, and
// ways that they have gone since they were listed.

#include "body/contact/body_candidates.h"
#include "body/shape/mesh_shape.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

using namespace Talus;

namespace {

using V = Vector3<double>;

constexpr double skin = 0.01;

V vector(const std::array<double, 3> &a)
{
  return {a[0], a[1], a[2]};
}

/// at(i, j) for i, j = 0 ... n, each square cut into two.
template <class At> std::vector<Triangle> grid(int n, At at)
{
  std::vector<Triangle> soup;
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) {
      const V a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      soup.push_back({{a, b, c}});
      soup.push_back({{a, c, d}});
    }
  return soup;
}

/// A square aslant in space, cut into triangles whose vertices are shaken within it.
std::vector<Triangle> flat(RandomSource &random)
{
  constexpr int n = 8;
  V place[n + 1][n + 1];
  for (int j = 0; j <= n; j++)
    for (int i = 0; i <= n; i++) {
      const double u = i + random.uniform(-0.3, 0.3), v = j + random.uniform(-0.3, 0.3);
      place[j][i] = V{0.3, -0.2, 5.0} + (u / n) * V{0.8, 0.0, 0.6} + (v / n) * V{0.36, 0.8, -0.48};
    }
  return grid(n, [&](int i, int j) { return place[j][i]; });
}

std::vector<Triangle> bumpy(RandomSource &random)
{
  constexpr int n = 8;
  double height[n + 1][n + 1];
  for (auto &row : height)
    for (double &h : row) h = random.uniform(-0.06, 0.06);
  return grid(n, [&](int i, int j) { return V{i / 8.0 - 0.5, j / 8.0 - 0.5, height[j][i]}; });
}

/// The inside of a drum of 30 facets.
std::vector<Triangle> hollow(RandomSource & /*random*/)
{
  constexpr int n = 30;
  return grid(n, [&](int i, int j) {
    const double angle = 2.0 * std::acos(-1.0) * (i % n) / n;
    return V{0.6 * std::cos(angle), j / 30.0 - 0.5, 0.6 * std::sin(angle)};
  });
}

/// Triangles through each other, some of them slivers.
std::vector<Triangle> heap(RandomSource &random)
{
  std::vector<Triangle> soup;
  for (int n = 0; n < 60; n++) {
    const V a = vector(random.in_cube(0.5)), u = vector(random.unit_vector()),
            v = vector(random.unit_vector());
    const double length = n % 3 ? 0.3 : 0.8, width = n % 3 ? 0.3 : 1.0e-3;
    soup.push_back({{a, a + length * u, a + 0.4 * length * u + width * v}});
  }
  return soup;
}

using Surface = std::vector<Triangle> (*)(RandomSource &);

/// Spheres near triangles, many of them beside edges and corners, some far away.
struct Spheres {
  std::vector<double> x, radius;
  std::vector<int> type, mask;

  Spheres(const std::vector<Triangle> &soup, RandomSource &random, int count) :
      type(count, 1), mask(count, 1)
  {
    for (int n = 0; n < count; n++) {
      const Triangle &t = soup[static_cast<std::size_t>(random.uniform(0.0, 1.0) *
                                                        static_cast<double>(soup.size() - 1))];
      double u = random.uniform(0.0, 1.0), v = random.uniform(0.0, 1.0 - u);
      if (n % 5 == 0) v = 0.0;
      if (n % 10 == 0) u = 0.0;
      const double r = random.uniform(0.005, 0.04), away = n % 7 ? random.uniform(-1.2, 1.2) : 3.0;
      const V across = cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]);
      const V normal = n % 4 ? 1.0 / length(across) * across : vector(random.unit_vector());
      const V p = t.corner[0] + u * (t.corner[1] - t.corner[0]) + v * (t.corner[2] - t.corner[0]) +
                  r * away * normal;
      x.insert(x.end(), {p.x, p.y, p.z});
      radius.push_back(r);
    }
  }
  ParticleState view()
  {
    ParticleView arrays{};
    arrays.x = x.data();
    arrays.radius = radius.data();
    return {static_cast<int>(radius.size()), arrays, type.data()};
  }
  /// Each by at most half the skin, many of them by little.
  void go(RandomSource &random)
  {
    for (std::size_t n = 0; n < radius.size(); n++) {
      const V way = random.uniform(0.0, n % 3 ? 0.5 : 0.01) * skin * vector(random.unit_vector());
      x[3 * n] += way.x;
      x[3 * n + 1] += way.y;
      x[3 * n + 2] += way.z;
    }
  }
};

bool same_bits(const SurfaceContact &a, const SurfaceContact &b)
{
  const double one[4] = {a.normal.x, a.normal.y, a.normal.z, a.overlap},
               other[4] = {b.normal.x, b.normal.y, b.normal.z, b.overlap};
  return std::memcmp(one, other, sizeof one) == 0 && a.part == b.part;
}

struct Seen {
  int asked = 0, told = 0, touching = 0;    // of those near a triangle; of told ones
};

/// Compares all lanes of all blocks.
void compare(const BodyCandidates &candidates, const MeshShape &shape, const ParticleState &view,
             Seen &seen)
{
  for (std::size_t first = 0; first < candidates.size(); first += lanes) {
    const int count = static_cast<int>(std::min<std::size_t>(lanes, candidates.size() - first));
    EightSpheres spheres;
    EightContacts contacts;
    view.spheres_at([&](int k) { return candidates.atom(first + std::min(k, count - 1)); },
                    spheres.center, spheres.radius);
    unsigned told;
    const unsigned touching =
        candidates.touch_flat(shape, BodyFrame{}, first / lanes, spheres, contacts, told);
    ASSERT_EQ(touching & ~told, 0U);
    for (int k = 0; k < count; k++) {
      const V x{spheres.center[0][k], spheres.center[1][k], spheres.center[2][k]};
      bool may_touch;
      const NearParts parts =
          candidates.parts_near(BodyFrame{}, first + k, x, spheres.radius[k], may_touch);
      SurfaceContact found[LargeBodyShape::max_contacts];
      const int number = may_touch ? shape.find_contacts(x, spheres.radius[k], parts, found) : 0;
      if (may_touch) seen.asked++;
      if (!(told >> k & 1U)) continue;
      const bool touches = touching >> k & 1U;
      ASSERT_EQ(number, touches ? 1 : 0);
      ASSERT_TRUE(!touches || same_bits(contacts.plain(k), *found));
      if (may_touch) seen.told++;
      if (touches) seen.touching++;
    }
  }
}

class MeshLanes : public testing::TestWithParam<std::tuple<Surface, MeshSide>> {};

TEST_P(MeshLanes, SameBitsAsOneByOne)
{
  const auto [surface, side] = GetParam();
  RandomSource random(12);
  Seen seen;
  for (int round = 0; round < 5; round++) {
    const std::vector<Triangle> soup = surface(random);
    const MeshShape shape(TriangleMesh(soup), side);
    Spheres spheres(soup, random, 2000);
    BodyCandidates candidates;
    candidates.list(shape, BodyFrame{}, spheres.view(), spheres.mask.data(), 1, skin, 0.0, {}, 1);
    compare(candidates, shape, spheres.view(), seen);
    for (int step = 0; step < 3; step++) {
      Spheres gone = spheres;
      gone.go(random);
      compare(candidates, shape, gone.view(), seen);
    }
  }
  EXPECT_GT(seen.told, seen.asked / 40);
  EXPECT_LT(seen.told, seen.asked);
  EXPECT_GT(seen.touching, 500);
}

// Lists do not depend on the number of threads.
TEST(MeshLists, SameWithThreads)
{
  RandomSource random(5);
  const std::vector<Triangle> soup = bumpy(random);
  const MeshShape shape(TriangleMesh(soup), MeshSide::BOTH);
  Spheres spheres(soup, random, 1001);
  BodyCandidates alone, together;
  alone.list(shape, BodyFrame{}, spheres.view(), spheres.mask.data(), 1, skin, 0.0, {7}, 1);
  together.list(shape, BodyFrame{}, spheres.view(), spheres.mask.data(), 1, skin, 0.0, {7}, 3);
  ASSERT_EQ(alone.atoms(), together.atoms());
  ASSERT_EQ(alone.room(), together.room());
  ASSERT_GT(alone.size(), 500U);
  for (std::size_t c = 0; c < alone.size(); c++) {
    bool may_touch;
    const V x = alone.listed_at(c);
    const NearParts one = alone.parts_near(BodyFrame{}, c, x, 0.1, may_touch),
                    other = together.parts_near(BodyFrame{}, c, x, 0.1, may_touch);
    ASSERT_EQ(one.end - one.begin, other.end - other.begin);
    for (const NearPart *p = one.begin, *q = other.begin; p != one.end; p++, q++)
      ASSERT_EQ(p->part, q->part);
    ASSERT_EQ(alone.with_parts(c / lanes), together.with_parts(c / lanes));
  }
}

std::string name_of(const testing::TestParamInfo<std::tuple<Surface, MeshSide>> &info)
{
  const auto [surface, side] = info.param;
  const std::string kind = surface == flat     ? "Flat"
                           : surface == bumpy  ? "Bumpy"
                           : surface == hollow ? "Hollow"
                                               : "Heap";
  return kind + (side == MeshSide::NORMALS ? "Normals"
                 : side == MeshSide::BACKS ? "Backs"
                                           : "Both");
}

INSTANTIATE_TEST_SUITE_P(Surfaces, MeshLanes,
                         testing::Combine(testing::Values(flat, bumpy, hollow, heap),
                                          testing::Values(MeshSide::NORMALS, MeshSide::BACKS,
                                                          MeshSide::BOTH)),
                         name_of);

}    // namespace
